//! Which views show a link in the same pose: their residuals share the errors of shape and of
//! depth there, so they are one cluster.

use super::start::RefineView;
use eyebolt_geometry::{Base, Link, Transform};

/// Poses of a link that are the same: errors of depth and of shape change with less than that.
const SAME_M: f64 = 1e-3;
const SAME_RAD: f64 = 2e-3;

/// The views that show one link in one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cluster {
    /// Its number among all clusters of all links.
    pub number: usize,
    /// How many views are in it; together they count as one.
    pub views: usize,
}

/// Of each view the cluster of each link.
pub(super) fn clusters(views: &[RefineView<'_>]) -> Vec<Vec<Cluster>> {
    let poses: Vec<_> = views.iter().map(|view| view.view.posture.base_from_link()).collect();
    let links = poses.iter().map(|poses| poses.len()).min().unwrap_or(0);
    let mut found = vec![Vec::with_capacity(links); views.len()];
    let mut count = 0;
    for link in 0..links {
        // The first view of each cluster, and which cluster each view is in.
        let mut firsts: Vec<&Transform<Base, Link>> = Vec::new();
        let of_view: Vec<usize> = poses
            .iter()
            .map(|poses| {
                let same = |first: &&Transform<Base, Link>| {
                    let (metres, radians) = first.distance_to(&poses[link]);
                    metres < SAME_M && radians < SAME_RAD
                };
                firsts.iter().position(same).unwrap_or_else(|| {
                    firsts.push(&poses[link]);
                    firsts.len() - 1
                })
            })
            .collect();
        let mut sizes = vec![0; firsts.len()];
        of_view.iter().for_each(|cluster| sizes[*cluster] += 1);
        for (view, cluster) in of_view.iter().enumerate() {
            found[view].push(Cluster { number: count + cluster, views: sizes[*cluster] });
        }
        count += firsts.len();
    }
    found
}

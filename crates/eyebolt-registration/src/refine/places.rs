//! Which views show a link in the same place: they all show the same errors of it.

use super::RefineView;
use eyebolt_geometry::{Base, Link, Transform};

/// Poses of a link that are one place: errors of depth and of shape change with less than that.
const SAME_M: f64 = 1e-3;
const SAME_RAD: f64 = 2e-3;

/// A place in which some views show a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Its number among all places of all links.
    pub number: usize,
    /// What the evidence of each of its views counts, so that all together count as one.
    pub share: f64,
}

/// Of each view the place of each link.
pub(super) fn places(views: &[RefineView<'_>]) -> Vec<Vec<Place>> {
    let poses: Vec<_> = views.iter().map(|view| view.view.posture.base_from_link()).collect();
    let links = poses.iter().map(|poses| poses.len()).min().unwrap_or(0);
    let mut found = vec![Vec::with_capacity(links); views.len()];
    let mut count = 0;
    for link in 0..links {
        // The first view of each place, and which place each view shows.
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
        for (view, place) in of_view.iter().enumerate() {
            let views = of_view.iter().filter(|other| *other == place).count();
            found[view].push(Place { number: count + place, share: (views as f64).recip() });
        }
        count += firsts.len();
    }
    found
}

//! What the configurations so far have shown of the arm.

use eyebolt::observations::Observations;
use eyebolt::pipeline::Outcome;
use eyebolt_registration::Posture;
use eyebolt_render::Raster;
use nalgebra::{Point3, Vector3};
use serde::Serialize;

/// What the configurations so far have shown of the arm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coverage {
    /// The turning joints from the base on.
    pub joints: Vec<JointCoverage>,
    /// The links that moved, as far as the pose of the camera is known.
    pub links: Vec<LinkCoverage>,
}

/// Where a joint was.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointCoverage {
    /// Its name.
    pub joint: String,
    /// Its position in each configuration, degrees.
    pub at_deg: Vec<f64>,
}

/// What was seen of a link.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LinkCoverage {
    /// Its name.
    pub link: String,
    /// In how many configurations the arm itself left some of it in view.
    pub seen_in: usize,
    /// How far the sides from which it was seen are apart at most, degrees: the angle between the ways to the camera in
    /// the link's frame.
    pub apart_deg: f64,
}

/// Images are made so coarse before links are counted in them, columns.
const COLUMNS: u32 = 160;
/// A link of fewer pixels of such an image is not seen.
const LEAST_PIXELS: usize = 12;

impl Coverage {
    /// Of what `outcome` was made of.
    pub fn of(outcome: &Outcome) -> Option<Self> {
        let observations = outcome.observations.as_ref()?;
        let joints = observations.arm.joints().iter().enumerate().map(|(index, joint)| {
            let at = observations.configurations.iter().filter_map(|c| c.joints_rad.get(index));
            let at_deg = at.map(|at| tenths(at.to_degrees())).collect();
            JointCoverage { joint: joint.name.clone(), at_deg }
        });
        Some(Self {
            joints: joints.collect(),
            links: links(outcome, observations).unwrap_or_default(),
        })
    }
}

fn links(outcome: &Outcome, observations: &Observations) -> Option<Vec<LinkCoverage>> {
    let camera_from_base = outcome.calibration.refinement.as_ref()?.camera_from_base;
    let camera = &observations.camera;
    let coarse = camera.scaled((camera.width() / COLUMNS).max(1)).ok()?;
    let mut raster = Raster::new(&coarse);
    let postures = outcome.postures();
    let counts: Vec<Vec<usize>> = postures
        .iter()
        .map(|posture| {
            raster.draw(&coarse, &posture.meshes(&observations.arm, &camera_from_base));
            let mut counts = vec![0; observations.arm.links().len()];
            for link in raster.pixels().filter_map(|at| raster.link(at)) {
                if let Some(count) = counts.get_mut(usize::from(link)) {
                    *count += 1;
                }
            }
            counts
        })
        .collect();
    let eye = Point3::from(camera_from_base.inverse().translation_m());
    let links =
        observations.arm.links().iter().enumerate().filter(|(index, _)| moved(&postures, *index));
    let coverage = links.map(|(index, link)| {
        let seen = postures.iter().zip(&counts).filter(|(_, counts)| counts[index] >= LEAST_PIXELS);
        let ways: Vec<Vector3<f64>> =
            seen.filter_map(|(posture, _)| way_to(posture, index, &eye)).collect();
        LinkCoverage {
            link: link.name.clone(),
            seen_in: ways.len(),
            apart_deg: tenths(widest_deg(&ways)),
        }
    });
    Some(coverage.collect())
}

fn tenths(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}

/// Whether a link was in different places.
fn moved(postures: &[Posture], link: usize) -> bool {
    let mut places = postures.iter().filter_map(|posture| posture.base_from_link().get(link));
    let Some(first) = places.next() else { return false };
    places.any(|place| {
        let (metres, radians) = place.distance_to(first);
        metres > 1e-6 || radians > 1e-6
    })
}

/// The way from a link to `eye` (base frame), in the link's frame; of unit length.
fn way_to(posture: &Posture, link: usize, eye: &Point3<f64>) -> Option<Vector3<f64>> {
    let base_from_link = posture.base_from_link().get(link)?.isometry();
    base_from_link.inverse_transform_point(eye).coords.try_normalize(1e-6)
}

/// The largest angle between two of `ways`, degrees.
fn widest_deg(ways: &[Vector3<f64>]) -> f64 {
    let pairs =
        ways.iter().enumerate().flat_map(|(turn, a)| ways[..turn].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| a.angle(b).to_degrees()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_angle_is_that_of_the_farthest_pair() {
        let at = |deg: f64| Vector3::new(deg.to_radians().cos(), deg.to_radians().sin(), 0.0);
        assert_eq!(widest_deg(&[]), 0.0);
        assert_eq!(widest_deg(&[at(10.0)]), 0.0);
        assert!((widest_deg(&[at(10.0), at(55.0), at(-20.0), at(12.0)]) - 75.0).abs() < 1e-9);
    }
}

//! Which frame the points of a cloud are in, which its message does not say.

use crate::manifest::CloudFrame;
use eyebolt_robot::Input;

/// Share of the points that has to lie before the camera.
const BEFORE: f64 = 0.99;
/// Tangent of the widest angle from the axis of a depth camera, to the corner of its image.
const WIDEST: f32 = 1.8;

/// The frame that `points` are in: what the frame's name says, else where the points lie.
///
/// A camera sees what lies along its axis, z in the optical frame and x in the body's; few clouds
/// lie along both.
pub(crate) fn frame_of(name: Option<&str>, points: &[[f32; 3]]) -> Result<CloudFrame, String> {
    let ahead = |axis: usize| {
        let seen = |p: &&[f32; 3]| {
            let [x, y, z] = **p;
            let [along, a, b] = if axis == 0 { [x, y, z] } else { [z, x, y] };
            along > 0.0 && a.hypot(b) < WIDEST * along
        };
        let valid = points.iter().filter(|p| p.iter().all(|c| c.is_finite()) && **p != [0.0; 3]);
        let (count, inside) = (valid.clone().count(), valid.filter(seen).count());
        count > 0 && inside as f64 >= BEFORE * count as f64
    };
    let (body, optical) = (ahead(0), ahead(2));
    let says_optical = name.is_some_and(|name| name.contains("optical"));
    match (says_optical, optical, body) {
        (true, true, _) | (_, true, false) => Ok(CloudFrame::Optical),
        (false, false, true) => Ok(CloudFrame::Body),
        (false, true, true) => {
            Err("the points may be in the optical frame or in the body's".to_owned())
        }
        (true, false, true) => {
            let name = name.unwrap_or_default();
            Err(format!("the frame is called {name}, but the points lie along x, not z"))
        }
        (_, false, false) => {
            Err("the points lie before no camera: neither along z nor along x".to_owned())
        }
    }
}

/// What to do where nobody can tell the frame.
pub(crate) fn frame_remedy() -> String {
    format!(
        "Give {}: optical (x right, y down, z forward) or body (x forward, y left, z up)",
        Input::CLOUD_FRAME
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn wide() -> impl Strategy<Value = Vec<[f32; 3]>> {
        proptest::collection::vec((-0.9_f32..0.9, -0.6_f32..0.6, 0.4_f32..4.0), 200)
            .prop_map(|rays| rays.into_iter().map(|(x, y, z)| [x * z, y * z, z]).collect())
    }

    proptest! {
        #[test]
        fn points_tell_their_frame(points in wide()) {
            prop_assert_eq!(frame_of(Some("cam"), &points), Ok(CloudFrame::Optical));
            let body: Vec<_> = points.iter().map(|[x, y, z]| [*z, -x, -y]).collect();
            prop_assert_eq!(frame_of(None, &body), Ok(CloudFrame::Body));
            prop_assert!(frame_of(Some("camera_optical_frame"), &body).is_err());
            let behind: Vec<_> = points.iter().map(|[x, y, z]| [*x, *y, -z]).collect();
            prop_assert!(frame_of(None, &behind).is_err());
        }
    }

    #[test]
    fn a_cloud_in_a_corner_may_be_either() {
        let corner = vec![[1.0, 0.1, 1.0]; 10];
        assert!(frame_of(Some("cam"), &corner).is_err());
        assert_eq!(frame_of(Some("cam_optical"), &corner), Ok(CloudFrame::Optical));
    }
}

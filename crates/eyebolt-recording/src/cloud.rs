//! Point clouds in NPY, PCD and PLY.

mod float;
mod npy;
mod pcd;
mod ply;
mod stored;
mod text;
mod told_frame;

use crate::depth::{LEAVE_OUT, scaled};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::file::read_bytes;
use crate::manifest::CloudFrame;
use crate::unit_check::check_unit;
use eyebolt_geometry::Cloud;
use nalgebra::Point3;
use std::path::Path;
pub(crate) use stored::Stored;
use stored::{FIELD, LARGEST, invalid};
pub(crate) use told_frame::{frame_of, frame_remedy};

/// Reads a cloud stored in `unit` and `frame`; the points returned are in the optical frame.
pub(crate) fn read_cloud(
    path: &Path,
    extension: &str,
    unit: DepthUnit,
    frame: CloudFrame,
) -> Result<Cloud, RecordingError> {
    optical_cloud(path, read_stored(path, extension)?, unit, frame)
}

/// Reads a cloud as its file has it.
pub(crate) fn read_stored(path: &Path, extension: &str) -> Result<Stored, RecordingError> {
    match extension {
        "pcd" => pcd::parse(path, read_bytes(path, FIELD, LARGEST)?),
        "ply" => ply::parse(path, &read_bytes(path, FIELD, LARGEST)?),
        _ => npy::read(path),
    }
}

/// The cloud that a file has `stored` in `unit` and `frame`, in the optical frame.
pub(crate) fn optical_cloud(
    path: &Path,
    stored: Stored,
    unit: DepthUnit,
    frame: CloudFrame,
) -> Result<Cloud, RecordingError> {
    let values = scaled(stored.xyz, unit);
    let (triples, _) = values.as_chunks::<3>();
    let points: Vec<_> = triples.iter().map(|xyz| optical(*xyz, frame)).collect();
    check_unit(path, FIELD, unit, points.iter().map(|p| p.coords.norm()))?;
    if points.iter().all(|point| point.x.is_nan()) {
        return Err(invalid(path, "it has no point".to_owned(), LEAVE_OUT));
    }
    match stored.grid {
        None => Ok(Cloud::new(points)),
        Some((width, height)) => Cloud::organised(width, height, points)
            .map_err(|error| invalid(path, error.to_string(), "Store the whole cloud")),
    }
}

/// The point in the optical frame; NaN where there is none.
pub(crate) fn optical([x, y, z]: [f32; 3], frame: CloudFrame) -> Point3<f32> {
    let there = x.is_finite() && y.is_finite() && z.is_finite() && [x, y, z] != [0.0; 3];
    match frame {
        _ if !there => Point3::new(f32::NAN, f32::NAN, f32::NAN),
        CloudFrame::Optical => Point3::new(x, y, z),
        // REP 103: x forward, y left, z up becomes x right, y down, z forward.
        CloudFrame::Body => Point3::new(-y, -z, x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::optical_from_body;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn body_turns_as_the_rotation_says(x in -9.0_f32..9.0, y in -9.0_f32..9.0, z in 0.1_f32..9.0) {
            let turned = optical_from_body() * Point3::new(x, y, z).cast::<f64>();
            let point = optical([x, y, z], CloudFrame::Body).cast::<f64>();
            prop_assert!((turned - point).norm() < 1e-12);
        }

        #[test]
        fn a_broken_coordinate_breaks_the_point(axis in 0_usize..3, infinite in any::<bool>()) {
            let mut xyz = [1.0_f32; 3];
            xyz[axis] = if infinite { f32::INFINITY } else { f32::NAN };
            for frame in [CloudFrame::Body, CloudFrame::Optical] {
                prop_assert!(optical(xyz, frame).iter().all(|c| c.is_nan()));
            }
        }
    }
}

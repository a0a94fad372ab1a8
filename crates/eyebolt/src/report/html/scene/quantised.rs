//! Points in 16 bits for each coordinate.

use crate::report::html::base64;
use nalgebra::Point3;
use serde::Serialize;

/// A box of points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Bounds {
    /// The corner with the least coordinates, metres.
    low: [f32; 3],
    /// Lengths of its edges, metres; not 0.
    size: [f32; 3],
}

impl Bounds {
    /// About all of `points`.
    pub(super) fn of<'a>(points: impl IntoIterator<Item = &'a Point3<f32>>) -> Self {
        let mut ends: Option<(Point3<f32>, Point3<f32>)> = None;
        for point in points {
            let (low, high) = ends.unwrap_or((*point, *point));
            ends = Some((low.inf(point), high.sup(point)));
        }
        let (low, high) = ends.unwrap_or((Point3::origin(), Point3::origin()));
        let size: [f32; 3] = (high - low).into();
        Self { low: low.into(), size: size.map(|edge| edge.max(1e-6)) }
    }

    /// `points` as x, y, z of each, 16 bits little-endian: 0 is the low end of the box and 65535 the
    /// high end.
    pub(super) fn encode(&self, points: &[Point3<f32>]) -> String {
        let mut bytes = Vec::with_capacity(6 * points.len());
        for point in points {
            for ((value, low), size) in point.iter().zip(self.low).zip(self.size) {
                let share = ((value - low) / size).clamp(0.0, 1.0);
                bytes.extend(((share * 65535.0).round() as u16).to_le_bytes());
            }
        }
        base64::encode(&bytes)
    }
}

//! The end-effector's symmetry in `dataset.toml`.

use crate::end_effector::Symmetry;
use nalgebra::{Point3, Unit, Vector3};
use serde::{Deserialize, Serialize};

/// Turns of the end-effector that its shape does not show.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum SymmetryDescription {
    /// None.
    None,
    /// By whole parts of a circle.
    Fold {
        /// How many parts.
        count: u32,
        /// Direction of the axis, end-effector frame.
        axis: [f64; 3],
        /// A point on it, metres.
        through_m: [f64; 3],
    },
    /// By any angle about an axis.
    Axis {
        /// Direction of the axis, end-effector frame.
        axis: [f64; 3],
        /// A point on it, metres.
        through_m: [f64; 3],
    },
}

impl From<Symmetry> for SymmetryDescription {
    fn from(symmetry: Symmetry) -> Self {
        match symmetry {
            Symmetry::None => Self::None,
            Symmetry::Fold { count, axis, through } => Self::Fold {
                count,
                axis: axis.into_inner().into(),
                through_m: through.coords.into(),
            },
            Symmetry::Axis { axis, through } => {
                Self::Axis { axis: axis.into_inner().into(), through_m: through.coords.into() }
            }
        }
    }
}

impl From<&SymmetryDescription> for Symmetry {
    fn from(described: &SymmetryDescription) -> Self {
        let axis = |axis: &[f64; 3]| Unit::new_normalize(Vector3::from(*axis));
        match described {
            SymmetryDescription::None => Self::None,
            SymmetryDescription::Fold { count, axis: along, through_m } => {
                Self::Fold { count: *count, axis: axis(along), through: Point3::from(*through_m) }
            }
            SymmetryDescription::Axis { axis: along, through_m } => {
                Self::Axis { axis: axis(along), through: Point3::from(*through_m) }
            }
        }
    }
}

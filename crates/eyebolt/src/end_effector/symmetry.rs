//! Which turns of an end-effector cannot be seen from its shape.

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use rayon::prelude::*;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Turns after which a shape is the same, as far as a depth camera can tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Symmetry {
    /// None: every pose looks different.
    None,
    /// Each turn by a whole part of a circle.
    Fold {
        /// How many parts: 2 for a half turn.
        count: u32,
        /// Direction of the axis, end-effector frame.
        axis: Unit<Vector3<f64>>,
        /// A point on it, metres.
        through: Point3<f64>,
    },
    /// Every turn about an axis, as of a bare flange: how far it is turned cannot be seen.
    Axis {
        /// Direction of the axis, end-effector frame.
        axis: Unit<Vector3<f64>>,
        /// A point on it, metres.
        through: Point3<f64>,
    },
}

/// Folds that are looked for, the many first.
const FOLDS: [u32; 4] = [6, 4, 3, 2];
/// Parts of a circle that stand for every turn: no shape made by people has as many of its own.
const ROUND: u32 = 17;
/// By how much a surface may differ from itself turned: what depth cameras hardly see, metres.
const TOLERANCE_M: f64 = 0.004;
/// So many of the points have to agree.
const SHARE: f64 = 0.97;
/// Points that are turned, of those that the surface is known by.
const TURNED: usize = 2000;

impl Symmetry {
    /// That of a surface which `points` cover densely and evenly, end-effector frame, metres. Axes
    /// are looked for through its middle: its principal ones, and those of the frame.
    pub(super) fn of(points: &[Point3<f64>]) -> Self {
        let count = points.len().max(1) as f64;
        let through = Point3::from(points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count);
        let surface = Surface::new(points);
        let axes = axes(points, &through);
        let axis = axes.iter().find(|axis| surface.is_same(&turn(axis, &through, ROUND, 1)));
        if let Some(axis) = axis {
            return Self::Axis { axis: *axis, through };
        }
        for count in FOLDS {
            let axis = axes.iter().find(|axis| surface.is_same(&turn(axis, &through, count, 1)));
            if let Some(axis) = axis {
                return Self::Fold { count, axis: *axis, through };
            }
        }
        Self::None
    }

    /// The turns but for the identity, as motions in the end-effector frame; of every turn about an
    /// axis some that stand for all.
    pub fn turns(&self) -> Vec<Isometry3<f64>> {
        let all = |axis, through, count| (1..count).map(move |k| turn(axis, through, count, k));
        match self {
            Self::None => Vec::new(),
            Self::Fold { count, axis, through } => all(axis, through, *count).collect(),
            Self::Axis { axis, through } => all(axis, through, ROUND).collect(),
        }
    }
}

/// The turn by `k` of `count` parts of a circle.
fn turn(axis: &Unit<Vector3<f64>>, through: &Point3<f64>, count: u32, k: u32) -> Isometry3<f64> {
    let angle = TAU * f64::from(k) / f64::from(count);
    let rotation = UnitQuaternion::from_axis_angle(axis, angle);
    let moved = through.coords - rotation * through.coords;
    Isometry3::from_parts(Translation3::from(moved), rotation)
}

/// Axes of the frame, z first, which flanges turn about; then the principal ones.
fn axes(points: &[Point3<f64>], through: &Point3<f64>) -> Vec<Unit<Vector3<f64>>> {
    let spread: Matrix3<f64> =
        points.iter().map(|point| (point - through) * (point - through).transpose()).sum();
    let principal = spread.symmetric_eigen().eigenvectors;
    let principal = principal.column_iter().map(|axis| Unit::new_normalize(axis.into_owned()));
    [Vector3::z_axis(), Vector3::x_axis(), Vector3::y_axis()].into_iter().chain(principal).collect()
}

/// Points of a surface, found by place.
struct Surface<'a> {
    points: &'a [Point3<f64>],
    cells: HashMap<[i32; 3], Vec<Point3<f64>>>,
}

impl<'a> Surface<'a> {
    fn new(points: &'a [Point3<f64>]) -> Self {
        let mut cells = HashMap::<_, Vec<_>>::new();
        for point in points {
            cells.entry(cell(point)).or_default().push(*point);
        }
        Self { points, cells }
    }

    /// Whether the surface lies on itself after `motion`.
    fn is_same(&self, motion: &Isometry3<f64>) -> bool {
        let stride = (self.points.len() / TURNED).max(1);
        let turned: Vec<_> = self.points.iter().step_by(stride).map(|p| motion * p).collect();
        let near = turned.par_iter().filter(|point| self.has_near(point)).count();
        near as f64 >= SHARE * turned.len() as f64
    }

    fn has_near(&self, point: &Point3<f64>) -> bool {
        let [x, y, z] = cell(point);
        let around =
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        let mut cells = around.filter_map(|[i, j, k]| self.cells.get(&[x + i, y + j, z + k]));
        cells.any(|cell| cell.iter().any(|other| (other - point).norm() < TOLERANCE_M))
    }
}

fn cell(point: &Point3<f64>) -> [i32; 3] {
    std::array::from_fn(|axis| (point[axis] / TOLERANCE_M).floor() as i32)
}

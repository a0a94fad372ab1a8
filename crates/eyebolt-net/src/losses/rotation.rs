//! Losses of rotations by what they do to points (Xiang et al., *PoseCNN*, RSS 2018, equations 5
//! and 6).

use super::loss::Loss;
use crate::{Error, Matrix};

/// Which points are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseLoss {
    /// Each with itself (PLoss).
    SamePoint,
    /// Each with the nearest (SLoss), for shapes that look the same from several sides.
    NearestPoint,
}

/// Mean over items and model points of half the squared distance between a point turned by the
/// predicted rotation and its counterpart turned by the true one.
///
/// `prediction`, `truth`: quaternions `x, y, z, w`, one row for each item, of any length but zero;
/// `points_m` of the model.
///
/// # Errors
/// If shapes differ, there are no items or points, a value is not finite, or a quaternion is zero.
pub fn pose_loss(
    kind: PoseLoss,
    prediction: &Matrix,
    truth: &Matrix,
    points_m: &[[f32; 3]],
) -> Result<Loss, Error> {
    if prediction.channels() != 4 || truth.channels() != 4 || prediction.rows() != truth.rows() {
        return Err(Error::input("quaternions", "not as many rows of four as there are truths"));
    }
    if prediction.rows() == 0 || points_m.is_empty() {
        return Err(Error::input("pose loss", "of nothing"));
    }
    let flat = points_m.iter().flatten().copied().collect();
    Matrix::new(points_m.len(), 3, flat)?.check_finite("points")?;
    let points: Vec<Vector> = points_m.iter().map(|point| point.map(f64::from)).collect();
    let share = 1.0 / (points.len() * prediction.rows()) as f64;
    let mut gradient = Matrix::zeros(prediction.rows(), 4);
    let mut value = 0.0;
    for row in 0..prediction.rows() {
        let (length, found) = unit(prediction.row(row), "prediction", row)?;
        let (_, wanted) = unit(truth.row(row), "truth", row)?;
        let targets: Vec<Vector> = points.iter().map(|&x| rotate(wanted, x)).collect();
        let mut slope = [0.0; 4];
        for (index, &x) in points.iter().enumerate() {
            let turned = rotate(found, x);
            let target = match kind {
                PoseLoss::SamePoint => targets[index],
                PoseLoss::NearestPoint => nearest(turned, &targets),
            };
            let residual = subtract(turned, target);
            value += share * 0.5 * dot(residual, residual);
            let part = slope_of(found, x, residual);
            (0..4).for_each(|axis| slope[axis] += share * part[axis]);
        }
        // Length does not matter: only what is across the quaternion counts.
        let along: f64 = (0..4).map(|axis| slope[axis] * found[axis]).sum();
        for axis in 0..4 {
            let across = (slope[axis] - along * found[axis]) / length;
            gradient.values_mut()[row * 4 + axis] = across as f32;
        }
    }
    Ok(Loss { value, gradient })
}

type Vector = [f64; 3];

fn unit(row: &[f32], field: &str, item: usize) -> Result<(f64, [f64; 4]), Error> {
    let quaternion = [row[0], row[1], row[2], row[3]].map(f64::from);
    let length = quaternion.iter().map(|value| value * value).sum::<f64>().sqrt();
    if !(length.is_finite() && length > 0.0) {
        return Err(Error::input(field, format!("item {item}: {row:?} is no rotation")));
    }
    Ok((length, quaternion.map(|value| value / length)))
}

/// `x + 2 w (v x x) + 2 v x (v x x)`.
fn rotate([a, b, c, w]: [f64; 4], x: Vector) -> Vector {
    let v = [a, b, c];
    let once = cross(v, x);
    let twice = cross(v, once);
    [0, 1, 2].map(|axis| x[axis] + 2.0 * (w * once[axis] + twice[axis]))
}

/// Derivative of half the squared residual by the quaternion.
fn slope_of([a, b, c, w]: [f64; 4], x: Vector, residual: Vector) -> [f64; 4] {
    let v = [a, b, c];
    let across = cross(x, residual);
    let (vr, vx, xr) = (dot(v, residual), dot(v, x), dot(x, residual));
    let by = |axis: usize| {
        2.0 * (w * across[axis] + vr * x[axis] + vx * residual[axis] - 2.0 * xr * v[axis])
    };
    [by(0), by(1), by(2), 2.0 * dot(v, across)]
}

fn nearest(point: Vector, targets: &[Vector]) -> Vector {
    let distance = |&target: &Vector| {
        let difference = subtract(point, target);
        dot(difference, difference)
    };
    let best = targets.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    *best.expect("there are points")
}

fn subtract(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

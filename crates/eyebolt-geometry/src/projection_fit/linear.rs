//! The direct linear transform and its RQ decomposition.

use super::error::ProjectionFitError;
use super::projection::{Projection, Sighting};
use nalgebra::{Matrix3, Point2, Rotation3, SMatrix, SVector, SymmetricEigen, UnitQuaternion};

type Matrix9 = SMatrix<f64, 9, 9>;

/// Share of the points kept when the fit is repeated without the worst ones.
const KEPT_SHARE: f64 = 0.8;
/// How often the fit is repeated.
const TRIMS: usize = 3;
/// The smallest but one eigenvalue of the normal matrix, as a share of the largest, below which
/// the points do not determine the nine entries.
const MIN_EIGENVALUE: f64 = 1e-13;

/// A first projection, from all points and then thrice from the best of them, so that a few wrong
/// ones do no harm.
pub(super) fn fit(sightings: &[Sighting]) -> Result<Projection, ProjectionFitError> {
    let mut projection = fit_once(sightings.iter())?;
    let kept = (sightings.len() as f64 * KEPT_SHARE) as usize;
    for _ in 0..TRIMS {
        let errors: Vec<f64> = sightings.iter().map(|s| projection.error_px(s)).collect();
        let mut sorted = errors.clone();
        let (_, limit, _) = sorted.select_nth_unstable_by(kept, f64::total_cmp);
        let limit = *limit;
        // All of them fit already.
        if limit < 1e-2 {
            break;
        }
        let best = sightings.iter().zip(&errors).filter(|(_, e)| **e <= limit).map(|(s, _)| s);
        projection = fit_once(best)?;
    }
    Ok(projection)
}

fn fit_once<'a>(
    sightings: impl Iterator<Item = &'a Sighting> + Clone,
) -> Result<Projection, ProjectionFitError> {
    let normalisation = Normalisation::of(sightings.clone().map(|s| s.pixel));
    let mut normal = Matrix9::zeros();
    for sighting in sightings.clone() {
        let [u, v] = normalisation.apply(&sighting.pixel);
        let p = sighting.direction;
        let mut row = SVector::<f64, 9>::zeros();
        row.fixed_rows_mut::<3>(0).copy_from(&p);
        row.fixed_rows_mut::<3>(6).copy_from(&(p * -u));
        normal.syger(1.0, &row, &row, 1.0);
        row.fixed_rows_mut::<3>(0).fill(0.0);
        row.fixed_rows_mut::<3>(3).copy_from(&p);
        row.fixed_rows_mut::<3>(6).copy_from(&(p * -v));
        normal.syger(1.0, &row, &row, 1.0);
    }
    // Only the lower triangle was filled, and only that is read.
    let null = smallest_eigenvector(normal)?;
    let normalised = Matrix3::from_row_slice(null.as_slice());
    let mut matrix = normalisation.inverse() * normalised;
    let in_front = sightings.clone().map(|s| (matrix.row(2) * s.direction).x.signum()).sum::<f64>();
    if in_front < 0.0 {
        matrix = -matrix;
    }
    decompose(&matrix)
}

fn smallest_eigenvector(matrix: Matrix9) -> Result<SVector<f64, 9>, ProjectionFitError> {
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, 1000)
        .ok_or(ProjectionFitError::Degenerate)?;
    let smallest = eigen.eigenvalues.imin();
    let largest = eigen.eigenvalues.max();
    let second = (0..9)
        .filter(|i| *i != smallest)
        .map(|i| eigen.eigenvalues[i])
        .fold(f64::INFINITY, f64::min);
    if second > MIN_EIGENVALUE * largest {
        Ok(eigen.eigenvectors.column(smallest).into_owned())
    } else {
        Err(ProjectionFitError::Degenerate)
    }
}

/// `matrix` as `K R` with positive focal lengths, `R` a rotation, and the skew of `K` dropped.
fn decompose(matrix: &Matrix3<f64>) -> Result<Projection, ProjectionFitError> {
    let [m1, m2, m3] = [0, 1, 2].map(|i| matrix.row(i).transpose());
    let degenerate = ProjectionFitError::Degenerate;
    // Gram-Schmidt from the last row up.
    let scale = m3.norm();
    let r3 = m3.try_normalize(0.0).ok_or(degenerate.clone())?;
    let cy = m2.dot(&r3);
    let across = m2 - r3 * cy;
    let fy = across.norm();
    let r2 = across.try_normalize(0.0).ok_or(degenerate.clone())?;
    let cx = m1.dot(&r3);
    let across = m1 - r3 * cx - r2 * m1.dot(&r2);
    let fx = across.norm();
    let r1 = across.try_normalize(0.0).ok_or(degenerate)?;
    let rotation = Matrix3::from_rows(&[r1.transpose(), r2.transpose(), r3.transpose()]);
    if rotation.determinant() < 0.0 {
        return Err(ProjectionFitError::Mirrored);
    }
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    Ok(Projection {
        fx: fx / scale,
        fy: fy / scale,
        cx: cx / scale,
        cy: cy / scale,
        rotation: UnitQuaternion::from_rotation_matrix(&rotation),
    })
}

/// Hartley's: pixels moved to their mean and scaled to a mean square length of 2.
struct Normalisation {
    centre: Point2<f64>,
    scale: f64,
}

impl Normalisation {
    fn of(pixels: impl Iterator<Item = Point2<f64>> + Clone) -> Self {
        let count = pixels.clone().count().max(1) as f64;
        let sum = pixels.clone().fold(nalgebra::Vector2::zeros(), |sum, p| sum + p.coords);
        let centre = Point2::from(sum / count);
        let square = pixels.map(|p| (p - centre).norm_squared()).sum::<f64>() / count;
        let scale = if square > 0.0 { (2.0 / square).sqrt() } else { 1.0 };
        Self { centre, scale }
    }

    fn apply(&self, pixel: &Point2<f64>) -> [f64; 2] {
        let moved = (pixel - self.centre) * self.scale;
        [moved.x, moved.y]
    }

    /// The matrix from normalised to original pixels.
    fn inverse(&self) -> Matrix3<f64> {
        let unit = 1.0 / self.scale;
        Matrix3::new(unit, 0.0, self.centre.x, 0.0, unit, self.centre.y, 0.0, 0.0, 1.0)
    }
}

//! What was seen of an end-effector, if it were a smooth surface and no end-effector at all.

use super::observed::Observed;
use crate::segment::END_EFFECTOR;
use eyebolt_registration::{geman_mcclure, median};
use nalgebra::{SMatrix, SVector};

/// A surface whose depth is a quadratic function of where it is in the image: plates, tubes and balls are
/// about that, and to any of them a shape can be fitted somehow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothSurface {
    coefficients: SVector<f64, TERMS>,
    middle: [f64; 2],
    scale: f64,
    /// Standard deviation of the depth seen from it, robustly, metres.
    pub deviation_m: f64,
}

const TERMS: usize = 6;
/// Pixels that it is fitted to at most.
const MOST_PIXELS: usize = 2000;
/// Rounds of weighted least squares.
const ROUNDS: usize = 12;
/// Residuals are within a nanometre of nothing only where depth was made up.
const LEAST_M: f64 = 1e-6;

impl SmoothSurface {
    /// Through most of the end-effector's pixels; `None` if there are too few to say.
    pub fn fit(observed: &Observed) -> Option<Self> {
        let image = &observed.image;
        let seen = |at: &usize| image.depth_m[*at] > 0.0 && observed.label[*at] == END_EFFECTOR;
        let all: Vec<usize> = (0..observed.label.len()).filter(seen).collect();
        if all.len() < 4 * TERMS {
            return None;
        }
        let step = all.len().div_ceil(MOST_PIXELS);
        let pixels: Vec<usize> = all.into_iter().step_by(step).collect();
        let along = |axis: usize| {
            let values = pixels.iter().map(|at| f64::from(image.rays[*at][axis]));
            let count = pixels.len() as f64;
            let mean = values.clone().sum::<f64>() / count;
            (mean, (values.map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt())
        };
        let ((u, across), (v, down)) = (along(0), along(1));
        let scale = across.max(down).max(1e-9);
        let mut found = Self {
            coefficients: SVector::zeros(),
            middle: [u, v],
            scale,
            deviation_m: f64::INFINITY,
        };
        let mut off = vec![0.0; pixels.len()];
        for _ in 0..ROUNDS {
            let mut normal = SMatrix::<f64, TERMS, TERMS>::identity() * 1e-9;
            let mut right = SVector::<f64, TERMS>::zeros();
            for at in &pixels {
                let (terms, z) = (found.terms(image.rays[*at]), f64::from(image.depth_m[*at]));
                let off = z - found.coefficients.dot(&terms);
                let weight = geman_mcclure(off, 2.0 * found.deviation_m);
                normal += weight * terms * terms.transpose();
                right += weight * z * terms;
            }
            found.coefficients = normal.cholesky()?.solve(&right);
            for (off, at) in off.iter_mut().zip(&pixels) {
                *off = (f64::from(image.depth_m[*at]) - found.depth_m(image.rays[*at])).abs();
            }
            found.deviation_m = (1.4826 * median(&mut off)?).max(LEAST_M);
        }
        Some(found)
    }

    /// Where it is along a ray `[x, y, 1]`, metres.
    pub fn depth_m(&self, ray: [f32; 2]) -> f64 {
        self.coefficients.dot(&self.terms(ray))
    }

    fn terms(&self, [x, y]: [f32; 2]) -> SVector<f64, TERMS> {
        let u = (f64::from(x) - self.middle[0]) / self.scale;
        let v = (f64::from(y) - self.middle[1]) / self.scale;
        SVector::from([1.0, u, v, u * u, u * v, v * v])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera};

    /// A bowl whose every third pixel is something else, a little or far behind: the bowl is found.
    #[test]
    fn most_pixels_decide() {
        let camera =
            PinholeCamera::new(120, 90, 150.0, 150.0, 59.5, 44.5, Distortion::None).unwrap();
        let bowl =
            |x: f64, y: f64| 1.1 + 0.2 * x - 0.1 * y + 0.8 * x * x + 0.5 * x * y - 0.6 * y * y;
        let ray =
            |at: usize| [(at % 120) as f64 - 59.5, (at / 120) as f64 - 44.5].map(|v| v / 150.0);
        let inside = |at: usize| (40..80).contains(&(at % 120)) && (30..60).contains(&(at / 120));
        let depth_m = |at: usize| {
            let [x, y] = ray(at);
            let behind =
                if at.is_multiple_of(3) { 0.01 + 0.2 * ((at / 3) % 5) as f64 } else { 0.0 };
            (bowl(x, y) + behind) as f32
        };
        let depth = DepthImage::new(120, 90, (0..120 * 90).map(depth_m).collect()).unwrap();
        let label: Vec<u8> =
            (0..120 * 90).map(|at| if inside(at) { END_EFFECTOR } else { 0 }).collect();
        let observed = Observed::new(&depth, &camera, &label, 0.2).unwrap();
        let smooth = SmoothSurface::fit(&observed).unwrap();
        assert!(smooth.deviation_m < 1e-4, "{smooth:?}");
        for [x, y] in [[0.0, 0.0], [0.1, -0.05], [-0.1, 0.08]] {
            let off = smooth.depth_m([x as f32, y as f32]) - bowl(x, y);
            assert!(off.abs() < 2e-4, "{off} at {x} {y}");
        }
    }
}

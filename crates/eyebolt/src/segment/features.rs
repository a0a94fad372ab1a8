//! What a network is told of each pixel.

use super::thinned::Thinned;

/// Names of the features, in their order.
///
/// Geometry alone: no light, no paint, nothing that another laboratory has not. Coordinates are the
/// camera's, so that a network knows how large things are; inverse depth is what noise is even in.
pub const FEATURES: [&str; 8] =
    ["occupancy", "x_m", "y_m", "z_m", "normal_x", "normal_y", "normal_z", "inverse_z_per_m"];

/// Coordinates beyond are as far away as these, metres.
const FAR_M: f32 = 4.0;
/// Inverse depth beyond is as near as this, 1/m.
const NEAR_PER_M: f32 = 4.0;
/// Neighbours belong to one surface if their depths differ by less than this share.
const STEP: f32 = 0.05;

/// Features of every pixel of `image` that has depth, row by row.
pub fn features(image: &Thinned) -> Vec<f32> {
    let mut values = Vec::with_capacity(image.depth_m.len() * FEATURES.len());
    for at in image.seen() {
        let [x, y, z] = image.point(at).map(|value| value.clamp(-FAR_M, FAR_M));
        let [nx, ny, nz] = normal(image, at);
        let inverse_z = (1.0 / image.depth_m[at]).min(NEAR_PER_M);
        values.extend([1.0, x, y, z, nx, ny, nz, inverse_z]);
    }
    values
}

/// Unit normal toward the camera from the neighbours of the same surface; zero where there are none.
pub(super) fn normal(image: &Thinned, at: usize) -> [f32; 3] {
    let (u, v) = (at % image.width, at / image.width);
    let across =
        difference(image, at, (u > 0).then(|| at - 1), (u + 1 < image.width).then(|| at + 1));
    let above = (v > 0).then(|| at - image.width);
    let down = difference(image, at, above, (v + 1 < image.height).then(|| at + image.width));
    let (Some(a), Some(b)) = (across, down) else { return [0.0; 3] };
    // Down times across looks toward the camera.
    let n = [b[1] * a[2] - b[2] * a[1], b[2] * a[0] - b[0] * a[2], b[0] * a[1] - b[1] * a[0]];
    let length = n.iter().map(|value| value * value).sum::<f32>().sqrt();
    if length > 0.0 { n.map(|value| value / length) } else { [0.0; 3] }
}

/// From the neighbour before to the one after, as far as they belong to the surface at `at`.
fn difference(
    image: &Thinned,
    at: usize,
    before: Option<usize>,
    after: Option<usize>,
) -> Option<[f32; 3]> {
    let z = image.depth_m[at];
    let near = |other: &usize| {
        let there = image.depth_m[*other];
        there > 0.0 && (there - z).abs() < STEP * z
    };
    let (from, to) = (before.filter(near).unwrap_or(at), after.filter(near).unwrap_or(at));
    if from == to {
        return None;
    }
    let (a, b) = (image.point(from), image.point(to));
    Some([b[0] - a[0], b[1] - a[1], b[2] - a[2]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera};

    /// A plane `n p = -d` seen by a camera: its normal comes out at every pixel.
    #[test]
    fn normals_of_a_plane_look_at_the_camera() {
        let camera = PinholeCamera::new(32, 24, 30.0, 30.0, 15.5, 11.5, Distortion::None).unwrap();
        let n = nalgebra::Vector3::new(0.2_f64, -0.3, -0.9).normalize();
        let depth = |at: usize| {
            let pixel = nalgebra::Point2::new((at % 32) as f64, (at / 32) as f64);
            (-1.5 / camera.ray(&pixel).unwrap().dot(&n)) as f32
        };
        let depth = DepthImage::new(32, 24, (0..32 * 24).map(depth).collect()).unwrap();
        let image = Thinned::new(&depth, &camera, 32);
        let values = features(&image);
        assert_eq!(values.len(), 32 * 24 * FEATURES.len());
        for row in values.chunks(FEATURES.len()) {
            for (found, right) in row[4..7].iter().zip(n.iter()) {
                assert!((found - *right as f32).abs() < 1e-4, "{row:?} {n}");
            }
            assert!((row[3] * row[7] - 1.0).abs() < 1e-5);
        }
    }
}

use crate::strategies::{config, point};
use eyebolt_registration::DistanceField;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn between_grid_points_values_and_gradients_are_of_the_trilinear_patch(
        coefficients in [-0.1..0.1_f32, -0.1..0.1_f32, -0.1..0.1_f32, -0.1..0.1_f32,
                         -0.1..0.1_f32, -0.1..0.1_f32, -0.1..0.1_f32, -0.1..0.1_f32],
        part in [0.0..1.0_f32, 0.0..1.0_f32, 0.0..1.0_f32],
    ) {
        let voxel = 0.1;
        let corner = |p: &Point3<f32>| {
            let at = p.coords.map(|c| usize::from(c > 0.5 * voxel));
            coefficients[at.x + 2 * at.y + 4 * at.z]
        };
        let field = DistanceField::from_fn(Point3::origin(), voxel, [2; 3], 0.1, corner);
        let sample = field.sample(&Point3::from(part.map(|x| x * voxel)));
        let weight = |bit: usize, x: f32| if bit == 1 { x } else { 1.0 - x };
        let (mut value, mut gradient) = (0.0, Vector3::zeros());
        for (i, c) in coefficients.iter().enumerate() {
            let bits = [i & 1, i >> 1 & 1, i >> 2 & 1];
            let w = [0, 1, 2].map(|axis| weight(bits[axis], part[axis]));
            value += c * w[0] * w[1] * w[2];
            for axis in 0..3 {
                let sign = if bits[axis] == 1 { 1.0 } else { -1.0 };
                gradient[axis] += sign * c * w[(axis + 1) % 3] * w[(axis + 2) % 3] / voxel;
            }
        }
        prop_assert!((sample.distance_m - value).abs() < 5e-6);
        prop_assert!((sample.gradient - gradient).norm() < 2e-4);
    }

    #[test]
    fn the_gradient_is_the_derivative_of_what_is_interpolated(
        points in prop::collection::vec(point(0.09), 50),
    ) {
        let field = DistanceField::from_fn(
            Point3::new(-0.1, -0.1, -0.1), 0.02, [11; 3], 0.2, |p| 0.3 * p.coords.norm() + 0.4 * p.x,
        );
        let h = 4e-4;
        for p in points {
            let gradient = field.sample(&p).gradient;
            for axis in 0..3 {
                let at = (p[axis] + 0.1) / 0.02;
                // The derivative jumps from one patch to the next.
                if (at - at.round()).abs() < 0.05 {
                    continue;
                }
                let step = Vector3::ith(axis, h);
                let ahead = field.sample(&(p + step)).distance_m;
                let numeric = (ahead - field.sample(&(p - step)).distance_m) / (2.0 * h);
                prop_assert!((numeric - gradient[axis]).abs() < 2e-4);
            }
        }
    }
}

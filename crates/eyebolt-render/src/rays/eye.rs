//! Where rays start, and the axes in which a packet of them is described.

use nalgebra::{Matrix3, Vector3};

/// A common origin of rays and a frame about it, in whose positive z they all go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eye {
    /// Units and axes of the scene.
    pub origin: [f32; 3],
    /// `eye_from_scene`, row by row.
    pub rotation: [[f32; 3]; 3],
}

impl Eye {
    pub fn new(origin: &Vector3<f64>, eye_from_scene: &Matrix3<f64>) -> Self {
        let rotation =
            [0, 1, 2].map(|row| [0, 1, 2].map(|column| eye_from_scene[(row, column)] as f32));
        Self { origin: [origin.x, origin.y, origin.z].map(|v| v as f32), rotation }
    }
}

/// A right-handed frame, row by row, whose z goes along a unit vector.
pub(super) fn axes_along(z: &Vector3<f64>) -> Matrix3<f64> {
    let across = Vector3::ith(z.iamin(), 1.0);
    let x = across.cross(z).normalize();
    let y = z.cross(&x);
    Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()])
}

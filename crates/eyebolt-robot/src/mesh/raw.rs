//! A mesh as its file has it.

use nalgebra::Point3;

/// What a reader returns: coordinates as in the file, indices not yet checked.
#[derive(Clone, Debug, Default)]
pub(crate) struct RawMesh {
    pub(crate) positions: Vec<Point3<f32>>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

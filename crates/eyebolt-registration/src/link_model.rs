//! What registration needs to know of one link.

use crate::decimate::simplified;
use crate::distance_field::DistanceField;
use crate::outward::outward;
use crate::surface_sample::{SurfacePoint, sample_surface};
use eyebolt_robot::TriangleMesh;

/// One link's shape in the forms that registration uses, all in the link's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkModel {
    /// Signed distance to the link's outside.
    pub field: DistanceField,
    /// Points spread evenly over the outside.
    pub surface: Vec<SurfacePoint>,
    /// The outside of the mesh for drawing, simplified to about half a millimetre; triangles run
    /// counter-clockwise as seen from outside.
    pub mesh: TriangleMesh,
}

/// Grid spacing of the distance field: a trilinear patch over a 5 cm radius is then off by less
/// than 0.1 mm.
const VOXEL_M: f32 = 0.005;
/// How far the distance field reaches beyond the link.
const MARGIN_M: f32 = 0.06;
/// How far simplifying may move the surface that is drawn: less than a depth camera's noise.
const SIMPLIFY_M: f32 = 0.0004;
const SURFACE_POINTS: usize = 800;

impl LinkModel {
    /// Works the model out from the link's mesh (link frame, metres). Takes up to a second.
    pub fn build(mesh: &TriangleMesh) -> Self {
        let field = DistanceField::build(mesh, VOXEL_M, MARGIN_M);
        let surface = sample_surface(mesh, &field, SURFACE_POINTS);
        let drawn = outward(&simplified(mesh, SIMPLIFY_M), &field);
        Self { field, surface, mesh: drawn }
    }
}

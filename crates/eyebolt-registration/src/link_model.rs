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
/// Points of a link's surface: one for every square centimetre or two of an arm's links.
const SURFACE_POINTS: usize = 800;
/// Grid points of one link's distance field: a box of 0.75 m with its margin. Larger links are
/// sampled more coarsely.
const MOST_POINTS: usize = 4_000_000;
/// Grid points of all links of a robot together, 2 bytes each.
const MOST_POINTS_OF_ALL: usize = 64_000_000;

impl LinkModel {
    /// How many grid points each of `links` links of a robot may have.
    pub fn point_budget(links: usize) -> usize {
        MOST_POINTS.min(MOST_POINTS_OF_ALL / links.max(1))
    }

    /// Works the model out from the mesh of a robot's only link (link frame, metres). Takes up to a
    /// second.
    pub fn build(mesh: &TriangleMesh) -> Self {
        Self::build_within(mesh, Self::point_budget(1))
    }

    /// As [`Self::build`], with a distance field of at most `most_points` grid points.
    pub fn build_within(mesh: &TriangleMesh, most_points: usize) -> Self {
        let field = DistanceField::build(mesh, VOXEL_M, MARGIN_M, most_points);
        let surface = sample_surface(mesh, &field, SURFACE_POINTS);
        let drawn = outward(&simplified(mesh, SIMPLIFY_M), &field);
        Self { field, surface, mesh: drawn }
    }
}

//! The links' meshes, coarse enough for a page.

use super::quantised::Bounds;
use crate::report::coarse::few_enough;
use crate::report::html::base64;
use eyebolt_registration::ArmModel;
use eyebolt_robot::TriangleMesh;
use rayon::prelude::*;
use serde::Serialize;

/// Triangles of all links together.
const MOST_TRIANGLES: usize = 100_000;

/// A link's mesh in its own frame.
#[derive(Debug, Serialize)]
pub(super) struct Shape {
    name: String,
    bounds: Bounds,
    vertices: String,
    /// Indices of vertices, 16 bits little-endian, or 32 if `wide`.
    triangles: String,
    wide: bool,
}

/// The shapes of all links of `arm`.
pub(super) fn shapes(arm: &ArmModel) -> Vec<Shape> {
    let meshes: Vec<&TriangleMesh> = arm.links().iter().map(|link| &link.model.mesh).collect();
    let few = few_enough(&meshes, MOST_TRIANGLES);
    let links = arm.links().par_iter().zip(few);
    links.map(|(link, mesh)| Shape::new(&link.name, &mesh)).collect()
}

impl Shape {
    fn new(name: &str, mesh: &TriangleMesh) -> Self {
        let bounds = Bounds::of(&mesh.vertices);
        let wide = mesh.vertices.len() > usize::from(u16::MAX);
        let indices = mesh.triangles.as_flattened().iter();
        let bytes: Vec<u8> = if wide {
            indices.flat_map(|index| index.to_le_bytes()).collect()
        } else {
            indices.flat_map(|index| (*index as u16).to_le_bytes()).collect()
        };
        Self {
            name: name.to_owned(),
            bounds,
            vertices: bounds.encode(&mesh.vertices),
            triangles: base64::encode(&bytes),
            wide,
        }
    }
}

//! Meshes of the end-effector's links.

use super::error::EndEffectorError;
use crate::record::plausible_mesh;
use eyebolt_geometry::{EndEffector, Link, Transform};
use eyebolt_robot::{Arm, Prefer, TriangleMesh};
use nalgebra::Point3;

/// A link of the end-effector with what it looks like.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Index of the link in [`eyebolt_robot::Robot::links`].
    pub(super) link: usize,
    /// Its surface, link frame.
    pub(super) mesh: TriangleMesh,
}

/// The links of the end-effector that have a shape.
pub(super) fn parts(arm: &Arm) -> Result<Vec<Part>, EndEffectorError> {
    let links = &arm.robot().links;
    // As for the whole arm: links without a visual stand for clearance.
    let visible = links.iter().any(|link| !link.visuals.is_empty());
    let mut parts = Vec::new();
    for index in arm.end_effector_links() {
        let Some(link) = links.get(index) else { continue };
        if (visible && link.visuals.is_empty()) || !link.has_geometry() {
            continue;
        }
        let mesh = plausible_mesh(link, Prefer::Visual)?;
        if !mesh.triangles.is_empty() {
            parts.push(Part { link: index, mesh });
        }
    }
    if parts.is_empty() {
        let (robot, link) = (arm.robot().name.clone(), arm.end_effector_name().to_owned());
        return Err(EndEffectorError::NoShape { robot, link });
    }
    Ok(parts)
}

/// Every vertex with the number of its part, end-effector frame.
pub(super) fn vertices<'a>(
    parts: &'a [Part],
    end_effector_from_parts: &'a [Transform<EndEffector, Link>],
) -> impl Iterator<Item = (usize, Point3<f64>)> + 'a {
    let placed = parts.iter().zip(end_effector_from_parts).enumerate();
    placed.flat_map(|(number, (part, pose))| {
        part.mesh.vertices.iter().map(move |vertex| (number, pose.point(&vertex.cast())))
    })
}

//! Shapes of an arm's links.

use super::error::RecordError;
use eyebolt_registration::{ArmLink, ArmModel, LinkCache, LinkModel};
use eyebolt_robot::{Arm, Link, Prefer, TriangleMesh, link_fingerprint, link_mesh};
use rayon::prelude::*;
use std::sync::Arc;

/// Shapes of those of `links` that have one, and which these are.
pub(crate) fn shapes(
    arm: &Arm,
    links: Vec<usize>,
    cache: &LinkCache,
) -> Result<(Vec<usize>, ArmModel), RecordError> {
    let robot = arm.robot();
    // Links without a visual stand for clearance (the Panda's `_sc`), not for anything to be seen,
    // unless the whole robot is described so.
    let visible = robot.links.iter().any(|link| !link.visuals.is_empty());
    let budget = LinkModel::point_budget(links.len());
    let links: Vec<(usize, ArmLink)> = links
        .into_par_iter()
        .map(|index| {
            let link = &robot.links[index];
            let failed = |source| RecordError::Mesh { link: link.name.clone(), source };
            if visible && link.visuals.is_empty() {
                return Ok(None);
            }
            let prefer = Prefer::Visual;
            let Some(print) = link_fingerprint(link, prefer).map_err(failed)? else {
                return Ok(None);
            };
            let mesh = || plausible_mesh(link, prefer);
            let model = cache.load_or_build(&print.to_string(), budget, mesh)?;
            Ok(Some((index, ArmLink { name: link.name.clone(), model: Arc::new(model) })))
        })
        .collect::<Vec<Result<_, RecordError>>>()
        .into_iter()
        .filter_map(Result::transpose)
        .collect::<Result<_, _>>()?;
    if links.len() > MOST_LINKS {
        return Err(RecordError::TooManyLinks { count: links.len() });
    }
    if links.is_empty() {
        let (robot, base) = (robot.name.clone(), arm.base_name().to_owned());
        return Err(RecordError::NoShapes { robot, base });
    }
    let (indices, links) = links.into_iter().unzip();
    Ok((indices, ArmModel::new(links)))
}

/// Links with shapes that one arm may have.
const MOST_LINKS: usize = 255;
/// No link of an arm is larger than this, metres.
const LARGEST_LINK_M: f32 = 5.0;

/// The mesh of `link`, unless it is larger than any arm.
pub(crate) fn plausible_mesh(link: &Link, prefer: Prefer) -> Result<TriangleMesh, RecordError> {
    let name = || link.name.clone();
    let failed = |source| RecordError::Mesh { link: name(), source };
    let mesh = link_mesh(link, prefer).map_err(failed)?.unwrap_or_default();
    let extent_m = mesh.bounds().map_or(0.0, |(low, high)| (high - low).amax());
    if extent_m > LARGEST_LINK_M {
        return Err(RecordError::HugeLink { link: name(), extent_m });
    }
    Ok(mesh)
}

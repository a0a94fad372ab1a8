//! A target in a picture.

use super::charuco::{self, Board};
use super::described::Target;
use super::layout::Layout;
use crate::detect::{Detection, detect};
use crate::grey::GreyImage;
use crate::sighting::Correspondence;
use nalgebra::Point3;

/// What a picture shows of a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Sighting {
    /// Numbers of the markers that were seen.
    pub ids: Vec<u32>,
    /// Points of the target: corners of its markers, or of its squares if it is a ChArUco board.
    pub points: Vec<Correspondence>,
}

/// Why a picture tells nothing of a target.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotSeen {
    /// None of its markers is in the picture.
    #[error("the marker is not seen")]
    None,
    /// A marker of the target is there twice: which one is meant, nobody can say.
    #[error("marker {id} is seen twice")]
    Twice {
        /// Its number.
        id: u32,
    },
}

impl Target {
    /// All markers of the target's dictionary in `image`, of this target or not.
    pub fn detect(&self, image: &GreyImage) -> Vec<Detection> {
        detect(image, self.dictionary())
    }

    /// What `found`, the markers of `image`, tell of this target, which has a number if it is a tag.
    ///
    /// # Errors
    ///
    /// No marker of it, or one twice.
    pub fn sighting(&self, image: &GreyImage, found: &[Detection]) -> Result<Sighting, NotSeen> {
        let sighting = self.corners_of(found)?;
        let Layout::Charuco { columns, rows, square_m, first_id } = *self.layout() else {
            return Ok(sighting);
        };
        let board = Board { columns, rows, square_m, marker_m: self.marker_m(), first_id };
        let corners = charuco::corners(image, &board, &self.mine(found));
        // Fewer do not make a pose, and corners of tags are nearly as good.
        Ok(if is_spread(&corners) { Sighting { points: corners, ..sighting } } else { sighting })
    }

    /// As [`Self::sighting`], by the corners of the markers alone.
    ///
    /// # Errors
    ///
    /// As there.
    pub fn corners_of(&self, found: &[Detection]) -> Result<Sighting, NotSeen> {
        let mine = self.mine(found);
        let twice = mine.windows(2).find_map(|pair| match pair {
            [(a, _), (b, _)] if a.id == b.id => Some(a.id),
            _ => None,
        });
        if let Some(id) = twice {
            return Err(NotSeen::Twice { id });
        }
        if mine.is_empty() {
            return Err(NotSeen::None);
        }
        let ids = mine.iter().map(|(marker, _)| marker.id).collect();
        let points = mine.iter().flat_map(|(marker, corners)| {
            let each = corners.iter().zip(marker.corners_px);
            each.map(|(point, pixel)| Correspondence { point_in_marker: *point, pixel })
        });
        Ok(Sighting { ids, points: points.collect() })
    }

    /// The markers of `found` that are of this target, with their corners in it.
    fn mine<'a>(&self, found: &'a [Detection]) -> Vec<(&'a Detection, [Point3<f64>; 4])> {
        found.iter().filter_map(|marker| Some((marker, self.corners(marker.id)?))).collect()
    }
}

/// Whether points lie in two columns and two rows at least.
fn is_spread(points: &[Correspondence]) -> bool {
    let differ = |axis: usize| {
        let first = points.first().map(|p| p.point_in_marker[axis]);
        points.iter().any(|p| Some(p.point_in_marker[axis]) != first)
    };
    points.len() >= 4 && differ(0) && differ(1)
}

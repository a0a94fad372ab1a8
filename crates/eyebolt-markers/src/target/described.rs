//! A target: dictionary, sizes, layout.

use super::charuco;
use super::error::{TargetError, check};
use super::layout::Layout;
use crate::dictionary::Dictionary;
use nalgebra::Point3;

/// A tag, a grid of tags, or a ChArUco board.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    dictionary: Dictionary,
    marker_m: f64,
    layout: Layout,
}

impl Target {
    /// Markers of `dictionary` whose black squares have sides of `marker_m` metres.
    ///
    /// # Errors
    ///
    /// Sizes that are not positive, tags that are not in the dictionary, boards without tags.
    pub fn new(dictionary: Dictionary, marker_m: f64, layout: Layout) -> Result<Self, TargetError> {
        check(&dictionary, marker_m, &layout)?;
        Ok(Self { dictionary, marker_m, layout })
    }

    /// Where its markers are from.
    pub fn dictionary(&self) -> &Dictionary {
        &self.dictionary
    }

    /// Side of a tag's black square, metres.
    pub fn marker_m(&self) -> f64 {
        self.marker_m
    }

    /// How its markers lie.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The same with tag `id`, where it is one tag of any number.
    #[must_use]
    pub fn with_id(&self, id: u32) -> Self {
        match self.layout {
            Layout::Tag { id: None } => {
                Self { layout: Layout::Tag { id: Some(id) }, ..self.clone() }
            }
            _ => self.clone(),
        }
    }

    /// Corners of marker `id`, clockwise from its upper left one as it is printed, in the target's frame
    /// ([`Marker`](crate::Marker)): metres. `None` if it is not of this target.
    pub fn corners(&self, id: u32) -> Option<[Point3<f64>; 4]> {
        let (left, top) = self.place(id)?;
        let side = self.marker_m;
        let corner = |x: f64, y: f64| Point3::new(left + x * side, top + y * side, 0.0);
        Some([corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)])
    }

    /// Width and height of the whole, metres.
    pub fn size_m(&self) -> (f64, f64) {
        match self.layout {
            Layout::Tag { .. } => (self.marker_m, self.marker_m),
            Layout::Grid { columns, rows, gap_m, .. } => {
                let long = |count: u32| f64::from(count) * (self.marker_m + gap_m) - gap_m;
                (long(columns), long(rows))
            }
            Layout::Charuco { columns, rows, square_m, .. } => {
                (f64::from(columns) * square_m, f64::from(rows) * square_m)
            }
        }
    }

    /// Numbers of its markers; none for a tag of any number.
    pub fn ids(&self) -> std::ops::Range<u32> {
        match self.layout {
            Layout::Tag { id } => id.map_or(0..0, |id| id..id + 1),
            Layout::Grid { columns, rows, first_id, .. } => first_id..first_id + columns * rows,
            Layout::Charuco { columns, rows, first_id, .. } => {
                first_id..first_id + columns * rows / 2
            }
        }
    }

    /// The upper left corner of marker `id`.
    fn place(&self, id: u32) -> Option<(f64, f64)> {
        if !self.ids().contains(&id) {
            return None;
        }
        match self.layout {
            Layout::Tag { .. } => Some((-0.5 * self.marker_m, -0.5 * self.marker_m)),
            Layout::Grid { columns, gap_m, first_id, .. } => {
                let number = id - first_id;
                let pitch = self.marker_m + gap_m;
                Some((f64::from(number % columns) * pitch, f64::from(number / columns) * pitch))
            }
            Layout::Charuco { columns, square_m, first_id, .. } => {
                let (column, row) = charuco::square(id - first_id, columns);
                let margin = 0.5 * (square_m - self.marker_m);
                Some((f64::from(column) * square_m + margin, f64::from(row) * square_m + margin))
            }
        }
    }
}

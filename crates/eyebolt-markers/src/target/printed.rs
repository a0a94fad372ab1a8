//! What a target looks like: for those who draw it.

use super::described::Target;
use super::layout::Layout;

/// The white margin around a target, in cells of its markers: detectors need one.
const MARGIN_CELLS: f64 = 1.5;

impl Target {
    /// Width of the white margin around the target as it is printed, metres.
    pub fn margin_m(&self) -> f64 {
        MARGIN_CELLS * self.cell_m()
    }

    /// Side of one cell of a marker, metres.
    fn cell_m(&self) -> f64 {
        self.marker_m() / (self.dictionary().side() + 2) as f64
    }

    /// Whether the printed target is white at a point of its plane (metres, in its own frame); `None` off the
    /// sheet with its margin. A tag of any number is a white sheet.
    pub fn is_white_at(&self, x: f64, y: f64) -> Option<bool> {
        let (wide, high) = self.size_m();
        let (left, top) = match self.layout() {
            Layout::Tag { .. } => (-0.5 * wide, -0.5 * high),
            _ => (0.0, 0.0),
        };
        let inside = |margin: f64| {
            x > left - margin
                && y > top - margin
                && x < left + wide + margin
                && y < top + high + margin
        };
        if !inside(self.margin_m()) {
            return None;
        }
        let (cell, cells) = (self.cell_m(), (self.dictionary().side() + 2) as f64);
        for id in self.ids() {
            let [corner, ..] = self.corners(id)?;
            let (column, row) = (((x - corner.x) / cell).floor(), ((y - corner.y) / cell).floor());
            if (0.0..cells).contains(&column) && (0.0..cells).contains(&row) {
                return self.dictionary().is_white(id, row as usize, column as usize);
            }
        }
        if let Layout::Charuco { square_m, .. } = self.layout() {
            let (column, row) = ((x / square_m).floor() as i64, (y / square_m).floor() as i64);
            return Some(!inside(0.0) || (column + row) % 2 != 0);
        }
        Some(true)
    }
}

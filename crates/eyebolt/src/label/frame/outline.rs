//! How far pixels are from the arm's outline, and from that of its end-effector.

use super::specks::without_specks;
use eyebolt_geometry::Mask;
use eyebolt_registration::{ArmModel, Label, Labels};
use eyebolt_render::Raster;
use std::ops::Range;

/// Depth of the arm is found this far beside it, pixels: half of the window of most stereo cameras.
const BORDER_PX: usize = 30;

/// The rectangle about the arm, with distances between pixels that show different things.
#[derive(Debug)]
pub(super) struct Outline {
    columns: Range<usize>,
    rows: Range<usize>,
    image_width: usize,
    drawn: Labels,
    to_robot_px: Vec<f32>,
    to_rest_px: Vec<f32>,
    to_arm_px: Vec<f32>,
    to_end_effector_px: Vec<f32>,
}

impl Outline {
    /// That of the arm as `raster` has it; if there is a mask, the outline is the mask's.
    pub(super) fn new(arm: &ArmModel, raster: &Raster, mask: Option<&Mask>) -> Self {
        let (width, height) = (raster.width(), raster.height());
        let (columns, rows) = match mask {
            Some(_) => (0..width, 0..height),
            None => about(raster),
        };
        let link = |u: usize, v: usize| match raster.link(v * width + u) {
            None => Label::Background,
            Some(link) if arm.is_end_effector(usize::from(link)) => Label::EndEffector,
            Some(_) => Label::Arm,
        };
        let drawn = Labels::from_fn(columns.clone(), rows.clone(), |u, v| {
            match (mask.map(|mask| mask.at(u as u32, v as u32)), link(u, v)) {
                (None, link) => link,
                (Some(false), _) => Label::Background,
                // Which part it is tells what is near it.
                (Some(true), Label::Background) => Label::Ignore,
                (Some(true), link) => link,
            }
        });
        let drawn = without_specks(drawn);
        let is_robot = |label: Label| label != Label::Background;
        Self {
            to_robot_px: drawn.distance_where(is_robot),
            to_rest_px: drawn.distance_to(Label::Background),
            to_arm_px: drawn.distance_to(Label::Arm),
            to_end_effector_px: drawn.distance_to(Label::EndEffector),
            image_width: width,
            columns,
            rows,
            drawn,
        }
    }

    /// Row-major pixels of the image in the rectangle, in their order.
    pub(super) fn pixels(&self) -> impl Iterator<Item = usize> + '_ {
        let columns = self.columns.clone();
        let row = move |v: usize| columns.clone().map(move |u| v * self.image_width + u);
        self.rows.clone().flat_map(row)
    }

    /// What the drawn arm, or the mask, has at `place` of [`Self::pixels`].
    pub(super) fn label(&self, place: usize) -> Label {
        let width = self.columns.len().max(1);
        let (u, v) = (self.columns.start + place % width, self.rows.start + place / width);
        self.drawn.at(u, v).unwrap_or(Label::Background)
    }

    /// Distance from the outline, in pixels: positive on the arm.
    pub(super) fn inside_px(&self, place: usize) -> f32 {
        match self.label(place) {
            Label::Background => 0.5 - self.to_robot_px[place],
            _ => self.to_rest_px[place] - 0.5,
        }
    }

    /// Distance from the outline between end-effector and arm, in pixels.
    pub(super) fn to_other_class_px(&self, place: usize) -> f32 {
        match self.label(place) {
            Label::Arm => self.to_end_effector_px[place] - 0.5,
            _ => self.to_arm_px[place] - 0.5,
        }
    }
}

fn about(raster: &Raster) -> (Range<usize>, Range<usize>) {
    let (columns, rows) = raster.drawn();
    let widen = |range: Range<usize>, limit: usize| {
        range.start.saturating_sub(BORDER_PX)..(range.end + BORDER_PX).min(limit)
    };
    (widen(columns, raster.width()), widen(rows, raster.height()))
}

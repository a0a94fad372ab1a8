//! The arm's outline as the camera saw it.

use crate::bit_image::BitImage;
use crate::image_distance::distance_to;
use eyebolt_geometry::Mask;
use nalgebra::{Point2, Vector2};
use std::ops::Range;

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Label {
    /// Something that is not the arm.
    Background,
    /// The arm; its end-effector too, where nobody told the two apart.
    Arm,
    /// The end-effector.
    EndEffector,
    /// Nobody can say, or it does not matter: never evidence for anything.
    Ignore,
}

impl Label {
    /// Whether it is the arm or its end-effector.
    pub fn is_robot(self) -> bool {
        matches!(self, Self::Arm | Self::EndEffector)
    }
}

/// Labels of a rectangle of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    columns: Range<usize>,
    rows: Range<usize>,
    labels: Vec<Label>,
}

impl Labels {
    /// The labels that `label(u, v)` gives the pixels of a rectangle.
    pub fn from_fn(
        columns: Range<usize>,
        rows: Range<usize>,
        mut label: impl FnMut(usize, usize) -> Label,
    ) -> Self {
        let mut labels = Vec::with_capacity(columns.len() * rows.len());
        for v in rows.clone() {
            labels.extend(columns.clone().map(|u| label(u, v)));
        }
        Self { columns, rows, labels }
    }

    /// Columns of the image that are labelled.
    pub fn columns(&self) -> Range<usize> {
        self.columns.clone()
    }

    /// Rows of the image that are labelled.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// Label of pixel `(u, v)` of the image; outside the rectangle there is none.
    pub fn at(&self, u: usize, v: usize) -> Option<Label> {
        if !self.columns.contains(&u) || !self.rows.contains(&v) {
            return None;
        }
        let at = (v - self.rows.start) * self.columns.len() + (u - self.columns.start);
        self.labels.get(at).copied()
    }

    /// Distance in pixels from each pixel of the rectangle to the nearest one with `label`.
    pub fn distance_to(&self, label: Label) -> Vec<f32> {
        self.distance_where(|other| other == label)
    }

    /// Distance in pixels from each pixel of the rectangle to the nearest one without `label`.
    pub fn distance_out_of(&self, label: Label) -> Vec<f32> {
        self.distance_where(|other| other != label)
    }

    /// Distance in pixels from each pixel of the rectangle to the nearest one whose label `counts`.
    pub fn distance_where(&self, counts: impl Fn(Label) -> bool) -> Vec<f32> {
        let set: Vec<bool> = self.labels.iter().map(|l| counts(*l)).collect();
        distance_to(&set, self.columns.len(), self.rows.len())
    }

    /// Pixels of the rectangle that a disc of `radius` pixels covers which holds only `label`:
    /// morphological opening.
    pub fn opened(&self, label: Label, radius: f32) -> Vec<bool> {
        let rest = self.bits(|other| other != label);
        rest.dilated(radius).inverted().dilated(radius).to_bools()
    }

    /// Whether each pixel of the rectangle is no farther than a small `radius`, in pixels, from one
    /// whose label `counts`.
    pub fn near(&self, radius: f32, counts: impl Fn(Label) -> bool) -> Vec<bool> {
        self.bits(counts).dilated(radius).to_bools()
    }

    fn bits(&self, counts: impl Fn(Label) -> bool) -> BitImage {
        let (width, height) = (self.columns.len(), self.rows.len());
        BitImage::from_fn(width, height, |at| counts(self.labels[at]))
    }

    /// The pixels of the arm and its end-effector, in an image of `width` by `height` pixels.
    pub fn robot_mask(&self, width: u32, height: u32) -> Mask {
        let mut set = vec![false; width as usize * height as usize];
        let columns = self.columns.clone();
        for (v, labels) in self.rows.clone().zip(self.labels.chunks(columns.len().max(1))) {
            let row = set.get_mut(v * width as usize..).unwrap_or_default();
            for (is_robot, label) in
                row.iter_mut().take(width as usize).skip(columns.start).zip(labels)
            {
                *is_robot = label.is_robot();
            }
        }
        Mask::new(width, height, set).expect("as many pixels as the image")
    }

    /// The same rectangle with each label replaced by `relabel(u, v, label)`.
    #[must_use]
    pub fn mapped(mut self, mut relabel: impl FnMut(usize, usize, Label) -> Label) -> Self {
        let width = self.columns.len().max(1);
        for (at, label) in self.labels.iter_mut().enumerate() {
            let (u, v) = (self.columns.start + at % width, self.rows.start + at / width);
            *label = relabel(u, v, *label);
        }
        self
    }

    /// How many pixels have `label`.
    pub fn count(&self, label: Label) -> usize {
        self.labels.iter().filter(|l| **l == label).count()
    }
}

/// Signed distance in the image to the outline between arm and background.
#[derive(Clone, Debug, PartialEq)]
pub struct Silhouette {
    columns: Range<usize>,
    rows: Range<usize>,
    /// Pixels from the outline, negative on the arm; NaN where the outline is not known.
    signed: Vec<f32>,
}

/// The outline counts only where nothing unknown is nearer than itself and this many pixels.
const CLEARANCE_PX: f32 = 3.0;

impl Silhouette {
    /// The outline in `labels`. It runs in the middle between the last pixel of the arm and the
    /// first of the background, to half a pixel.
    pub fn new(labels: &Labels) -> Self {
        let to = |counts: fn(Label) -> bool| labels.distance_where(counts);
        let (to_arm, (to_background, to_ignored)) = rayon::join(
            || to(Label::is_robot),
            || {
                rayon::join(
                    || to(|label| label == Label::Background),
                    || to(|label| label == Label::Ignore),
                )
            },
        );
        let signed = (0..to_arm.len()).map(|at| {
            let distance = match (to_arm[at], to_background[at]) {
                (arm, 0.0) => arm - 0.5,
                (0.0, background) => 0.5 - background,
                _ => return f32::NAN,
            };
            let known = distance.is_finite() && distance.abs() + CLEARANCE_PX < to_ignored[at];
            if known { distance } else { f32::NAN }
        });
        Self { signed: signed.collect(), columns: labels.columns(), rows: labels.rows() }
    }

    /// Signed distance to the outline at `pixel`, in pixels, and its gradient; `None` where the
    /// outline is not known.
    pub fn sample(&self, pixel: &Point2<f32>) -> Option<(f32, Vector2<f32>)> {
        let (x, y) = (pixel.x - self.columns.start as f32, pixel.y - self.rows.start as f32);
        let (width, height) = (self.columns.len(), self.rows.len());
        if !(x >= 0.0 && y >= 0.0 && x < width as f32 - 1.0 && y < height as f32 - 1.0) {
            return None;
        }
        let (u, v) = (x as usize, y as usize);
        let (x, y) = (x - u as f32, y - v as f32);
        let at = v * width + u;
        let (a, b) = (self.signed[at], self.signed[at + 1]);
        let (c, d) = (self.signed[at + width], self.signed[at + width + 1]);
        let (top, bottom) = (a + (b - a) * x, c + (d - c) * x);
        let gradient = Vector2::new((b - a) * (1.0 - y) + (d - c) * y, bottom - top);
        let distance = top + (bottom - top) * y;
        distance.is_finite().then_some((distance, gradient))
    }
}

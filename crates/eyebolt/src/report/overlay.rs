//! A posed arm over what the camera saw.

use super::legend::{self, Line};
use super::picture::{Picture, Rgb};
use super::{backdrop, residual};
use crate::observations::{Configuration, ImageSource, Observations};
use crate::pipeline::Outcome;
use eyebolt_geometry::{Base, Camera, Mask, PinholeCamera, Transform};
use eyebolt_recording::ColorImage;
use eyebolt_registration::Posture;
use eyebolt_render::{ContourPoint, Raster, contour};

/// Of the outline.
pub const OUTLINE: [u8; 3] = [40, 255, 70];
const MASK_EDGE: Rgb = [255, 225, 0];
/// Opacity of edges of one part of the arm before another.
const INNER: f32 = 0.45;

/// [`overlay`] of every configuration of `outcome` in turn, over what `color` finds for it; nothing
/// without a pose.
///
/// Colour is asked for only where the images are those of a camera.
pub fn overlays<'a>(
    outcome: &'a Outcome,
    mut color: impl FnMut(&Configuration) -> Option<ColorImage> + 'a,
) -> impl Iterator<Item = Picture> + 'a {
    let parts = outcome.observations.as_ref().zip(outcome.calibration.refinement.as_ref());
    parts.into_iter().flat_map(move |(observations, refinement)| {
        let mut raster = Raster::new(&observations.camera);
        let of_a_camera = observations.source != ImageSource::DrawnClouds;
        let draw = |(configuration, posture): (&Configuration, &Posture)| {
            let color = of_a_camera.then(|| color(configuration)).flatten();
            let drawn = Drawn { configuration, posture, color: color.as_ref() };
            overlay(observations, &drawn, &mut raster, &refinement.camera_from_base)
        };
        let postures = outcome.postures();
        observations.configurations.iter().zip(&postures).map(draw).collect::<Vec<_>>()
    })
}

/// What an overlay is drawn of.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// What was seen.
    pub configuration: &'a Configuration,
    /// Where the links are drawn.
    pub posture: &'a Posture,
    /// A picture to lie behind everything.
    pub color: Option<&'a ColorImage>,
}

/// One configuration with the arm posed at `camera_from_base` drawn over it, of the camera's size.
///
/// Behind everything lies the colour picture, stretched where its size is another, or else the depth image
/// (near is bright). On it the distances of what was seen from the model, blue where it is nearer,
/// red where farther, and striped where the camera saw through the model; the model's outline in
/// green, that of the recording's mask in yellow; and a legend if there is room for it.
/// `raster` is drawn anew.
pub fn overlay(
    observations: &Observations,
    drawn: &Drawn<'_>,
    raster: &mut Raster,
    camera_from_base: &Transform<Camera, Base>,
) -> Picture {
    let Drawn { configuration, posture, color } = *drawn;
    let camera = &observations.camera;
    raster.draw(camera, &posture.meshes(&observations.arm, camera_from_base));
    let mut picture = match color {
        Some(color) => backdrop::from_color(color, camera.width(), camera.height()),
        None => backdrop::from_depth(&configuration.depth),
    };
    let summary = residual::paint(&mut picture, observations, configuration, raster);
    if let Some(mask) = &configuration.mask {
        paint_edge(&mut picture, mask);
    }
    paint_outline(&mut picture, raster, camera);
    let mut lines = vec![Line { color: OUTLINE, text: "model" }];
    if configuration.mask.is_some() {
        lines.push(Line { color: MASK_EDGE, text: "mask" });
    }
    legend::paint(&mut picture, &configuration.frames, summary, &lines);
    picture
}

/// Pixels of the mask that border on one outside it; the rim of the image is no border.
fn paint_edge(picture: &mut Picture, mask: &Mask) {
    let (width, set) = (mask.width() as usize, mask.as_slice());
    let rows = set.chunks_exact(width);
    for (v, row) in rows.enumerate() {
        let above = v.checked_sub(1).and_then(|v| set.get(v * width..)).unwrap_or(row);
        let below = set.get((v + 1) * width..).filter(|rest| !rest.is_empty()).unwrap_or(row);
        for (u, inside) in row.iter().enumerate() {
            let left = row[u.saturating_sub(1)];
            let right = row[(u + 1).min(width - 1)];
            if *inside && !(left && right && above[u] && below[u]) {
                picture.blend(v * width + u, MASK_EDGE, 1.0);
            }
        }
    }
}

/// Row-major pixels of the outline of what was drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OutlinePixels {
    /// Two pixels wide: the drawing's last and the first beyond.
    pub outer: Vec<usize>,
    /// Edges of one part of the drawing before another, on the part that is before.
    pub inner: Vec<usize>,
}

impl OutlinePixels {
    /// Of what `raster` shows of `camera`'s image.
    pub fn of(raster: &Raster, camera: &PinholeCamera) -> Self {
        let points = contour(raster, camera);
        let (outer, inner): (Vec<_>, Vec<_>) =
            points.iter().partition(|point| point.behind_m.is_none());
        let sides = |point: &ContourPoint| sides(point, raster.width());
        Self {
            outer: outer.into_iter().flat_map(sides).collect(),
            inner: inner.into_iter().map(|point| sides(point)[0]).collect(),
        }
    }
}

/// The outline; edges within the arm dimmer.
fn paint_outline(picture: &mut Picture, raster: &Raster, camera: &PinholeCamera) {
    let OutlinePixels { outer, inner } = OutlinePixels::of(raster, camera);
    inner.into_iter().for_each(|at| picture.blend(at, OUTLINE, INNER));
    outer.into_iter().for_each(|at| picture.blend(at, OUTLINE, 1.0));
}

/// Row-major pixels at a place of the contour: the surface's last and the first beyond.
fn sides(point: &ContourPoint, width: usize) -> [usize; 2] {
    // Between two pixels of a row the column is halved, else the row is.
    let halved = point.pixel.map(f32::fract);
    let step = halved.coords.component_mul(&point.outward.map(f32::signum));
    let index =
        |pixel: nalgebra::Point2<f32>| pixel.y.round() as usize * width + pixel.x.round() as usize;
    [index(point.pixel - step), index(point.pixel + step)]
}

//! Where the end-effector ends, by a network that looks at it from near.

use super::classes::{ARM, CLASSES, END_EFFECTOR};
use super::error::SegmentError;
use super::middle::middle;
use super::thinned::Thinned;
use super::told::Told;
use super::upsample::upsample;
use super::window::{Part, WINDOW_FEATURES, Window, part_around};
use eyebolt_geometry::{DepthImage, PinholeCamera, RayTable};
use eyebolt_net::models::{Architecture, Model};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix};
use std::collections::BTreeMap;

/// A network that tells the end-effector from the arm and from what is around, in a window at the
/// camera's full resolution: of a whole frame at 160 columns a hand has too few pixels.
#[derive(Debug)]
pub struct EndEffectorNet {
    model: Model,
    executor: Cpu,
    half_m: f32,
}

/// What is found in a window.
pub(super) struct Found {
    image: Thinned,
    part: Part,
    window: Window,
    logits: Matrix,
    /// Area of the end-effector, as its pixels times their depths squared, by how sure the network is of each.
    pub(super) area: f64,
    /// Middle of it, camera frame, metres; that of the window if there is none.
    middle: [f32; 3],
}

/// A window that is laid anew, around the middle of what was found, may show less of it by this share.
const LESS: f64 = 0.15;

impl EndEffectorNet {
    /// Of a model.
    ///
    /// # Errors
    ///
    /// It is a model of something else.
    pub fn new(model: Model) -> Result<Self, SegmentError> {
        let about = &model.description;
        let other = |field, problem: String| Err(SegmentError::OtherModel { field, problem });
        if about.features != WINDOW_FEATURES {
            return other("features", format!("{:?} are not {WINDOW_FEATURES:?}", about.features));
        }
        if about.classes != CLASSES || !matches!(about.architecture, Architecture::Minkunet(_)) {
            return other("classes", format!("{:?} are not {CLASSES:?}", about.classes));
        }
        let Some(edge_m) = about.window_m else {
            return other("window_m", "missing; say how wide the window is".into());
        };
        Ok(Self { model, executor: Cpu::new(), half_m: 0.5 * edge_m })
    }

    /// Labels of the pixels of `depth` about the end-effector, anew; that label is taken from all others.
    ///
    /// It is looked for where `label` has it and all along the arm, and is where the network is surest of most of it:
    /// of whole frames at 160 columns a wrist is easily taken for a hand.
    ///
    /// # Errors
    ///
    /// No memory.
    pub fn refine(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        rays: &RayTable,
        told: &mut Told,
    ) -> Result<(), SegmentError> {
        let found = self.found(depth, camera, rays, &told.label)?;
        told.label
            .iter_mut()
            .filter(|label| **label == END_EFFECTOR)
            .for_each(|label| *label = ARM);
        match found.into_iter().next() {
            Some(best) => self.paint(depth, camera, best, told),
            None => Ok(()),
        }
    }

    /// What may be the end-effector, where `label` has it and all along the arm: the surest first, each a window apart
    /// from those before.
    pub(super) fn found(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        rays: &RayTable,
        label: &[u8],
    ) -> Result<Vec<Found>, SegmentError> {
        let mut all = Vec::new();
        for place in self.places(depth, rays, label) {
            all.extend(self.look(depth, camera, place)?.filter(|found| found.area > 0.0));
        }
        all.sort_by(|a: &Found, b| b.area.total_cmp(&a.area));
        let mut apart: Vec<Found> = Vec::new();
        for found in all {
            let near = |other: &Found| off(other.middle, found.middle) < self.half_m.powi(2);
            if !apart.iter().any(near) {
                apart.push(found);
            }
        }
        Ok(apart)
    }

    /// Labels the pixels of what was `found`, which is looked at again from its middle.
    pub(super) fn paint(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        found: Found,
        told: &mut Told,
    ) -> Result<(), SegmentError> {
        let again = self.look(depth, camera, found.middle)?;
        let again = again.filter(|again| again.area >= (1.0 - LESS) * found.area);
        let Found { image, part, window, logits, middle, .. } = &again.unwrap_or(found);
        let range = middle[2] - self.half_m..middle[2] + self.half_m;
        upsample(depth, (image, &window.pixels, logits), part, &range, told);
        Ok(())
    }

    /// Where the end-effector may be: where it was found, and one place in each cube of the arm farther away.
    fn places(&self, depth: &DepthImage, rays: &RayTable, label: &[u8]) -> Vec<[f32; 3]> {
        let point = |at: usize| <[f32; 3]>::from(rays.point(at, depth.depth_m()[at]));
        let of = |wanted: u8| (0..label.len()).filter(move |at| label[*at] == wanted).map(point);
        let found = middle(of(END_EFFECTOR));
        let mut cubes: BTreeMap<[i32; 3], Vec<[f32; 3]>> = BTreeMap::new();
        for point in of(ARM) {
            let cube = point.map(|value| (value / self.half_m).floor() as i32);
            cubes.entry(cube).or_default().push(point);
        }
        let farther =
            |place: &[f32; 3]| found.is_none_or(|found| off(*place, found) > self.half_m.powi(2));
        let along = cubes.into_values().filter_map(middle).filter(farther);
        found.into_iter().chain(along).collect()
    }

    fn look(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        place: [f32; 3],
    ) -> Result<Option<Found>, SegmentError> {
        let Some((image, part)) = part_around(depth, camera, place, self.half_m) else {
            return Ok(None);
        };
        let Some(window) = Window::new(&image, place, self.half_m) else { return Ok(None) };
        let Model { graph, parameters, .. } = &self.model;
        let batch = window_batch(graph, &[&window])?;
        let logits = self.executor.infer(graph, parameters, &batch)?.swap_remove(0);
        let sure = window.pixels.iter().zip(0..).map(|(at, row)| (*at, sure_of(logits.row(row))));
        let sure: Vec<(usize, f64)> = sure.filter(|(_, sure)| *sure > 0.0).collect();
        let area = |(at, sure): &(usize, f64)| sure * f64::from(image.depth_m[*at]).powi(2);
        let area = sure.iter().map(area).sum::<f64>() * (image.step * image.step) as f64;
        let middle = middle(sure.iter().map(|(at, _)| image.point(*at))).unwrap_or(place);
        tracing::trace!(?middle, area, pixels = sure.len(), "may be the end-effector");
        Ok(Some(Found { image, part, window, logits, area, middle }))
    }
}

/// Squared distance, square metres.
fn off(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum()
}

/// By how much the end-effector is likelier than not, 0 to 1, by a row of logits.
fn sure_of(logits: &[f32]) -> f64 {
    let own = logits[usize::from(END_EFFECTOR)];
    let total: f32 = logits.iter().map(|logit| (logit - own).exp()).sum();
    (2.0 / f64::from(total) - 1.0).max(0.0)
}

/// Windows as a network takes them.
///
/// # Errors
///
/// Another network, or no window.
pub fn window_batch(graph: &Graph, windows: &[&Window]) -> Result<Batch, eyebolt_net::Error> {
    let values: Vec<f32> = windows.iter().flat_map(|window| &window.features).copied().collect();
    let rows = windows.iter().map(|window| window.cells.len()).sum();
    let cells: Vec<&[[u32; 2]]> = windows.iter().map(|window| window.cells.as_slice()).collect();
    Batch::from_images(graph, &cells, &Matrix::new(rows, WINDOW_FEATURES.len(), values)?)
}

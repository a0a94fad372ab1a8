//! How well a frame supports a pose of an end-effector.

use super::observed::Observed;
use super::shape::EndEffectorShape;
use super::through::seen_through;
use crate::segment::END_EFFECTOR;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::Posture;
use eyebolt_render::Raster;

/// How well a frame supports a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// Mean over all pixels that say something, 0 to 1: how far the depth seen is from that of the posed shape, squared,
    /// in units of three standard deviations; 1 for pixels that contradict it.
    pub cost: f64,
    /// Pixels that say something.
    pub pixels: usize,
    /// Of the end-effector's pixels, the share on the posed shape.
    pub explained: f64,
    /// Of the posed shape's pixels with depth that is not in front of it, the share where depth is behind it; of an answer, without
    /// matches that failed.
    pub seen_through: f64,
    /// Of the posed shape's pixels with depth, the share that shows the shape: the rest is hidden by something before it, or seen through.
    pub shown: f64,
    /// Of the posed shape's outline, the share beyond which the surface goes on as if it were not there: where it is
    /// mounted, and all around if it is a part of something larger.
    pub goes_on: f64,
}

/// Draws poses and compares them with a frame.
pub struct Judge<'a> {
    shape: &'a EndEffectorShape,
    observed: &'a Observed,
    raster: Raster,
}

impl<'a> Judge<'a> {
    /// Of poses of `shape` in what was `observed`.
    pub fn new(shape: &'a EndEffectorShape, observed: &'a Observed) -> Self {
        Self { shape, observed, raster: Raster::new(&observed.camera) }
    }

    /// Draws the shape at a pose.
    pub fn draw(&mut self, posture: &Posture, pose: &Transform<Camera, Base>) -> &Raster {
        let meshes = posture.meshes(&self.shape.model, pose);
        self.raster.draw(&self.observed.camera, &meshes);
        &self.raster
    }

    /// What the frame says of the shape at `pose`, by depth with this standard deviation, metres.
    ///
    /// Pixels that say something: those of the end-effector, and those of the posed shape where nothing is before
    /// it. The camera cannot see through a shape, and what it saw of the end-effector has to be on it.
    pub fn support(
        &mut self,
        posture: &Posture,
        pose: &Transform<Camera, Base>,
        deviation_m: f64,
    ) -> Support {
        self.draw(posture, pose);
        let reach = (3.0 * deviation_m) as f32;
        let with_depth = |at: &usize| self.observed.image.depth_m[*at] > 0.0;
        let with_depth = self.raster.pixels().filter(with_depth).count();
        let mut sums = Sums { with_depth, ..Sums::default() };
        for at in 0..self.observed.label.len() {
            let Some(said) = self.said(at, reach) else { continue };
            sums.drawn += usize::from(said.drawn);
            sums.through += usize::from(said.through);
            sums.shown += usize::from(said.drawn && said.cost < 1.0);
            sums.add(f64::from(said.cost), self.observed.label[at] == END_EFFECTOR);
        }
        Support { goes_on: self.goes_on(reach), ..sums.support() }
    }

    /// The cost of each pixel that says something, as [`Self::support`] has it.
    pub fn costs(
        &mut self,
        posture: &Posture,
        pose: &Transform<Camera, Base>,
        deviation_m: f64,
    ) -> Vec<Option<f32>> {
        self.draw(posture, pose);
        let reach = (3.0 * deviation_m) as f32;
        let pixels = 0..self.observed.label.len();
        pixels.map(|at| self.said(at, reach).map(|said| said.cost)).collect()
    }

    /// As [`Self::support`], where failed matches are told from what the camera saw through the shape: slower, and of use where
    /// one pose is looked at closely.
    pub fn close_support(
        &mut self,
        posture: &Posture,
        pose: &Transform<Camera, Base>,
        deviation_m: f64,
    ) -> Support {
        let support = self.support(posture, pose, deviation_m);
        let reach_m = 3.0 * deviation_m;
        let all = 0..self.observed.label.len();
        let said: Vec<_> = all.map(|at| self.said(at, reach_m as f32)).collect();
        let on = |said: &Option<Said>| said.as_ref().is_some_and(|said| said.drawn);
        let behind: Vec<bool> =
            said.iter().map(|said| said.as_ref().is_some_and(|said| said.through)).collect();
        let drawn: Vec<bool> =
            (0..said.len()).map(|at| self.raster.depth_m(at).is_some()).collect();
        let distance_m = self.observed.middle().z;
        let image = &self.observed.image;
        let through = seen_through(image, (&behind, &drawn), (reach_m, distance_m));
        let failed = behind.iter().zip(&through).filter(|(behind, through)| **behind && !**through);
        let says = said.iter().filter(|said| on(said)).count() - failed.count();
        let through = through.into_iter().filter(|through| *through).count();
        Support { seen_through: through as f64 / says.max(1) as f64, ..support }
    }

    /// Depth of the shape as it was drawn last, at a pixel where it is, metres.
    pub fn drawn_m(&self, at: usize) -> Option<f32> {
        self.raster.depth_m(at)
    }

    /// What was observed.
    pub fn observed(&self) -> &Observed {
        self.observed
    }

    /// What a pixel says of the shape as it was drawn last.
    fn said(&self, at: usize, reach_m: f32) -> Option<Said> {
        let of_it = self.observed.label[at] == END_EFFECTOR;
        let seen = self.observed.image.depth_m[at];
        if seen <= 0.0 {
            return None;
        }
        let Some(drawn) = self.raster.depth_m(at) else {
            return of_it.then_some(Said { cost: 1.0, drawn: false, through: false });
        };
        let off = (seen - drawn) / reach_m;
        // Else something is before it.
        let says = off >= -1.0 || of_it;
        says.then(|| Said { cost: pixel_cost(off), drawn: true, through: off > 1.0 })
    }

    /// Share of the drawn outline beyond which the surface seen goes on.
    fn goes_on(&self, reach_m: f32) -> f64 {
        /// How far beyond, pixels: depth is uncertain at an edge.
        const BEYOND: i64 = 2;
        let Observed { image, .. } = self.observed;
        let (width, height) = (image.width as i64, image.height as i64);
        let (mut outline, mut on) = (0, 0);
        for at in self.raster.pixels() {
            let Some(drawn) = self.raster.depth_m(at) else { continue };
            let seen = image.depth_m[at];
            if (seen - drawn).abs() > reach_m {
                continue;
            }
            let (u, v) = (at as i64 % width, at as i64 / width);
            for (du, dv) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                let place = |by: i64| {
                    let (u, v) = (u + by * du, v + by * dv);
                    let inside = (0..width).contains(&u) && (0..height).contains(&v);
                    inside.then_some((v * width + u) as usize)
                };
                let (Some(next), Some(beyond)) = (place(1), place(1 + BEYOND)) else { continue };
                let drawn_there = |at: usize| self.raster.depth_m(at).is_some();
                if drawn_there(next) || drawn_there(beyond) {
                    continue;
                }
                outline += 1;
                let there = image.depth_m[beyond];
                on += usize::from(there > 0.0 && (there - seen).abs() < reach_m);
            }
        }
        f64::from(on as u32) / f64::from((outline as u32).max(1))
    }
}

/// What a pixel costs whose depth is so far off, in units of three standard deviations; at most 1.
pub(super) fn pixel_cost(off: f32) -> f32 {
    (off * off).min(1.0)
}

/// What a pixel says.
struct Said {
    cost: f32,
    /// Whether the shape is drawn there, and the camera saw through it.
    drawn: bool,
    through: bool,
}

#[derive(Default)]
struct Sums {
    cost: f64,
    pixels: usize,
    of_it: usize,
    explained: usize,
    drawn: usize,
    through: usize,
    with_depth: usize,
    shown: usize,
}

impl Sums {
    fn add(&mut self, cost: f64, of_it: bool) {
        self.cost += cost;
        self.pixels += 1;
        self.of_it += usize::from(of_it);
        self.explained += usize::from(of_it && cost < 1.0);
    }

    fn support(&self) -> Support {
        let share = |of: usize, all: usize| of as f64 / all.max(1) as f64;
        let none = self.pixels == 0;
        Support {
            cost: if none { 1.0 } else { self.cost / self.pixels as f64 },
            pixels: self.pixels,
            explained: share(self.explained, self.of_it),
            seen_through: share(self.through, self.drawn),
            shown: share(self.shown, self.with_depth),
            goes_on: 0.0,
        }
    }
}

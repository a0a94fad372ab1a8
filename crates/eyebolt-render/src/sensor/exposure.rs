//! What a sensor measures of a scene, and how: all but the noise of the single frame.

use super::field::Field;
use super::specimen::Specimen;
use crate::random::Random;
use crate::view::IdealView;
use eyebolt_geometry::DepthImage;
use rayon::prelude::*;

/// One specimen of a sensor before a posed scene: what is the same in every frame.
#[derive(Clone, Debug)]
pub struct Exposure {
    pub(super) size: [usize; 2],
    pub(super) readout: Readout,
    pub(super) range_m: [f32; 2],
    /// What is measured, errors included that every frame has alike; 0 where nothing is.
    pub(super) value: Vec<f32>,
    /// Standard deviation of the value from frame to frame.
    pub(super) sigma: Vec<f32>,
    /// How sure it is that there is a value at all, in standard deviations of what varies.
    pub(super) confidence: Vec<f32>,
    /// How far away a pixel may take its value from; 0 except near edges.
    pub(super) lateral: Option<Lateral>,
    /// Lag at which the noise of pixels is half correlated; 0 if they are independent.
    pub(super) half_px: f32,
}

/// What the numbers of an exposure are, and how they become depth.
#[derive(Clone, Copy, Debug)]
pub enum Readout {
    /// Depth, metres.
    Depth,
    /// Disparity, pixels: depth is `product / disparity`.
    Disparity {
        /// Focal length times baseline, pixels times metres.
        product: f32,
        /// Disparities are whole multiples of this; 0 if they are continuous.
        step_px: f32,
    },
}

impl Readout {
    fn depth_m(self, value: f32) -> f32 {
        match self {
            Self::Depth => value,
            Self::Disparity { product, step_px } if step_px > 0.0 => {
                product / ((value / step_px).round() * step_px)
            }
            Self::Disparity { product, .. } => product / value,
        }
    }
}

/// Edges that are not where they should be.
#[derive(Clone, Debug)]
pub struct Lateral {
    /// Standard deviation of the displacement, pixels; 0 away from edges.
    pub sigma_px: Vec<f32>,
    /// Lag at which displacements are half correlated, pixels.
    pub half_px: f32,
    /// Values that differ by more than this belong to two surfaces.
    pub apart: f32,
    /// Displacement along u and v that all frames share, variance `fixed_share`.
    pub fixed: [Field; 2],
    /// Share of the variance that all frames have in common.
    pub fixed_share: f32,
}

/// Lag at which doubts whether there is a value are half correlated, pixels: holes are blots.
const BLOT_PX: f32 = 2.5;

/// The noise of one frame.
struct Noise {
    random: Random,
    /// `None` if pixels are independent.
    value: Option<Field>,
    doubt: Field,
    shift: Option<[Field; 2]>,
}

impl Exposure {
    /// Depth without errors but those of `specimen`.
    pub(super) fn of_depth(view: &IdealView, specimen: &Specimen) -> Self {
        let count = view.depth_m.len();
        Self {
            size: [view.width, view.height],
            readout: Readout::Depth,
            range_m: [0.0, f32::INFINITY],
            value: view.depth_m.iter().map(|depth| specimen.depth_m(*depth)).collect(),
            sigma: vec![0.0; count],
            confidence: vec![f32::INFINITY; count],
            lateral: None,
            half_px: 0.0,
        }
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The frame with the noise of `random`, 0 where the sensor tells no depth.
    ///
    /// The same bytes on any number of threads.
    pub fn frame(&self, random: Random) -> DepthImage {
        let noise = self.noise(random);
        let [width, height] = self.size;
        let mut depth_m = vec![0.0; width * height];
        depth_m.par_chunks_mut(width).enumerate().for_each(|(v, row)| {
            for (u, depth) in row.iter_mut().enumerate() {
                *depth = self.depth_m(u, v, &noise);
            }
        });
        DepthImage::new(width as u32, height as u32, depth_m)
            .expect("an exposure has as many pixels as its camera")
    }

    fn noise(&self, random: Random) -> Noise {
        let field = |place, half_px| Field::new(random.at(place), self.size, half_px);
        let lateral = self.lateral.as_ref();
        Noise {
            random: random.at(0),
            value: (self.half_px > 0.0).then(|| field(0, self.half_px)),
            doubt: field(1, BLOT_PX),
            shift: lateral.map(|lateral| [2, 3].map(|place| field(place, lateral.half_px))),
        }
    }

    fn depth_m(&self, u: usize, v: usize, noise: &Noise) -> f32 {
        let at = self.source(u, v, noise);
        let (value, sigma, confidence) = (self.value[at], self.sigma[at], self.confidence[at]);
        // Nearly all pixels are sure: for them nothing is looked up.
        if value == 0.0 || (confidence < 5.0 && confidence < noise.doubt.at(u, v)) {
            return 0.0;
        }
        let error = if sigma == 0.0 { 0.0 } else { sigma * self.error(u, v, noise) };
        let depth_m = self.readout.depth_m(value + error);
        let [nearest, farthest] = self.range_m;
        if depth_m >= nearest && depth_m <= farthest { depth_m } else { 0.0 }
    }

    /// Normal, of variance 1.
    fn error(&self, u: usize, v: usize, noise: &Noise) -> f32 {
        match &noise.value {
            Some(field) => field.at(u, v),
            None => noise.random.at((v * self.size[0] + u) as u64).normal() as f32,
        }
    }

    /// The pixel whose value pixel `(u, v)` tells: itself, unless an edge lies between it and where
    /// the displacement leads. Within a surface the noise of the value already has all that
    /// displacements would add.
    fn source(&self, u: usize, v: usize, noise: &Noise) -> usize {
        let here = v * self.size[0] + u;
        let (Some(lateral), Some(shift)) = (&self.lateral, &noise.shift) else { return here };
        let sigma_px = lateral.sigma_px[here];
        if sigma_px == 0.0 {
            return here;
        }
        let [fresh, fixed] = [1.0 - lateral.fixed_share, lateral.fixed_share].map(f32::sqrt);
        let displaced = |from: usize, axis: usize| {
            let normal = fresh * shift[axis].at(u, v) + fixed * lateral.fixed[axis].at(u, v);
            let to = (from as f32 + sigma_px * normal).round();
            to.clamp(0.0, (self.size[axis] - 1) as f32) as usize
        };
        let there = displaced(v, 1) * self.size[0] + displaced(u, 0);
        let (a, b) = (self.value[here], self.value[there]);
        let crossed = (a - b).abs() > lateral.apart || (a == 0.0) != (b == 0.0);
        if crossed { there } else { here }
    }
}

//! Where images to learn from come from: simulated, recorded, or both.

use super::corrupt::corrupt;
use super::error::TrainError;
use super::shot::{At, Cast, Framing, Shot};
use crate::dataset::{Dataset, DatasetFrame, code};
use crate::segment::{Thinned, UNKNOWN};
use eyebolt_render::Random;

/// Where images come from.
pub struct Images {
    cast: Cast,
    recorded: Vec<Dataset>,
    simulated: f64,
}

/// How often the faults of another camera are added to a recorded image.
const MORE_FAULTS: f64 = 0.5;
/// A pixel belongs to a bin if its depth differs from the bin's by less than this share.
const SAME_SURFACE: f32 = 0.01;

impl Images {
    /// Simulated alone.
    pub fn simulated(cast: Cast) -> Self {
        Self { cast, recorded: Vec::new(), simulated: 1.0 }
    }

    /// With this share of the steps simulated, and the others of labelled recordings.
    ///
    /// # Errors
    ///
    /// There is no frame in the recordings, and not all is simulated.
    pub fn mixed(cast: Cast, recorded: Vec<Dataset>, simulated: f64) -> Result<Self, TrainError> {
        let frames: usize = recorded.iter().map(|dataset| dataset.frames().len()).sum();
        if frames == 0 && simulated < 1.0 {
            return Err(TrainError::File {
                file: "dataset".into(),
                field: "index".into(),
                problem:
                    "there is no labelled frame in it. Label recordings first, or simulate all"
                        .into(),
            });
        }
        Ok(Self { cast, recorded, simulated })
    }

    /// `count` images of the stream `random`.
    ///
    /// # Errors
    ///
    /// As [`Cast::shots`]; a file of a data set that cannot be read.
    pub fn shots(
        &self,
        random: Random,
        count: u64,
        framing: Framing,
    ) -> Result<Vec<Shot>, TrainError> {
        let mut choice = random.at(0);
        if choice.uniform() < self.simulated {
            return self.cast.shots(random.at(1), count, framing);
        }
        (0..count).map(|index| self.recorded(random.at(2).at(index), framing)).collect()
    }

    fn recorded(&self, random: Random, framing: Framing) -> Result<Shot, TrainError> {
        let mut choice = random.at(0);
        let total = self.recorded.iter().map(|dataset| dataset.frames().len()).sum();
        let mut place = choice.index(total);
        for dataset in &self.recorded {
            let Some(entry) = dataset.frames().get(place) else {
                place -= dataset.frames().len();
                continue;
            };
            let mut shot = shot_of(dataset.read(entry)?, framing);
            if framing.faults && choice.uniform() < MORE_FAULTS {
                corrupt(&mut shot.image, &shot.label, random.at(1));
            }
            return Ok(shot);
        }
        Err(TrainError::NothingToSee { tries: 0 })
    }
}

/// A frame as networks see it: thinned, or around an end-effector all of its pixels.
fn shot_of(frame: DatasetFrame, framing: Framing) -> Shot {
    let columns =
        if framing.at != At::Arm { frame.camera.width() as usize } else { framing.columns };
    let image = Thinned::new(&frame.depth, &frame.camera, columns);
    let width = frame.camera.width() as usize;
    let label = (0..image.depth_m.len()).map(|at| {
        let (u, v) = (at % image.width * image.step, at / image.width * image.step);
        let bin =
            (0..image.step).flat_map(|dv| (0..image.step).map(move |du| (v + dv) * width + u + du));
        let z = image.depth_m[at];
        let of_surface = |at: &usize| {
            let there = frame.depth.depth_m()[*at];
            there > 0.0 && (there - z).abs() <= SAME_SURFACE * z
        };
        let mut labels = bin.filter(of_surface).map(|at| code(frame.labels[at]));
        let Some(first) = labels.next() else { return UNKNOWN };
        // Where a bin is on a border, nobody can say.
        if labels.all(|label| label == first) { first } else { UNKNOWN }
    });
    Shot {
        label: label.collect(),
        image,
        camera_from_end_effector: frame.camera_from_end_effector,
        joints: frame.joints,
        drawn: false,
    }
}

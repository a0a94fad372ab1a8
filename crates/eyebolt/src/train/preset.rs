//! Which networks are taught, and how.

use super::lesson::Plan;
use crate::pose::{PARTS, POINT_OUTPUTS, VIEW_FEATURES};
use crate::segment::{CLASSES, FEATURES, Grid, WINDOW_FEATURES};
use eyebolt_net::Error;
use eyebolt_net::models::{Head, MinkEncoder, MinkUNet};
use eyebolt_net::training::Rule;

/// Which networks are taught, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// Networks on images, which a laptop teaches in half an hour.
    #[default]
    Default,
    /// MinkUNet18D on voxels of 5 mm, its encoder for rotations: the paper's, and slow without a GPU.
    Paper,
    /// MinkUNet14A on voxels of 2 cm.
    Voxels,
}

/// Rotations that are told apart; the mode between them is finer.
const ROTATIONS: usize = 1152;

impl Preset {
    /// By its name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "default" => Some(Self::Default),
            "paper" => Some(Self::Paper),
            "voxels" => Some(Self::Voxels),
            _ => None,
        }
    }

    /// Their names.
    pub const NAMES: [&'static str; 3] = ["default", "paper", "voxels"];

    /// In which cells the segmentation sees images.
    pub fn grid(self) -> Grid {
        match self {
            Self::Default => Grid::Image { columns: 160 },
            Self::Paper => Grid::Voxels { edge_m: 0.005 },
            Self::Voxels => Grid::Voxels { edge_m: 0.02 },
        }
    }

    /// Images of a step of the segmentation.
    pub fn images(self) -> u64 {
        match self {
            Self::Default | Self::Voxels => 4,
            Self::Paper => 1,
        }
    }

    /// The segmentation of so many classes.
    ///
    /// # Errors
    ///
    /// None, as the names are known.
    pub fn segmentation(self, classes: usize) -> Result<MinkUNet, Error> {
        let inputs = FEATURES.len();
        match self {
            Self::Default => {
                let channels = [24, 32, 64, 96, 64, 32, 24, 16];
                let net = MinkUNet::named("minkunet14a", inputs, classes)?;
                Ok(MinkUNet { channels, stem_channels: 16, stem_kernel: 3, flat: true, ..net })
            }
            Self::Paper => {
                let head = Head::Hidden(vec![256, 1024]);
                let net = MinkUNet::named("minkunet18d", inputs, classes)?;
                Ok(MinkUNet { head, stem_kernel: 3, ..net })
            }
            Self::Voxels => MinkUNet::named("minkunet14a", inputs, classes),
        }
    }

    /// The segmentation of a window around an end-effector.
    ///
    /// # Errors
    ///
    /// None, as the names are known.
    pub fn end_effector(self) -> Result<MinkUNet, Error> {
        let net = MinkUNet::named("minkunet14a", WINDOW_FEATURES.len(), CLASSES.len())?;
        let channels = [24, 32, 64, 96, 64, 32, 24, 24];
        Ok(MinkUNet { channels, stem_channels: 16, stem_kernel: 3, flat: true, ..net })
    }

    /// The network for rotations.
    ///
    /// # Errors
    ///
    /// None, as the names are known.
    pub fn rotation(self) -> Result<MinkEncoder, Error> {
        let inputs = VIEW_FEATURES.len();
        match self {
            Self::Paper => {
                let net = MinkEncoder::named("minkunet18", inputs, &[2048, 4])?;
                Ok(MinkEncoder { stem_kernel: 3, flat: true, ..net })
            }
            Self::Default | Self::Voxels => {
                let net = MinkEncoder::named("minkunet14", inputs, &[256, ROTATIONS])?;
                let channels = [32, 64, 96, 128];
                Ok(MinkEncoder { channels, stem_channels: 16, stem_kernel: 3, flat: true, ..net })
            }
        }
    }

    /// The network that matches points.
    ///
    /// # Errors
    ///
    /// None, as the names are known.
    pub fn keypoints(self) -> Result<MinkUNet, Error> {
        let net = MinkUNet::named("minkunet14a", VIEW_FEATURES.len(), PARTS + POINT_OUTPUTS.len())?;
        let channels = [32, 48, 64, 96, 64, 48, 32, 32];
        Ok(MinkUNet { channels, stem_channels: 16, stem_kernel: 3, flat: true, ..net })
    }

    /// A plan of so many steps.
    pub fn plan(self, steps: u64, seed: u64, threads: usize) -> Plan {
        let (rule, rate) = match self {
            // As in the paper's code, but for the schedule, which fits the time there is.
            Self::Paper => (Rule::adam(1e-4), 1e-4),
            Self::Default | Self::Voxels => (Rule::adamw(1e-4), 3e-3),
        };
        let every = (steps / 20).clamp(10, 500);
        Plan { steps, rule, rate, seed, every, patience: 12, threads }
    }
}

//! How to calibrate a recording, whichever it is.

use super::learned::LearnedArguments;
use super::limits::LimitArguments;
use crate::inputs::CacheArguments;
use eyebolt::pipeline::Request;
use eyebolt::record::RecordOptions;
use eyebolt_recording::Recording;
use eyebolt_robot::Arm;

/// Flags that say how to calibrate.
#[derive(Debug, clap::Args)]
pub struct WayArguments {
    #[command(flatten)]
    pub learned: LearnedArguments,
    /// Find the arm's pixels by what moved, even if there are masks
    #[arg(long)]
    no_masks: bool,
    /// Of more configurations, use those that differ most
    #[arg(long, value_name = "COUNT", default_value_t = MOST_CONFIGURATIONS, value_parser = clap::value_parser!(u16).range(3..))]
    max_configurations: u16,
    #[command(flatten)]
    limits: LimitArguments,
    /// Seed of the search; the same seed gives the same bytes on any number of threads
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    cache: CacheArguments,
}

/// Of more configurations, those that differ most are used.
const MOST_CONFIGURATIONS: u16 = 30;

impl WayArguments {
    /// Without a model, and everything else as it is by default.
    #[cfg(feature = "live")]
    pub fn plain(limits: LimitArguments, seed: u64, cache: CacheArguments) -> Self {
        let learned = LearnedArguments::default();
        let max_configurations = MOST_CONFIGURATIONS;
        Self { learned, no_masks: false, max_configurations, limits, seed, cache }
    }

    /// To calibrate `recording` of `arm`.
    pub fn request<'a>(&self, recording: &'a Recording<'_>, arm: &'a Arm) -> Request<'a> {
        Request {
            cache: self.cache.open(),
            options: RecordOptions {
                use_masks: !self.no_masks,
                most_configurations: usize::from(self.max_configurations),
            },
            limits: self.limits.limits(),
            seed: self.seed,
            ..Request::new(recording.source(), arm)
        }
    }
}

//! Depth that is stored in another unit than the recording says.
//!
//! Most drivers store whole millimetres, some tenths, eighths, fifths or quarters of them, and nothing in
//! the images says which. An arm of the wrong size fits nowhere, which looks as if its joints were wrong.

use crate::calibrate::Verdict;
use crate::observations::Observations;
use crate::record::RecordOptions;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_recording::{
    ColorImage, Frame, FrameSource, Provenance, Range, RecordingError, RobotSection,
    StaticTransform,
};
use eyebolt_robot::JointPositions;

/// By how much the units of drivers differ from millimetres.
const FACTORS: [f64; 8] = [0.1, 0.25, 0.2, 0.125, 10.0, 4.0, 5.0, 8.0];
/// Half of what a camera before an arm sees is nearer than a distance between these, metres.
const PLAUSIBLE_M: std::ops::Range<f64> = 0.15..8.0;
/// Configurations that tell whether the arm fits.
const ENOUGH: usize = 6;

/// Factors by which the depth of `observations` may be wrong, if an answer of this `verdict` may be
/// refused for that.
pub(crate) fn candidates(
    source: &dyn FrameSource,
    observations: &Observations,
    verdict: &Verdict,
) -> Vec<f64> {
    if source.integer_unit_m().is_none() || *verdict == Verdict::Trusted {
        return Vec::new();
    }
    let mut seen: Vec<f32> = observations
        .configurations
        .iter()
        .flat_map(|configuration| configuration.depth.depth_m().iter().step_by(STEP).copied())
        .filter(|depth| *depth > 0.0)
        .collect();
    if seen.is_empty() {
        return Vec::new();
    }
    let middle = seen.len() / 2;
    let median_m = f64::from(*seen.select_nth_unstable_by(middle, f32::total_cmp).1);
    FACTORS.into_iter().filter(|factor| PLAUSIBLE_M.contains(&(factor * median_m))).collect()
}

/// One of so many pixels is looked at.
const STEP: usize = 7;

/// As much of a recording as tells whether the arm fits.
pub(crate) fn few(options: &RecordOptions) -> RecordOptions {
    let most_configurations = options.most_configurations.min(ENOUGH);
    RecordOptions { most_configurations, ..*options }
}

/// The frames of a source, with their depth multiplied by a factor.
#[derive(Debug)]
pub(crate) struct Scaled<'a> {
    pub(crate) source: &'a dyn FrameSource,
    pub(crate) factor: f64,
}

impl Scaled<'_> {
    fn depth(&self, depth: DepthImage) -> DepthImage {
        let (width, height) = (depth.width(), depth.height());
        let scaled = depth.into_depth_m().into_iter().map(|z| z * self.factor as f32).collect();
        DepthImage::new(width, height, scaled).expect("as many pixels as before")
    }
}

impl FrameSource for Scaled<'_> {
    fn camera(&self) -> Option<&PinholeCamera> {
        self.source.camera()
    }

    fn camera_frame_id(&self) -> Option<&str> {
        self.source.camera_frame_id()
    }

    fn static_transforms(&self) -> &[StaticTransform] {
        self.source.static_transforms()
    }

    fn robot(&self) -> &RobotSection {
        self.source.robot()
    }

    fn frame_names(&self) -> &[String] {
        self.source.frame_names()
    }

    fn has_masks(&self) -> bool {
        self.source.has_masks()
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let frame = self.source.read_frame(index)?;
        let range = match frame.range {
            Range::Depth(depth) => Range::Depth(self.depth(depth)),
            // Points are floats, in metres.
            cloud @ Range::Cloud(_) => cloud,
        };
        Ok(Frame { range, ..frame })
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        self.source.read_joints(index)
    }

    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        self.source.read_color(index)
    }

    fn background_count(&self) -> usize {
        self.source.background_count()
    }

    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        self.source.read_background(index).map(|depth| self.depth(depth))
    }

    fn may_leave_out(&self, error: &RecordingError) -> bool {
        self.source.may_leave_out(error)
    }

    fn provenance(&self) -> &Provenance {
        self.source.provenance()
    }
}

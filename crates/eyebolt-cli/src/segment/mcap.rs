//! Labelled points as messages, for viewers.

use super::cloud::Points;
use super::segmented::{Segmented, Sink};
use crate::output;
use anyhow::Result;
use eyebolt_recording::{
    McapWriter, OPTICAL_FRAME, PaintedCloud, PointValues, Recording, WriteError,
};
use std::fs::File;
use std::path::Path;

/// The topic of the clouds.
pub(super) const TOPIC: &str = "/eyebolt/labelled";

/// Writes a cloud with colours, labels and probabilities for each frame.
pub(super) struct McapSink<'a> {
    writer: McapWriter<&'a mut File>,
    recording: &'a Recording<'a>,
}

impl<'a> McapSink<'a> {
    pub(super) fn new(
        file: &'a mut File,
        recording: &'a Recording<'a>,
    ) -> Result<Self, WriteError> {
        Ok(Self { writer: McapWriter::new(file)?, recording })
    }

    pub(super) fn finish(self) -> Result<(), WriteError> {
        self.writer.finish()
    }
}

impl Sink for McapSink<'_> {
    fn frame(&mut self, frame: &Segmented<'_>) -> Result<()> {
        let points = Points::of(frame);
        let label: Vec<u32> = points.label.iter().map(|label| u32::from(*label)).collect();
        let values = [
            ("label", PointValues::Whole(&label)),
            ("probability", PointValues::Real(&points.probability)),
        ];
        let rgb = points.rgb();
        let cloud = PaintedCloud { points_m: &points.points_m, rgb: &rgb, values: &values };
        let stamp_ns = self.recording.stamp_ns(frame.index);
        let frame_id = self.recording.camera_frame_id().unwrap_or(OPTICAL_FRAME);
        let message = cloud.message(frame_id, stamp_ns);
        let written = self.writer.write(TOPIC, "sensor_msgs/PointCloud2", stamp_ns, &message);
        written.map_err(|error| output::named(error, Path::new("MCAP")))
    }
}

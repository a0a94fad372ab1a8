//! Poses as messages, for viewers.

use super::lines::Line;
use eyebolt_recording::{McapWriter, OPTICAL_FRAME, Recording, WriteError, text_message};
use std::fs::File;

/// The topic of the poses that are to be relied on.
const POSE: &str = "/eyebolt/end_effector";
/// The topic of all that is said, as JSON.
const SAID: &str = "/eyebolt/pose";

/// Writes the `lines` of the frames of `recording`, each stamped as its frame is: poses in the camera's optical frame with how
/// uncertain they are, and every line as text.
pub(super) fn write(
    recording: &Recording<'_>,
    lines: &[Line],
    file: &mut File,
) -> Result<(), WriteError> {
    let frame_id = recording.camera_frame_id().unwrap_or(OPTICAL_FRAME);
    let mut writer = McapWriter::new(file)?;
    for (index, line) in lines.iter().enumerate() {
        let stamp_ns = recording.stamp_ns(index);
        writer.write(SAID, "std_msgs/String", stamp_ns, &text_message(&line.json()))?;
        if let Some(pose) = line.answer() {
            let message = pose.message(frame_id, stamp_ns);
            writer.write(POSE, "geometry_msgs/PoseWithCovarianceStamped", stamp_ns, &message)?;
        }
    }
    writer.finish()
}

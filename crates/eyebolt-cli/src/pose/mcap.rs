//! Poses as messages, for viewers.

use super::lines::Line;
use eyebolt_recording::{McapWriter, WriteError, text_message};
use std::fs::File;

/// The topic of the poses that are to be relied on.
const POSE: &str = "/eyebolt/end_effector";
/// The topic of all that is said, as JSON.
const SAID: &str = "/eyebolt/pose";

/// Writes `lines`, each stamped as its frame is: poses in the optical frame `frame_id` with how uncertain they are, and every line
/// as text.
pub(super) fn write(lines: &[Line], frame_id: &str, file: &mut File) -> Result<(), WriteError> {
    let mut writer = McapWriter::new(file)?;
    for line in lines {
        let said = text_message(&line.json());
        writer.write(SAID, "std_msgs/String", line.stamp_ns, &said)?;
        if let Some(pose) = line.answer() {
            let message = pose.message(frame_id, line.stamp_ns);
            writer.write(
                POSE,
                "geometry_msgs/PoseWithCovarianceStamped",
                line.stamp_ns,
                &message,
            )?;
        }
    }
    writer.finish()
}

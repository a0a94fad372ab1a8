//! `geometry_msgs/PoseWithCovarianceStamped`.

use super::header::Header;
use super::writer::WireWriter;

/// Where something is, and how far off that may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncertainPose {
    /// Its origin in the frame of the message, metres.
    pub translation_m: [f64; 3],
    /// Hamilton quaternion from it to the frame of the message.
    pub rotation_xyzw: [f64; 4],
    /// Standard deviation along each axis of the frame of the message, metres; 0 if nobody knows.
    pub translation_sd_m: f64,
    /// Standard deviation about each axis, radians.
    pub rotation_sd: f64,
}

impl UncertainPose {
    /// The message in CDR.
    pub fn message(&self, frame_id: &str, stamp_ns: i64) -> Vec<u8> {
        let mut writer = WireWriter::new();
        Header { stamp_ns, frame_id }.write(&mut writer);
        writer.f64_array(&self.translation_m);
        writer.f64_array(&self.rotation_xyzw);
        for row in 0..6 {
            let sd = if row < 3 { self.translation_sd_m } else { self.rotation_sd };
            let mut covariance = [0.0; 6];
            covariance[row] = sd * sd;
            writer.f64_array(&covariance);
        }
        writer.finish()
    }
}

//! `std_msgs/Header`.

use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;

/// When and in which frame something was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Header<'a> {
    /// Nanoseconds; 0 where nobody set it.
    pub(crate) stamp_ns: i64,
    /// Name of the frame.
    pub(crate) frame_id: &'a str,
}

const SECOND_NS: i64 = 1_000_000_000;

impl<'a> Header<'a> {
    pub(crate) fn read(reader: &mut WireReader<'a>) -> Result<Self, WireProblem> {
        let ros1 = reader.is_ros1();
        let seconds = if ros1 {
            reader.u32("header.seq")?;
            i64::from(reader.u32("header.stamp.secs")?)
        } else {
            i64::from(reader.i32("header.stamp.sec")?)
        };
        let nanoseconds = i64::from(reader.u32("header.stamp.nanosec")?);
        let stamp_ns = seconds * SECOND_NS + nanoseconds;
        Ok(Self { stamp_ns, frame_id: reader.string("header.frame_id")? })
    }

    pub(crate) fn write(&self, writer: &mut WireWriter) {
        let seconds = self.stamp_ns.div_euclid(SECOND_NS);
        writer.i32(i32::try_from(seconds).unwrap_or(i32::MAX));
        // Below a second, so it fits.
        writer.u32(self.stamp_ns.rem_euclid(SECOND_NS) as u32);
        writer.string(self.frame_id);
    }
}

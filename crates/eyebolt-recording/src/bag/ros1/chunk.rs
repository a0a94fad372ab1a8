//! Chunks: records behind one another, compressed together.

use super::buffer::read_up_to;
use super::fault::Fault;
use super::header::Header;
use super::source::{Record, Source};
use crate::bag::bag_file::LARGEST_CHUNK;
use crate::bag::remedy::or_partial;
use bzip2::bufread::BzDecoder;
use lz4_flex::frame::FrameDecoder;
use std::io::Read;

/// How a chunk is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Bz2,
    Lz4,
}

/// What the header of a chunk says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chunk {
    pub(super) compression: Compression,
    /// Bytes when decompressed.
    pub(super) size: u32,
}

impl Chunk {
    pub(super) fn parse(header: Header<'_>) -> Result<Self, Fault> {
        let compression = match header.text("compression")? {
            "none" => Compression::None,
            "bz2" => Compression::Bz2,
            "lz4" => Compression::Lz4,
            other => {
                let problem = format!("compression {other:?} is not known (none, bz2, lz4 are)");
                return Err(problem.into());
            }
        };
        Ok(Self { compression, size: header.u32("size")? })
    }

    /// Replaces what is in `buffer` by the contents of this chunk, whose data are next in `source`.
    pub(super) fn decompress(
        self,
        source: &mut Source<'_>,
        record: Record,
        buffer: &mut Vec<u8>,
    ) -> Result<(), Fault> {
        if u64::from(self.size) > LARGEST_CHUNK {
            return Err(Fault::Damage {
                problem: format!("{} bytes are too many for a chunk", self.size),
                remedy: or_partial("Record with a smaller `--chunksize`", "to use the rest"),
            });
        }
        let stored = source.by_ref().take(u64::from(record.length));
        match self.compression {
            Compression::None => self.take_all(stored, buffer),
            Compression::Bz2 => self.take_all(BzDecoder::new(stored), buffer),
            // Of ROS 1 it is the frame format, as the lz4 command writes it, not bare blocks.
            Compression::Lz4 => self.take_all(FrameDecoder::new(stored), buffer),
        }
    }

    /// Whatever the decoder gives, if that is as much as was declared.
    fn take_all(self, mut decoder: impl Read, buffer: &mut Vec<u8>) -> Result<(), Fault> {
        let failed = |cause| Fault::from(format!("it cannot be decompressed: {cause}"));
        read_up_to(&mut decoder, buffer, u64::from(self.size)).map_err(failed)?;
        let (found, declared) = (buffer.len(), self.size);
        if (found as u64) < u64::from(declared) {
            return Err(format!("it has {found} bytes where {declared} are declared").into());
        }
        // Asking for one more also has the decoder compare the check sum at the end.
        match decoder.read(&mut [0]).map_err(failed)? {
            0 => Ok(()),
            _ => Err(format!("it has more than the {declared} bytes that are declared").into()),
        }
    }
}

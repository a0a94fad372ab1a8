//! Chunks: compressed runs of records.

use super::fields::Fields;
use crate::bag::bag_file::LARGEST_CHUNK;
use crate::bag::zstd::Unzipper;
use std::io::Read;
use std::ops::Range;

/// Where the records of a chunk are.
#[derive(Default)]
enum Source {
    /// In this part of the chunk's body, which is not compressed.
    Body(Range<usize>),
    Lz4,
    #[default]
    Zstd,
}

/// Bytes of a chunk before its records, if the name of the compression is empty.
const HEADER: usize = 40;
/// Most bytes that LZ4 makes of one.
const LARGEST_EXPANSION: u64 = 255;

/// Decompresses one chunk after the other into memory that it keeps.
#[derive(Default)]
pub(super) struct Unpacker {
    unzipper: Unzipper,
    lz4: Vec<u8>,
    last: Source,
}

impl Unpacker {
    /// The records in the chunk with this body, their checksum checked.
    pub(super) fn unpack<'a>(&'a mut self, body: &'a [u8]) -> Result<&'a [u8], String> {
        let mut fields = Fields::new(body);
        let (_start_time, _end_time) = (fields.u64()?, fields.u64()?);
        let (size, crc) = (fields.u64()?, fields.u32()?);
        let compression = fields.text()?;
        let stored = fields.u64()?;
        let data = fields.bytes(stored)?;
        if size > LARGEST_CHUNK {
            let limit = LARGEST_CHUNK >> 20;
            return Err(format!("the chunk claims {size} bytes, more than {limit} MiB"));
        }
        self.last = match compression {
            "" => Source::Body(HEADER..HEADER + data.len()),
            "zstd" => {
                self.unzipper
                    .unzip(data, Some(size))
                    .map_err(|problem| format!("chunk: {problem}"))?;
                Source::Zstd
            }
            "lz4" => {
                self.lz4(data, size)?;
                Source::Lz4
            }
            other => return Err(format!("compression \"{other}\" is not known")),
        };
        let records = match &self.last {
            Source::Body(range) => body.get(range.clone()).unwrap_or_default(),
            Source::Lz4 => &self.lz4,
            Source::Zstd => self.unzipper.bytes(),
        };
        check(records, size, crc)?;
        Ok(records)
    }

    /// The records of the chunk unpacked last, whose body this was.
    pub(super) fn into_records(self, body: &[u8]) -> Vec<u8> {
        match self.last {
            Source::Body(range) => body.get(range).unwrap_or_default().to_vec(),
            Source::Lz4 => self.lz4,
            Source::Zstd => self.unzipper.into_bytes(),
        }
    }

    fn lz4(&mut self, data: &[u8], size: u64) -> Result<(), String> {
        if size / LARGEST_EXPANSION > data.len() as u64 {
            return Err(format!("{} bytes of LZ4 are never {size}", data.len()));
        }
        self.lz4.clear();
        self.lz4.reserve_exact(size as usize);
        let decoder = lz4_flex::frame::FrameDecoder::new(data);
        // One more than there should be, which also has the decoder compare its checksum.
        let decoded = decoder.take(size + 1).read_to_end(&mut self.lz4);
        decoded.map(drop).map_err(|error| format!("the chunk cannot be decompressed: {error}"))
    }
}

fn check(records: &[u8], size: u64, crc: u32) -> Result<(), String> {
    if records.len() as u64 != size {
        let found = records.len();
        return Err(format!("the chunk claims {size} bytes, but decompresses to {found} or more"));
    }
    // Zero means that the writer made none.
    if crc != 0 && crc32fast::hash(records) != crc {
        return Err("the chunk's checksum is wrong".to_owned());
    }
    Ok(())
}

/// Opcode, first byte of the body, and body of every record; ends with the first that is cut short.
pub(super) fn records(bytes: &[u8]) -> impl Iterator<Item = Result<(u8, u32, &[u8]), String>> {
    let mut at = 0_usize;
    let mut broken = false;
    std::iter::from_fn(move || {
        let rest = bytes.get(at..).filter(|rest| !rest.is_empty() && !broken)?;
        let body = || {
            let (framing, rest) = rest.split_first_chunk::<9>()?;
            let [opcode, length @ ..] = *framing;
            let length = usize::try_from(u64::from_le_bytes(length)).ok()?;
            Some((opcode, rest.get(..length)?))
        };
        let Some((opcode, body)) = body() else {
            broken = true;
            return Some(Err(format!("a record at byte {at} of the chunk is cut short")));
        };
        // A chunk is below 4 GiB.
        let start = (at + 9) as u32;
        at += 9 + body.len();
        Some(Ok((opcode, start, body)))
    })
}

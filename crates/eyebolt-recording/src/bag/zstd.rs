//! Zstandard: of chunks, of single messages and of whole files.

use super::bag_file::LARGEST_CHUNK;
use super::bytes::Bytes;
use crate::error::RecordingError;
use std::io::{BufReader, BufWriter, Read, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// The first bytes of a compressed frame. No message in CDR begins so, nor does any kind of bag.
pub(super) const MAGIC: [u8; 4] = 0xfd2f_b528_u32.to_le_bytes();

/// Most bytes that Zstandard makes of one: a block is 128 KiB, and its header alone three bytes.
const LARGEST_EXPANSION: u64 = (128 << 10) / 3;

/// Decompresses one piece after the other into memory that it keeps.
#[derive(Default)]
pub(super) struct Unzipper {
    bytes: Vec<u8>,
    decompressor: Option<zstd::bulk::Decompressor<'static>>,
}

impl Unzipper {
    /// The bytes that `data` is made of, at most [`LARGEST_CHUNK`]; how many, `data` says itself
    /// unless `size` does.
    pub(super) fn unzip(&mut self, data: &[u8], size: Option<u64>) -> Result<&[u8], String> {
        let failed = |error: std::io::Error| format!("it cannot be decompressed: {error}");
        let size = match size.or_else(|| content_size(data)) {
            Some(size) if size > LARGEST_CHUNK => {
                let limit = LARGEST_CHUNK >> 20;
                return Err(format!(
                    "it claims to decompress to {size} bytes, more than {limit} MiB"
                ));
            }
            Some(size) if size / LARGEST_EXPANSION > data.len() as u64 => {
                return Err(format!("{} bytes of Zstandard are never {size}", data.len()));
            }
            Some(size) => size as usize,
            // Streams do not know their length beforehand.
            None => return self.unzip_stream(data),
        };
        let decompressor = match &mut self.decompressor {
            Some(decompressor) => decompressor,
            none => none.insert(zstd::bulk::Decompressor::new().map_err(failed)?),
        };
        self.bytes.clear();
        // Address space only: pages are taken as they are filled.
        self.bytes.reserve_exact(size);
        decompressor.decompress_to_buffer(data, &mut self.bytes).map_err(failed)?;
        Ok(&self.bytes)
    }

    fn unzip_stream(&mut self, data: &[u8]) -> Result<&[u8], String> {
        let failed = |error: std::io::Error| format!("it cannot be decompressed: {error}");
        self.bytes.clear();
        let decoder = zstd::stream::read::Decoder::with_buffer(data).map_err(failed)?;
        decoder.take(LARGEST_CHUNK + 1).read_to_end(&mut self.bytes).map_err(failed)?;
        if self.bytes.len() as u64 > LARGEST_CHUNK {
            let limit = LARGEST_CHUNK >> 20;
            return Err(format!("it decompresses to more than {limit} MiB"));
        }
        Ok(&self.bytes)
    }

    /// What was decompressed last.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// What was decompressed last.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

fn content_size(data: &[u8]) -> Option<u64> {
    zstd::zstd_safe::get_frame_content_size(data).ok().flatten()
}

/// How much larger a whole file may become.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileLimit {
    /// So many bytes, whatever the file's size...
    pub(super) always: u64,
    /// ...or so many times the file's size.
    pub(super) ratio: u64,
}

/// No depth recording comes near.
pub(super) const FILE_LIMIT: FileLimit = FileLimit { always: 4 << 30, ratio: 200 };

/// Decompresses a file to a file in the folder `scratch` that goes when it is dropped.
pub(super) fn unzip_file(
    compressed: &Bytes,
    scratch: &Path,
    limit: FileLimit,
) -> Result<NamedTempFile, RecordingError> {
    let (path, stored) = (compressed.path(), compressed.length());
    let limit = limit.always.max(stored.saturating_mul(limit.ratio));
    let decoder = zstd::stream::read::Decoder::with_buffer(BufReader::new(compressed.reader(0)));
    let mut decoder =
        decoder.map_err(|cause| compressed.unreadable(cause))?.take(limit.saturating_add(1));
    let unwritable = |cause: std::io::Error| RecordingError::Read {
        path: scratch.to_path_buf(),
        field: "a decompressed copy of the bag".to_owned(),
        remedy: "Make room there, or set TMPDIR to a folder that has it".to_owned(),
        cause,
    };
    let file = NamedTempFile::new_in(scratch).map_err(unwritable)?;
    let mut writer = BufWriter::new(file);
    let mut piece = vec![0; 1 << 20];
    let mut written = 0_u64;
    loop {
        let count = decoder.read(&mut piece).map_err(|cause| {
            let problem = format!("it cannot be decompressed behind byte {written}: {cause}");
            let remedy = "The file is damaged or cut short: copy it again";
            RecordingError::invalid(path, "zstd", problem, remedy)
        })?;
        let Some(bytes) = piece.get(..count).filter(|bytes| !bytes.is_empty()) else { break };
        writer.write_all(bytes).map_err(unwritable)?;
        written += bytes.len() as u64;
    }
    if written > limit {
        let problem = format!("{stored} bytes decompress to more than {limit} bytes");
        let remedy = "This is no recording. If it is, decompress it with `zstd -d`";
        return Err(RecordingError::invalid(path, "zstd", problem, remedy));
    }
    writer.into_inner().map_err(|error| unwritable(error.into_error()))
}

//! Clouds in PCD, the format of the Point Cloud Library, versions .5 to .7.
//!
//! The format is told at <https://pointclouds.org/documentation/tutorials/pcd_file_format.html>;
//! what it leaves open is read as the library itself does.

mod data;
mod header;
mod keys;
mod layout;
mod lzf;
mod viewpoint;

use super::stored::{LARGEST, Stored, check_count, damaged, invalid};
use crate::error::RecordingError;
use header::{Encoding, Header};
use layout::Layout;
use std::path::Path;

/// Reads a whole file; `path` is for messages.
pub(super) fn parse(path: &Path, bytes: Vec<u8>) -> Result<Stored, RecordingError> {
    let header = Header::parse(path, &bytes)?;
    check_count(path, header.count)?;
    let data = bytes.get(header.length..).unwrap_or(&[]);
    let xyz = match header.encoding {
        Encoding::Ascii => data::ascii(path, data, &header)?,
        Encoding::Binary => binary(path, data, &header)?,
        Encoding::Compressed => {
            let (unpacked, layout) = unpack(path, data, &header)?;
            // Half of what is in memory, and of no more use.
            drop(bytes);
            data::columns(&unpacked, &layout, header.count)
        }
    };
    // PCL writes lists of points as images of one row.
    let grid = (header.height > 1).then_some((header.width, header.height));
    Ok(Stored { xyz, grid })
}

/// Largest page of memory that a file is padded to, bytes.
const LARGEST_PAGE: usize = 64 << 10;

fn binary(path: &Path, data: &[u8], header: &Header) -> Result<Vec<f32>, RecordingError> {
    let (count, stride) = (header.count, header.layout.stride);
    let needed = count.checked_mul(stride);
    // A line end after the last point does no harm, nor do the zeros up to the end of a page, where
    // the file was mapped into memory.
    let rest = needed.and_then(|needed| data.get(needed..));
    let harmless = |byte: &u8| byte.is_ascii_whitespace() || *byte == 0;
    if !rest.is_some_and(|rest| rest.len() <= LARGEST_PAGE && rest.iter().all(harmless)) {
        let found = data.len();
        let problem = format!(
            "{count} points of {stride} bytes do not take the {found} bytes that follow the header"
        );
        return Err(damaged(path, problem));
    }
    Ok(data::rows(data, &header.layout, count))
}

/// Decompresses the points, and tells how they lie there.
fn unpack(path: &Path, data: &[u8], header: &Header) -> Result<(Vec<u8>, Layout), RecordingError> {
    let Some((&[a, b, c, d, e, f, g, h], stored)) = data.split_first_chunk() else {
        return Err(damaged(path, "the file ends before the compressed points"));
    };
    let packed_size = u32::from_le_bytes([a, b, c, d]) as usize;
    let size = u32::from_le_bytes([e, f, g, h]) as usize;
    // PCL leaves padding out of compressed files, and its names out of their headers; others
    // keep both.
    let takes = |layout: &&Layout| layout.stride.checked_mul(header.count) == Some(size);
    let Some(layout) = [&header.layout, &header.unpadded].into_iter().find(takes) else {
        let (count, stride) = (header.count, header.layout.stride);
        let problem = format!("{count} points of {stride} bytes do not take {size} bytes");
        return Err(damaged(path, problem));
    };
    if size as u64 > LARGEST {
        let problem = format!("decompressed it is larger than {} MiB", LARGEST >> 20);
        return Err(invalid(path, problem, "Leave fields other than x, y, z out"));
    }
    // PCL reserves room for points that do not shrink, and leaves zeros behind those that do.
    let Some(packed) = stored.get(..packed_size) else {
        let problem = format!(
            "the compressed points take {packed_size} bytes, but {} bytes follow",
            stored.len()
        );
        return Err(damaged(path, problem));
    };
    let unpacked = lzf::decompress(packed, size).map_err(|problem| damaged(path, problem))?;
    Ok((unpacked, *layout))
}

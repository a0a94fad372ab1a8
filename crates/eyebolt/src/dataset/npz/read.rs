//! An archive in. Nothing is taken at its word: every place, length and checksum is checked.

use super::parts::{CENTRAL, CENTRAL_BYTES, END, END_BYTES, LOCAL, LOCAL_BYTES};
use crate::dataset::error::DatasetError;
use eyebolt_recording::{Dtype, Npy, Number};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

/// What to do about a file that is not whole.
const DAMAGED: &str = "The file is damaged or cut short: remove it and label the recording again";
/// Arrays that one file may have.
const MOST_ARRAYS: u16 = 64;
/// The longest comment at an archive's end.
const MOST_COMMENT: usize = 1 << 16;

/// The arrays of a file, found and checked, not yet read.
pub(in crate::dataset) struct Archive<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    /// Where each array's NPY file lies, by name.
    arrays: BTreeMap<String, Range<usize>>,
}

impl<'a> Archive<'a> {
    /// Of the file at `path`, whose content is `bytes`.
    pub(in crate::dataset) fn open(path: &'a Path, bytes: &'a [u8]) -> Result<Self, DatasetError> {
        let arrays = directory(bytes)
            .map_err(|problem| DatasetError::invalid(path, "archive", problem, DAMAGED))?;
        Ok(Self { path, bytes, arrays })
    }

    /// Shape and numbers of array `name`, which may be of types `accepted`.
    pub(in crate::dataset) fn array<T: Number>(
        &self,
        name: &str,
        accepted: &[Dtype],
    ) -> Result<(Vec<usize>, Vec<T>), DatasetError> {
        let Some(range) = self.arrays.get(name) else {
            let known: Vec<&str> = self.arrays.keys().map(String::as_str).collect();
            let problem = format!("there is no such array; there are {}", known.join(", "));
            let remedy = "Label the recording again with this version of eyebolt";
            return Err(DatasetError::invalid(self.path, name, problem, remedy));
        };
        let npy = self.bytes.get(range.clone()).unwrap_or_default().to_vec();
        let npy = Npy::parse(self.path, name, npy, accepted)?;
        Ok((npy.shape().to_vec(), npy.values()))
    }
}

fn directory(bytes: &[u8]) -> Result<BTreeMap<String, Range<usize>>, String> {
    let tail = bytes.len().saturating_sub(END_BYTES + MOST_COMMENT);
    let end = (tail..=bytes.len().saturating_sub(END_BYTES))
        .rev()
        .find(|at| u32_at(bytes, *at) == Some(END))
        .ok_or("the file has no end of a ZIP archive")?;
    let count = u16_at(bytes, end + 10).ok_or("cut short")?;
    if count > MOST_ARRAYS {
        return Err(format!("{count} files in it, more than {MOST_ARRAYS}"));
    }
    let mut at = u32_at(bytes, end + 16).ok_or("cut short")? as usize;
    let mut arrays = BTreeMap::new();
    for number in 0..count {
        let (name, data, next) =
            entry(bytes, at).map_err(|problem| format!("file {number} in it: {problem}"))?;
        if let Some(name) = name.strip_suffix(".npy") {
            arrays.insert(name.to_owned(), data);
        }
        at = next;
    }
    Ok(arrays)
}

/// Name and place of the entry that the directory has at `at`, and where its next one is.
fn entry(bytes: &[u8], at: usize) -> Result<(&str, Range<usize>, usize), String> {
    const SHORT: &str = "the file ends in its directory";
    if u32_at(bytes, at) != Some(CENTRAL) {
        return Err("it is not in the directory".to_owned());
    }
    let word = |offset: usize| u16_at(bytes, at + offset).map(usize::from).ok_or(SHORT);
    let long = |offset: usize| u32_at(bytes, at + offset).ok_or(SHORT);
    if word(10)? != 0 {
        return Err("it is compressed; store it with numpy.savez".to_owned());
    }
    let (crc, size, local) = (long(16)?, long(24)? as usize, long(42)? as usize);
    let (name, extra, comment) = (word(28)?, word(30)?, word(32)?);
    let name_at = at + CENTRAL_BYTES;
    let text = bytes.get(name_at..name_at + name).ok_or(SHORT)?;
    let text = str::from_utf8(text).map_err(|_| "its name is not text")?;
    if u32_at(bytes, local) != Some(LOCAL) {
        return Err("it is not where the directory has it".to_owned());
    }
    let lengths = u16_at(bytes, local + 26).zip(u16_at(bytes, local + 28));
    let (name_length, extra_length) = lengths.ok_or("the file ends in it")?;
    let start = local + LOCAL_BYTES + usize::from(name_length) + usize::from(extra_length);
    let data = bytes.get(start..start.saturating_add(size)).ok_or("the file ends in it")?;
    if crc32fast::hash(data) != crc {
        return Err("its checksum is wrong".to_owned());
    }
    Ok((text, start..start + size, name_at + name + extra + comment))
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    bytes.get(at..)?.first_chunk().copied().map(u16::from_le_bytes)
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().copied().map(u32::from_le_bytes)
}

//! What the header of a PCD file says.

use super::keys::{Keys, REWRITE};
use super::layout::{Field, Layout};
use super::viewpoint;
use crate::cloud::stored::LARGEST_HEADER;
use crate::cloud::text::{Lines, excerpt};
use crate::error::RecordingError;
use std::path::Path;

/// How the points follow the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// A line each.
    Ascii,
    /// One after the other.
    Binary,
    /// All of one field after all of another, compressed.
    Compressed,
}

/// What the header says.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) layout: Layout,
    /// The same where padding takes no room.
    pub(super) unpadded: Layout,
    pub(super) width: u32,
    pub(super) height: u32,
    /// How many points there are.
    pub(super) count: usize,
    /// Bytes before the points.
    pub(super) length: usize,
    /// Lines before the points.
    pub(super) lines: usize,
}

impl Header {
    /// From the beginning of a file.
    pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, RecordingError> {
        let head = bytes.get(..LARGEST_HEADER).unwrap_or(bytes);
        let mut lines = Lines::after(0, head);
        let keys = Keys::parse(path, &mut lines)?;
        let fields = keys.fields()?;
        let [width, height, count] = keys.size()?;
        keys.check_version()?;
        if let Some(words) = keys.get("VIEWPOINT") {
            viewpoint::check(path, words)?;
        }
        Ok(Self {
            encoding: keys.encoding()?,
            layout: Layout::new(path, &fields)?,
            unpadded: Layout::unpadded(path, fields)?,
            width,
            height,
            count: count as usize,
            length: head.len().saturating_sub(lines.rest().len()),
            lines: lines.number(),
        })
    }
}

/// What the lines mean.
impl<'a> Keys<'a> {
    fn check_version(&self) -> Result<(), RecordingError> {
        match self.get("VERSION") {
            // PCL does not insist on it.
            None | Some(".5" | "0.5" | ".6" | "0.6" | ".7" | "0.7") => Ok(()),
            Some(other) => {
                let problem = format!("\"{}\" is not known", excerpt(other.as_bytes()));
                Err(self.invalid("VERSION", problem, "Write the file as version 0.7"))
            }
        }
    }

    fn encoding(&self) -> Result<Encoding, RecordingError> {
        match self.get("DATA").unwrap_or_default() {
            "ascii" => Ok(Encoding::Ascii),
            "binary" => Ok(Encoding::Binary),
            "binary_compressed" => Ok(Encoding::Compressed),
            other => {
                let problem = format!("\"{}\" is not known", excerpt(other.as_bytes()));
                Err(self.invalid("DATA", problem, "Write ascii, binary or binary_compressed"))
            }
        }
    }

    /// `WIDTH`, `HEIGHT` and `POINTS`; old files may have one of them alone.
    fn size(&self) -> Result<[u32; 3], RecordingError> {
        let (width, height, points) =
            (self.number("WIDTH")?, self.number("HEIGHT")?, self.number("POINTS")?);
        let height = height.unwrap_or(1);
        let Some(width) = width.or(points.filter(|_| height == 1)) else {
            return Err(self.invalid("WIDTH", "the line is missing", REWRITE));
        };
        let product = width.checked_mul(height);
        match product.filter(|product| points.is_none_or(|points| points == *product)) {
            Some(product) => Ok([width, height, product]),
            None => {
                let points = points.map_or_else(|| "too many".to_owned(), |n| n.to_string());
                let problem = format!("{points}, but WIDTH x HEIGHT is {width} x {height}");
                Err(self.invalid("POINTS", problem, REWRITE))
            }
        }
    }

    /// The fields; sizes, types and counts that are missing are those of PCL's oldest files.
    fn fields(&self) -> Result<Vec<Field<'a>>, RecordingError> {
        let Some(names) = self.get("FIELDS") else {
            return Err(self.invalid("FIELDS", "the line is missing", REWRITE));
        };
        let names: Vec<_> = names.split_ascii_whitespace().collect();
        let sizes = self.column("SIZE", "4", names.len(), |word| {
            word.parse().ok().filter(|size| [1, 2, 4, 8].contains(size))
        })?;
        let kinds = self.column("TYPE", "F", names.len(), |word| {
            ["I", "U", "F"].into_iter().find(|kind| *kind == word)
        })?;
        let counts = self.column("COUNT", "1", names.len(), |word| {
            word.parse().ok().filter(|count| *count > 0)
        })?;
        let fields = names.into_iter().zip(sizes).zip(kinds).zip(counts);
        Ok(fields.map(|(((name, size), kind), count)| Field { name, kind, size, count }).collect())
    }
}

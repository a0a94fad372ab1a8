//! Which bytes and words of a point are its coordinates.

use crate::cloud::float::Float;
use crate::error::RecordingError;
use std::path::Path;

/// Name of what only fills space.
const PADDING: &str = "_";

/// A field as the header tells it.
#[derive(Debug)]
pub(super) struct Field<'a> {
    pub(super) name: &'a str,
    /// `I`, `U` or `F`.
    pub(super) kind: &'a str,
    /// Bytes of a number.
    pub(super) size: usize,
    /// How many numbers.
    pub(super) count: usize,
}

/// Where x, y and z are in a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) axes: [Axis; 3],
    /// Bytes of a point.
    pub(super) stride: usize,
    /// Words of a point, where it is text.
    pub(super) words: usize,
}

/// Where a coordinate is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Axis {
    /// Bytes before it.
    pub(super) offset: usize,
    /// Words before it.
    pub(super) word: usize,
    pub(super) float: Float,
}

impl Layout {
    /// Of points with `fields`.
    pub(super) fn new(path: &Path, fields: &[Field<'_>]) -> Result<Self, RecordingError> {
        let invalid =
            |problem: String, remedy| RecordingError::invalid(path, "FIELDS", problem, remedy);
        let (mut stride, mut words) = (0_usize, 0_usize);
        let mut found = [None; 3];
        for field in fields {
            let axis =
                ["x", "y", "z"].iter().zip(&mut found).find(|(name, _)| **name == field.name);
            if let Some((name, slot)) = axis {
                let axis = Axis { offset: stride, word: words, float: float(path, field)? };
                if slot.replace(axis).is_some() {
                    return Err(invalid(format!("{name} is there twice"), "Store it once"));
                }
            }
            let size = field.size.checked_mul(field.count);
            let sums =
                size.and_then(|size| stride.checked_add(size)).zip(words.checked_add(field.count));
            (stride, words) = sums.ok_or_else(|| {
                RecordingError::invalid(path, "COUNT", "the numbers are too large", "Correct them")
            })?;
        }
        let [Some(x), Some(y), Some(z)] = found else {
            let names: Vec<_> = fields.iter().take(8).map(|field| field.name).collect();
            let problem = format!("found {}, expected x, y and z among them", names.join(" "));
            return Err(invalid(problem, "Store a cloud of points"));
        };
        Ok(Self { axes: [x, y, z], stride, words })
    }

    /// Of points with `fields`, where padding takes no room.
    pub(super) fn unpadded(path: &Path, fields: Vec<Field<'_>>) -> Result<Self, RecordingError> {
        let mut fields = fields;
        fields.retain(|field| field.name != PADDING);
        Self::new(path, &fields)
    }
}

/// The type of a coordinate.
fn float(path: &Path, field: &Field<'_>) -> Result<Float, RecordingError> {
    match (field.kind, field.size, field.count) {
        ("F", 4, 1) => Ok(Float::Single),
        ("F", 8, 1) => Ok(Float::Double),
        (kind, size, count) => {
            let problem = format!("{} is {count} of type {kind}{size}", field.name);
            let remedy = "Store x, y and z as one F of SIZE 4 or 8 each";
            Err(RecordingError::invalid(path, "FIELDS", problem, remedy))
        }
    }
}

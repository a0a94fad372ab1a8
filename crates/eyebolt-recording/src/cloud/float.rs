//! Coordinates as they are stored.

/// A type of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Float {
    /// Of 4 bytes.
    Single,
    /// Of 8 bytes.
    Double,
}

impl Float {
    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Single => 4,
            Self::Double => 8,
        }
    }

    /// The number that `bytes` begin with; `None` if there are too few.
    pub(super) fn read(self, bytes: &[u8], big_endian: bool) -> Option<f32> {
        Some(match (self, big_endian) {
            (Self::Single, false) => f32::from_le_bytes(*bytes.first_chunk()?),
            (Self::Single, true) => f32::from_be_bytes(*bytes.first_chunk()?),
            (Self::Double, false) => f64::from_le_bytes(*bytes.first_chunk()?) as f32,
            (Self::Double, true) => f64::from_be_bytes(*bytes.first_chunk()?) as f32,
        })
    }

    /// The number that `token` spells; `None` if it spells none.
    pub(super) fn parse(self, token: &[u8]) -> Option<f32> {
        let text = str::from_utf8(token).ok()?;
        let number = match self {
            Self::Single => text.parse().ok(),
            // Not straight to 32 bits: the double that was meant is rounded, as in a binary file.
            Self::Double => text.parse::<f64>().ok().map(|number| number as f32),
        };
        number.or_else(|| is_nan(token).then_some(f32::NAN))
    }
}

/// Whether `token` is a NaN as C libraries write it: `nan`, `-nan`, `nan(0x8000)`, `-nan(ind)`.
fn is_nan(token: &[u8]) -> bool {
    let unsigned = token.strip_prefix(b"-").or(token.strip_prefix(b"+")).unwrap_or(token);
    unsigned.first_chunk::<3>().is_some_and(|start| start.eq_ignore_ascii_case(b"nan"))
}

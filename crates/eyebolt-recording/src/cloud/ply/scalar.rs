//! The types of numbers in PLY files.

use crate::cloud::float::Float;

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    /// Of so many bytes, and whether it has a sign.
    Integer(usize, bool),
    Float(Float),
}

impl Scalar {
    /// From the name in the header, of which there are two for most types.
    pub(super) fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::Integer(1, true),
            "uchar" | "uint8" => Self::Integer(1, false),
            "short" | "int16" => Self::Integer(2, true),
            "ushort" | "uint16" => Self::Integer(2, false),
            "int" | "int32" => Self::Integer(4, true),
            "uint" | "uint32" => Self::Integer(4, false),
            "float" | "float32" => Self::Float(Float::Single),
            "double" | "float64" => Self::Float(Float::Double),
            _ => return None,
        })
    }

    pub(super) fn is_integer(self) -> bool {
        matches!(self, Self::Integer(..))
    }

    /// The type of coordinates that it is, if it can be one.
    pub(super) fn float(self) -> Option<Float> {
        match self {
            Self::Float(float) => Some(float),
            Self::Integer(..) => None,
        }
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Integer(size, _) => size,
            Self::Float(float) => float.size(),
        }
    }
}

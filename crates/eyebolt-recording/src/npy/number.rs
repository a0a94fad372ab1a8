//! The numbers of an array and their types.

/// Types of numbers that an array may hold, by NumPy's names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are NumPy's")]
pub enum Dtype {
    Float32,
    Float64,
    Uint8,
    Uint16,
}

impl Dtype {
    /// NumPy's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float32 => "float32",
            Self::Float64 => "float64",
            Self::Uint8 => "uint8",
            Self::Uint16 => "uint16",
        }
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Float32 => 4,
            Self::Float64 => 8,
            Self::Uint8 => 1,
            Self::Uint16 => 2,
        }
    }

    /// From NumPy's code without the byte order.
    pub(super) fn from_code(code: &str) -> Option<Self> {
        match code {
            "f4" => Some(Self::Float32),
            "f8" => Some(Self::Float64),
            "u1" => Some(Self::Uint8),
            "u2" => Some(Self::Uint16),
            _ => None,
        }
    }
}

/// A number that any [`Dtype`] becomes.
pub trait Number: Copy + Default {
    /// From a `float32`.
    fn from_f32(value: f32) -> Self;
    /// From a `float64`.
    fn from_f64(value: f64) -> Self;
    /// From a `uint16` or `uint8`.
    fn from_u16(value: u16) -> Self;
}

impl Number for f32 {
    fn from_f32(value: f32) -> Self {
        value
    }
    fn from_f64(value: f64) -> Self {
        value as f32
    }
    fn from_u16(value: u16) -> Self {
        Self::from(value)
    }
}

impl Number for f64 {
    fn from_f32(value: f32) -> Self {
        Self::from(value)
    }
    fn from_f64(value: f64) -> Self {
        value
    }
    fn from_u16(value: u16) -> Self {
        Self::from(value)
    }
}

//! Numbers that the plain executor computes with.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A floating-point number: `f32` or `f64`.
pub trait Real:
    Copy
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + std::fmt::Debug
{
    /// From 32 bits.
    fn from_f32(value: f32) -> Self;
    /// To 32 bits, rounded.
    fn to_f32(self) -> f32;
    /// Square root.
    fn sqrt(self) -> Self;
}

impl Real for f32 {
    fn from_f32(value: f32) -> Self {
        value
    }
    fn to_f32(self) -> f32 {
        self
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Real for f64 {
    fn from_f32(value: f32) -> Self {
        value.into()
    }
    fn to_f32(self) -> f32 {
        self as f32
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

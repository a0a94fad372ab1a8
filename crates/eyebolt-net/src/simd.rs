//! The two inner loops that nearly all time is spent in, for the instructions this CPU has.
//!
//! Both multiply through lists of rows, so that nothing is gathered or scattered beforehand. The
//! functions here check every index once per call; what they hand to the instruction sets below
//! stays inside its slices. Which set that is, an [`Isa`] tells, and who has one knows that this CPU
//! can run it.
//!
//! `B` is cut into *panels* of up to [`PANEL`] columns, each stored row after row: a panel of 64
//! columns is four AVX-512 registers wide, and six rows of it are the 24 sums that fill the
//! register file.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod dispatch;
mod isa;
#[cfg(target_arch = "aarch64")]
mod neon;
mod scalar;
mod task;
#[cfg(test)]
mod tests;

pub use dispatch::{multiply_rows, multiply_transposed};
pub use isa::Isa;
pub use task::{PANEL, PANEL_STEP, Rows};

//! The two inner loops that nearly all time is spent in, for the instructions this CPU has.
//!
//! Both multiply through lists of rows, so that nothing is gathered or scattered beforehand. The
//! functions here check every index once per call; what they hand to the instruction sets below
//! stays inside its slices.
//!
//! `B` is cut into *panels* of up to [`PANEL`] columns, each stored row after row: a panel of 64
//! columns is four AVX-512 registers wide, and six rows of it are the 24 sums that fill the
//! register file.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "aarch64")]
mod neon;
mod scalar;
#[cfg(test)]
mod tests;

/// Columns of a full panel.
pub const PANEL: usize = 64;
/// Widths of panels are multiples of this.
pub const PANEL_STEP: usize = 16;

/// A set of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// x86-64 with 512-bit registers.
    Avx512,
    /// x86-64 with 256-bit registers and fused multiply-add.
    Avx2,
    /// 64-bit ARM.
    Neon,
    /// What the compiler makes of plain loops.
    Scalar,
}

impl Isa {
    /// All that this CPU can run, the fastest first.
    pub fn available() -> Vec<Self> {
        let mut found = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") {
                found.push(Self::Avx512);
            }
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                found.push(Self::Avx2);
            }
        }
        // Every 64-bit ARM has it.
        #[cfg(target_arch = "aarch64")]
        found.push(Self::Neon);
        found.push(Self::Scalar);
        found
    }

    /// The fastest that this CPU can run.
    pub fn detect() -> Self {
        Self::available()[0]
    }

    /// Its usual name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Avx512 => "AVX-512",
            Self::Avx2 => "AVX2",
            Self::Neon => "NEON",
            Self::Scalar => "scalar",
        }
    }
}

/// Row-major matrix, borrowed.
#[derive(Clone, Copy)]
pub struct Rows<'a> {
    /// Row after row.
    pub values: &'a [f32],
    /// Values in a row.
    pub width: usize,
}

/// `C[output[p]] += A[input[p]] B` for every pair `p`.
///
/// `a`: rows of `K` values. `panel`: `K` rows of `width` columns, `width` a multiple of
/// [`PANEL_STEP`] up to [`PANEL`]. `c`: rows of `width`. No two pairs may share an output.
///
/// # Panics
/// If an index lies outside its matrix.
pub fn multiply_rows(
    isa: Isa,
    a: Rows<'_>,
    input: &[u32],
    panel: Rows<'_>,
    c: &mut [f32],
    output: &[u16],
) {
    let (depth, width) = (a.width, panel.width);
    assert!(width.is_multiple_of(PANEL_STEP) && (PANEL_STEP..=PANEL).contains(&width));
    assert_eq!(input.len(), output.len(), "one input for each output");
    assert_eq!(panel.values.len(), depth * width, "size of the panel");
    if input.is_empty() || depth == 0 {
        return;
    }
    let highest_input = input.iter().copied().max().unwrap_or(0) as usize;
    assert!((highest_input + 1) * depth <= a.values.len(), "input {highest_input} is outside");
    let highest_output = usize::from(output.iter().copied().max().unwrap_or(0));
    assert!((highest_output + 1) * width <= c.len(), "output {highest_output} is outside");
    let task = MultiplyRows { a: a.values, depth, input, panel: panel.values, width, output };
    match isa {
        #[cfg(target_arch = "x86_64")]
        Isa::Avx512 => avx512::multiply_rows(&task, c),
        #[cfg(target_arch = "x86_64")]
        Isa::Avx2 => avx2::multiply_rows(&task, c),
        #[cfg(target_arch = "aarch64")]
        Isa::Neon => neon::multiply_rows(&task, c),
        _ => scalar::multiply_rows(&task, c),
    }
}

/// `C[i] += sum over p of A[input[p]][first + i] B[p]`: a product with `A` transposed, for the
/// rows `i` of `c`.
///
/// `b`: one row of `width` for every `p`, `width` as in [`multiply_rows`]. `c`: rows of `width`,
/// one for each column of `A` from `first` on. `next`: rows of `A` that the next call will want.
///
/// # Panics
/// If an index lies outside its matrix.
pub fn multiply_transposed(
    isa: Isa,
    a: Rows<'_>,
    input: &[u32],
    first: usize,
    b: Rows<'_>,
    c: &mut [f32],
    next: &[u32],
) {
    let (stride, width) = (a.width, b.width);
    assert!(width.is_multiple_of(PANEL_STEP) && (PANEL_STEP..=PANEL).contains(&width));
    assert_eq!(b.values.len(), input.len() * width, "one row of B for each pair");
    assert!(c.len().is_multiple_of(width) && first + c.len() / width <= stride, "columns of A");
    if input.is_empty() || c.is_empty() {
        return;
    }
    let highest_input = input.iter().copied().max().unwrap_or(0) as usize;
    assert!((highest_input + 1) * stride <= a.values.len(), "input {highest_input} is outside");
    let task = MultiplyTransposed { a: a.values, stride, first, input, b: b.values, width, next };
    match isa {
        #[cfg(target_arch = "x86_64")]
        Isa::Avx512 => avx512::multiply_transposed(&task, c),
        #[cfg(target_arch = "x86_64")]
        Isa::Avx2 => avx2::multiply_transposed(&task, c),
        #[cfg(target_arch = "aarch64")]
        Isa::Neon => neon::multiply_transposed(&task, c),
        _ => scalar::multiply_transposed(&task, c),
    }
}

/// A checked call of [`multiply_rows`].
struct MultiplyRows<'a> {
    a: &'a [f32],
    depth: usize,
    input: &'a [u32],
    panel: &'a [f32],
    width: usize,
    output: &'a [u16],
}

/// A checked call of [`multiply_transposed`].
struct MultiplyTransposed<'a> {
    a: &'a [f32],
    stride: usize,
    first: usize,
    input: &'a [u32],
    b: &'a [f32],
    width: usize,
    /// Only fetched.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
    next: &'a [u32],
}

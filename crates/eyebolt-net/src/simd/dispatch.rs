//! Calls, checked and handed to the instructions that this CPU has.

#[cfg(target_arch = "x86_64")]
use super::avx2;
#[cfg(target_arch = "x86_64")]
use super::avx512;
use super::isa::{Instructions, Isa};
#[cfg(target_arch = "aarch64")]
use super::neon;
use super::scalar;
use super::task::{MultiplyRows, MultiplyTransposed, PANEL, PANEL_STEP, Rows};

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
    match isa.instructions() {
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx512 => avx512::multiply_rows(&task, c),
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2 => avx2::multiply_rows(&task, c),
        #[cfg(target_arch = "aarch64")]
        Instructions::Neon => neon::multiply_rows(&task, c),
        Instructions::Scalar => scalar::multiply_rows(&task, c),
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
    match isa.instructions() {
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx512 => avx512::multiply_transposed(&task, c),
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2 => avx2::multiply_transposed(&task, c),
        #[cfg(target_arch = "aarch64")]
        Instructions::Neon => neon::multiply_transposed(&task, c),
        Instructions::Scalar => scalar::multiply_transposed(&task, c),
    }
}

//! What the instruction sets are handed: slices, and indices that stay inside them.

/// Columns of a full panel.
pub const PANEL: usize = 64;
/// Widths of panels are multiples of this.
pub const PANEL_STEP: usize = 16;

/// Row-major matrix, borrowed.
#[derive(Clone, Copy)]
pub struct Rows<'a> {
    /// Row after row.
    pub values: &'a [f32],
    /// Values in a row.
    pub width: usize,
}

/// A checked call of [`multiply_rows`](super::multiply_rows).
pub(super) struct MultiplyRows<'a> {
    pub(super) a: &'a [f32],
    pub(super) depth: usize,
    pub(super) input: &'a [u32],
    pub(super) panel: &'a [f32],
    pub(super) width: usize,
    pub(super) output: &'a [u16],
}

/// A checked call of [`multiply_transposed`](super::multiply_transposed).
pub(super) struct MultiplyTransposed<'a> {
    pub(super) a: &'a [f32],
    pub(super) stride: usize,
    pub(super) first: usize,
    pub(super) input: &'a [u32],
    pub(super) b: &'a [f32],
    pub(super) width: usize,
    /// Only fetched.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
    pub(super) next: &'a [u32],
}

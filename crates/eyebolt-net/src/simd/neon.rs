//! NEON: tiles of six rows by four registers of four.
#![allow(unsafe_code)]
// Rows and registers of a tile are numbered; iterators over both hide which is which.
#![allow(clippy::needless_range_loop)]

use super::task::{MultiplyRows, MultiplyTransposed};
use std::arch::aarch64::{float32x4_t, vaddq_f32, vdupq_n_f32, vfmaq_n_f32, vld1q_f32, vst1q_f32};

const LANES: usize = 4;
/// Registers of `B`; a panel is passed over once for each sixteen columns.
const VECTORS: usize = 4;
const STRIP: usize = VECTORS * LANES;
/// With four registers of `B`, 24 sums of 32 registers.
const TILE: usize = 6;

pub fn multiply_rows(task: &MultiplyRows<'_>, c: &mut [f32]) {
    let pairs = task.input.len();
    let whole = pairs - pairs % TILE;
    let c = c.as_mut_ptr();
    for column in (0..task.width).step_by(STRIP) {
        // SAFETY: every 64-bit ARM has NEON; the indices were checked by `super::multiply_rows`,
        // and widths are multiples of `STRIP`.
        unsafe {
            for first in (0..whole).step_by(TILE) {
                rows_tile::<TILE>(task, first, column, c);
            }
            match pairs - whole {
                1 => rows_tile::<1>(task, whole, column, c),
                2 => rows_tile::<2>(task, whole, column, c),
                3 => rows_tile::<3>(task, whole, column, c),
                4 => rows_tile::<4>(task, whole, column, c),
                5 => rows_tile::<5>(task, whole, column, c),
                _ => {}
            }
        }
    }
}

pub fn multiply_transposed(task: &MultiplyTransposed<'_>, c: &mut [f32]) {
    let columns = c.len() / task.width;
    let whole = columns - columns % TILE;
    let c = c.as_mut_ptr();
    for strip in (0..task.width).step_by(STRIP) {
        // SAFETY: as above, checked by `super::multiply_transposed`.
        unsafe {
            for column in (0..whole).step_by(TILE) {
                transposed_tile::<TILE>(task, column, strip, c);
            }
            match columns - whole {
                1 => transposed_tile::<1>(task, whole, strip, c),
                2 => transposed_tile::<2>(task, whole, strip, c),
                3 => transposed_tile::<3>(task, whole, strip, c),
                4 => transposed_tile::<4>(task, whole, strip, c),
                5 => transposed_tile::<5>(task, whole, strip, c),
                _ => {}
            }
        }
    }
}

/// # Safety
/// `first + R` pairs and `column + STRIP` columns at least; every input row inside `a`, every
/// output row inside `c`, `panel` of `depth` rows of `width` values.
#[inline]
#[target_feature(enable = "neon")]
unsafe fn rows_tile<const R: usize>(
    task: &MultiplyRows<'_>,
    first: usize,
    column: usize,
    c: *mut f32,
) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut a = [std::ptr::null::<f32>(); R];
        for r in 0..R {
            let input = *task.input.get_unchecked(first + r) as usize;
            a[r] = task.a.as_ptr().add(input * task.depth);
        }
        let mut sums = [[vdupq_n_f32(0.0); VECTORS]; R];
        let mut b = task.panel.as_ptr().wrapping_add(column);
        for k in 0..task.depth {
            let row = load(b);
            for r in 0..R {
                let value = *a[r].add(k);
                for v in 0..VECTORS {
                    sums[r][v] = vfmaq_n_f32(sums[r][v], row[v], value);
                }
            }
            b = b.wrapping_add(task.width);
        }
        for r in 0..R {
            let output = usize::from(*task.output.get_unchecked(first + r));
            add_to(c.add(output * task.width + column), sums[r]);
        }
    }
}

/// # Safety
/// `column + R` columns of `A` and `strip + STRIP` of `B` at least; every input row of `stride`
/// values inside `a`, one row of `width` values in `b` for each, and one in `c` for each column.
#[inline]
#[target_feature(enable = "neon")]
unsafe fn transposed_tile<const R: usize>(
    task: &MultiplyTransposed<'_>,
    column: usize,
    strip: usize,
    c: *mut f32,
) {
    // SAFETY: the caller's promise.
    unsafe {
        let a = task.a.as_ptr().add(task.first + column);
        let mut sums = [[vdupq_n_f32(0.0); VECTORS]; R];
        let mut b = task.b.as_ptr().wrapping_add(strip);
        for &input in task.input {
            let a = a.add(input as usize * task.stride);
            let row = load(b);
            for r in 0..R {
                let value = *a.add(r);
                for v in 0..VECTORS {
                    sums[r][v] = vfmaq_n_f32(sums[r][v], row[v], value);
                }
            }
            b = b.wrapping_add(task.width);
        }
        for r in 0..R {
            add_to(c.add((column + r) * task.width + strip), sums[r]);
        }
    }
}

/// # Safety
/// [`STRIP`] values at `from`.
#[inline]
#[target_feature(enable = "neon")]
unsafe fn load(from: *const f32) -> [float32x4_t; VECTORS] {
    let mut row = [vdupq_n_f32(0.0); VECTORS];
    for (v, register) in row.iter_mut().enumerate() {
        // SAFETY: the caller's promise.
        *register = unsafe { vld1q_f32(from.add(v * LANES)) };
    }
    row
}

/// # Safety
/// [`STRIP`] values at `to`.
#[inline]
#[target_feature(enable = "neon")]
unsafe fn add_to(to: *mut f32, sums: [float32x4_t; VECTORS]) {
    for (v, sum) in sums.into_iter().enumerate() {
        // SAFETY: the caller's promise.
        unsafe {
            let to = to.add(v * LANES);
            vst1q_f32(to, vaddq_f32(vld1q_f32(to), sum));
        }
    }
}

//! AVX2 with fused multiply-add: tiles of six rows by two registers of eight.
#![allow(unsafe_code)]
// Rows and registers of a tile are numbered; iterators over both hide which is which.
#![allow(clippy::needless_range_loop)]

use super::task::{MultiplyRows, MultiplyTransposed};
use std::arch::x86_64::{
    _MM_HINT_T0, _MM_HINT_T1, _mm_prefetch, _mm256_add_ps, _mm256_fmadd_ps, _mm256_loadu_ps,
    _mm256_set1_ps, _mm256_setzero_ps, _mm256_storeu_ps,
};

const LANES: usize = 8;
/// Registers of `B`; a panel is passed over once for each sixteen columns.
const VECTORS: usize = 2;
const STRIP: usize = VECTORS * LANES;
/// With two registers of `B`, twelve sums and one value of `A`, of sixteen registers.
const TILE: usize = 6;

pub fn multiply_rows(task: &MultiplyRows<'_>, c: &mut [f32]) {
    // SAFETY: `Instructions::Avx2` comes out of an `Isa` only, which is made only where the CPU has
    // AVX2 and FMA; the indices were checked by `super::multiply_rows`.
    unsafe { rows(task, c.as_mut_ptr()) }
}

pub fn multiply_transposed(task: &MultiplyTransposed<'_>, c: &mut [f32]) {
    // SAFETY: as above, checked by `super::multiply_transposed`.
    unsafe { transposed(task, c.len() / task.width, c.as_mut_ptr()) }
}

/// All pairs, a tile at a time, the rest in one smaller tile.
///
/// # Safety
/// AVX2 and FMA; every input row inside `a`, every output row inside `c`, `panel` of `depth` rows
/// of `width` values, `width` a multiple of [`STRIP`].
#[target_feature(enable = "avx2,fma")]
unsafe fn rows(task: &MultiplyRows<'_>, c: *mut f32) {
    let pairs = task.input.len();
    let whole = pairs - pairs % TILE;
    for first in (0..whole).step_by(TILE) {
        prefetch_rows(task, first + TILE);
        for column in (0..task.width).step_by(STRIP) {
            // SAFETY: the caller's promise, for a part of its pairs and columns.
            unsafe { rows_tile::<TILE>(task, first, column, c) }
        }
    }
    for column in (0..task.width).step_by(STRIP) {
        // SAFETY: as above.
        unsafe {
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

/// The rows of the tile after this one: they lie where no prefetcher guesses.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn prefetch_rows(task: &MultiplyRows<'_>, first: usize) {
    for &input in task.input.iter().skip(first).take(TILE) {
        let row = &task.a[input as usize * task.depth..][..task.depth];
        for line in row.chunks(16) {
            _mm_prefetch::<_MM_HINT_T0>(line.as_ptr().cast());
        }
    }
}

/// # Safety
/// As [`rows`]; `first + R` pairs and `column + STRIP` columns at least.
#[inline]
#[target_feature(enable = "avx2,fma")]
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
        let mut sums = [[_mm256_setzero_ps(); VECTORS]; R];
        let mut b = task.panel.as_ptr().add(column);
        for k in 0..task.depth {
            let row = [_mm256_loadu_ps(b), _mm256_loadu_ps(b.add(LANES))];
            for r in 0..R {
                let value = _mm256_set1_ps(*a[r].add(k));
                sums[r][0] = _mm256_fmadd_ps(value, row[0], sums[r][0]);
                sums[r][1] = _mm256_fmadd_ps(value, row[1], sums[r][1]);
            }
            b = b.wrapping_add(task.width);
        }
        for r in 0..R {
            let output = usize::from(*task.output.get_unchecked(first + r));
            let c = c.add(output * task.width + column);
            for v in 0..VECTORS {
                let at = c.add(v * LANES);
                _mm256_storeu_ps(at, _mm256_add_ps(_mm256_loadu_ps(at), sums[r][v]));
            }
        }
    }
}

/// # Safety
/// AVX2 and FMA; every input row of `stride` values inside `a`, `first + columns <= stride`, one
/// row of `width` values in `b` for each, and `columns` of them in `c`.
#[target_feature(enable = "avx2,fma")]
unsafe fn transposed(task: &MultiplyTransposed<'_>, columns: usize, c: *mut f32) {
    let whole = columns - columns % TILE;
    for strip in (0..task.width).step_by(STRIP) {
        // SAFETY: the caller's promise, for a part of its columns.
        unsafe {
            for column in (0..whole).step_by(TILE) {
                if strip == 0 {
                    prefetch_columns(task, column);
                }
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

/// These columns of the rows that come next, where a tile enters another line of cache.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn prefetch_columns(task: &MultiplyTransposed<'_>, column: usize) {
    if column % 16 >= TILE {
        return;
    }
    for &input in task.next {
        let place = input as usize * task.stride + task.first + column;
        if let Some(value) = task.a.get(place) {
            _mm_prefetch::<_MM_HINT_T1>(std::ptr::from_ref(value).cast());
        }
    }
}

/// # Safety
/// As [`transposed`]; `column + R` columns of `A` and `strip + STRIP` of `B` at least.
#[inline]
#[target_feature(enable = "avx2,fma")]
unsafe fn transposed_tile<const R: usize>(
    task: &MultiplyTransposed<'_>,
    column: usize,
    strip: usize,
    c: *mut f32,
) {
    // SAFETY: the caller's promise.
    unsafe {
        let a = task.a.as_ptr().add(task.first + column);
        let mut sums = [[_mm256_setzero_ps(); VECTORS]; R];
        let mut b = task.b.as_ptr().add(strip);
        for &input in task.input {
            let a = a.add(input as usize * task.stride);
            let row = [_mm256_loadu_ps(b), _mm256_loadu_ps(b.add(LANES))];
            for r in 0..R {
                let value = _mm256_set1_ps(*a.add(r));
                sums[r][0] = _mm256_fmadd_ps(value, row[0], sums[r][0]);
                sums[r][1] = _mm256_fmadd_ps(value, row[1], sums[r][1]);
            }
            b = b.wrapping_add(task.width);
        }
        for r in 0..R {
            let c = c.add((column + r) * task.width + strip);
            for v in 0..VECTORS {
                let at = c.add(v * LANES);
                _mm256_storeu_ps(at, _mm256_add_ps(_mm256_loadu_ps(at), sums[r][v]));
            }
        }
    }
}

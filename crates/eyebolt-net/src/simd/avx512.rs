//! AVX-512: tiles of six rows by up to four registers of sixteen.
#![allow(unsafe_code)]
// Rows and registers of a tile are numbered; iterators over both hide which is which.
#![allow(clippy::needless_range_loop)]

use super::task::{MultiplyRows, MultiplyTransposed};
use std::arch::x86_64::{
    _MM_HINT_T0, _MM_HINT_T1, _mm_prefetch, _mm512_fmadd_ps, _mm512_loadu_ps, _mm512_set1_ps,
    _mm512_setzero_ps, _mm512_storeu_ps,
};

const LANES: usize = 16;
/// With four registers of `B`, 24 sums: of 32 registers none is left over that would help.
const TILE: usize = 6;

pub fn multiply_rows(task: &MultiplyRows<'_>, c: &mut [f32]) {
    // SAFETY: `Instructions::Avx512` comes out of an `Isa` only, which is made only where the CPU has
    // AVX-512F; the indices were checked by `super::multiply_rows`.
    unsafe {
        match task.width / LANES {
            1 => rows::<1>(task, c.as_mut_ptr()),
            2 => rows::<2>(task, c.as_mut_ptr()),
            3 => rows::<3>(task, c.as_mut_ptr()),
            _ => rows::<4>(task, c.as_mut_ptr()),
        }
    }
}

pub fn multiply_transposed(task: &MultiplyTransposed<'_>, c: &mut [f32]) {
    let columns = c.len() / task.width;
    // SAFETY: as above, checked by `super::multiply_transposed`.
    unsafe {
        match task.width / LANES {
            1 => transposed::<1>(task, columns, c.as_mut_ptr()),
            2 => transposed::<2>(task, columns, c.as_mut_ptr()),
            3 => transposed::<3>(task, columns, c.as_mut_ptr()),
            _ => transposed::<4>(task, columns, c.as_mut_ptr()),
        }
    }
}

/// All pairs, a tile at a time, the rest in one smaller tile.
///
/// # Safety
/// AVX-512F; every input row inside `a`, every output row inside `c`, `panel` of `depth` rows of
/// `16 V` values.
#[target_feature(enable = "avx512f")]
unsafe fn rows<const V: usize>(task: &MultiplyRows<'_>, c: *mut f32) {
    let pairs = task.input.len();
    let whole = pairs - pairs % TILE;
    // SAFETY: the caller's promise, for a part of its pairs.
    unsafe {
        for first in (0..whole).step_by(TILE) {
            prefetch_rows(task, first + TILE);
            rows_tile::<TILE, V>(task, first, c);
        }
        match pairs - whole {
            1 => rows_tile::<1, V>(task, whole, c),
            2 => rows_tile::<2, V>(task, whole, c),
            3 => rows_tile::<3, V>(task, whole, c),
            4 => rows_tile::<4, V>(task, whole, c),
            5 => rows_tile::<5, V>(task, whole, c),
            _ => {}
        }
    }
}

/// The rows of the tile after this one: they lie where no prefetcher guesses.
#[inline]
#[target_feature(enable = "avx512f")]
fn prefetch_rows(task: &MultiplyRows<'_>, first: usize) {
    for &input in task.input.iter().skip(first).take(TILE) {
        let row = &task.a[input as usize * task.depth..][..task.depth];
        for line in row.chunks(LANES) {
            _mm_prefetch::<_MM_HINT_T0>(line.as_ptr().cast());
        }
    }
}

/// # Safety
/// As [`rows`], and `first + R` pairs at least.
#[inline]
#[target_feature(enable = "avx512f")]
unsafe fn rows_tile<const R: usize, const V: usize>(
    task: &MultiplyRows<'_>,
    first: usize,
    c: *mut f32,
) {
    let width = V * LANES;
    // SAFETY: the caller's promise.
    unsafe {
        let mut a = [std::ptr::null::<f32>(); R];
        for r in 0..R {
            let input = *task.input.get_unchecked(first + r) as usize;
            a[r] = task.a.as_ptr().add(input * task.depth);
        }
        let mut sums = [[_mm512_setzero_ps(); V]; R];
        let mut b = task.panel.as_ptr();
        for k in 0..task.depth {
            let mut row = [_mm512_setzero_ps(); V];
            for v in 0..V {
                row[v] = _mm512_loadu_ps(b.add(v * LANES));
            }
            for r in 0..R {
                let value = _mm512_set1_ps(*a[r].add(k));
                for v in 0..V {
                    sums[r][v] = _mm512_fmadd_ps(value, row[v], sums[r][v]);
                }
            }
            b = b.add(width);
        }
        for r in 0..R {
            let output = usize::from(*task.output.get_unchecked(first + r));
            let c = c.add(output * width);
            for v in 0..V {
                let at = c.add(v * LANES);
                let total = std::arch::x86_64::_mm512_add_ps(_mm512_loadu_ps(at), sums[r][v]);
                _mm512_storeu_ps(at, total);
            }
        }
    }
}

/// # Safety
/// AVX-512F; every input row of `stride` values inside `a`, `first + columns <= stride`, one row
/// of `16 V` values in `b` for each, and `columns` of them in `c`.
#[target_feature(enable = "avx512f")]
unsafe fn transposed<const V: usize>(task: &MultiplyTransposed<'_>, columns: usize, c: *mut f32) {
    let whole = columns - columns % TILE;
    // SAFETY: the caller's promise, for a part of its columns.
    unsafe {
        for column in (0..whole).step_by(TILE) {
            prefetch_columns(task, column);
            transposed_tile::<TILE, V>(task, column, c);
        }
        match columns - whole {
            1 => transposed_tile::<1, V>(task, whole, c),
            2 => transposed_tile::<2, V>(task, whole, c),
            3 => transposed_tile::<3, V>(task, whole, c),
            4 => transposed_tile::<4, V>(task, whole, c),
            5 => transposed_tile::<5, V>(task, whole, c),
            _ => {}
        }
    }
}

/// These columns of the rows that come next, where a tile enters another line of cache.
#[inline]
#[target_feature(enable = "avx512f")]
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
/// As [`transposed`], and `column + R` columns at least.
#[inline]
#[target_feature(enable = "avx512f")]
unsafe fn transposed_tile<const R: usize, const V: usize>(
    task: &MultiplyTransposed<'_>,
    column: usize,
    c: *mut f32,
) {
    let width = V * LANES;
    // SAFETY: the caller's promise.
    unsafe {
        let a = task.a.as_ptr().add(task.first + column);
        let mut sums = [[_mm512_setzero_ps(); V]; R];
        let mut b = task.b.as_ptr();
        for &input in task.input {
            let a = a.add(input as usize * task.stride);
            let mut row = [_mm512_setzero_ps(); V];
            for v in 0..V {
                row[v] = _mm512_loadu_ps(b.add(v * LANES));
            }
            for r in 0..R {
                let value = _mm512_set1_ps(*a.add(r));
                for v in 0..V {
                    sums[r][v] = _mm512_fmadd_ps(value, row[v], sums[r][v]);
                }
            }
            b = b.add(width);
        }
        for r in 0..R {
            let c = c.add((column + r) * width);
            for v in 0..V {
                let at = c.add(v * LANES);
                let total = std::arch::x86_64::_mm512_add_ps(_mm512_loadu_ps(at), sums[r][v]);
                _mm512_storeu_ps(at, total);
            }
        }
    }
}

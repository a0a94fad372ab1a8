//! Plain loops: the fallback, and what the other instruction sets are tested against.

use super::task::{MultiplyRows, MultiplyTransposed};

pub fn multiply_rows(task: &MultiplyRows<'_>, c: &mut [f32]) {
    let (depth, width) = (task.depth, task.width);
    for (&input, &output) in task.input.iter().zip(task.output) {
        let row = &task.a[input as usize * depth..][..depth];
        let sums = &mut c[usize::from(output) * width..][..width];
        for (&value, b) in row.iter().zip(task.panel.chunks_exact(width)) {
            for (sum, &b) in sums.iter_mut().zip(b) {
                *sum += value * b;
            }
        }
    }
}

pub fn multiply_transposed(task: &MultiplyTransposed<'_>, c: &mut [f32]) {
    let width = task.width;
    let columns = c.len() / width;
    for (&input, b) in task.input.iter().zip(task.b.chunks_exact(width)) {
        let row = &task.a[input as usize * task.stride + task.first..][..columns];
        for (&value, sums) in row.iter().zip(c.chunks_exact_mut(width)) {
            for (sum, &b) in sums.iter_mut().zip(b) {
                *sum += value * b;
            }
        }
    }
}

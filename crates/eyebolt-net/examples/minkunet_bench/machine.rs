//! What the machine does: its plain matrix product, its memory; and the work of a network.

use crate::Failure;
use eyebolt_net::Graph;
use eyebolt_net::coordinates::{KernelMap, Neighbours};
use eyebolt_net::graph::{MapSpec, Op};
use std::time::Instant;

/// Of matrices of 2048 squared, the best of a few.
pub fn sgemm_gflop_per_s(threads: usize) -> f64 {
    let n = 2048;
    let (a, b, mut c) = (vec![1.0_f32; n * n], vec![1.0_f32; n * n], vec![0.0_f32; n * n]);
    let parallelism = gemm::Parallelism::Rayon(threads);
    let stride = n as isize;
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        // SAFETY: three matrices of n rows of n values, row after row.
        #[allow(unsafe_code)]
        unsafe {
            gemm::gemm(
                n,
                n,
                n,
                c.as_mut_ptr(),
                1,
                stride,
                false,
                a.as_ptr(),
                1,
                stride,
                b.as_ptr(),
                1,
                stride,
                0.0,
                1.0,
                false,
                false,
                false,
                parallelism,
            );
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    2e-9 * (n as f64).powi(3) / best
}

/// Multiply-adds of the convolutions and linear layers, in 10^9.
pub fn gmac(graph: &Graph, neighbours: &mut Neighbours) -> Result<f64, Failure> {
    let mut total = 0.0;
    let finest = neighbours.voxels(1)?.len();
    for node in graph.nodes() {
        let Op::Convolution { map, weight, .. } = node.op else { continue };
        let pairs = match map.map(|map| graph.maps()[map.index()]) {
            Some(MapSpec::Kernel(spec)) => KernelMap::pairs(&*neighbours.map(spec)?),
            _ => match graph.domains()[node.domain] {
                eyebolt_net::graph::Domain::Voxels { stride } => neighbours.voxels(stride)?.len(),
                _ => finest,
            },
        };
        let spec = &graph.parameters()[weight.index()];
        let per_pair: usize = spec.shape.iter().rev().take(2).product();
        total += 1e-9 * pairs as f64 * per_pair as f64;
    }
    Ok(total)
}

/// Processor time of all threads so far, in steps of 10 ms: what a busy machine does not change.
/// Zero where the system does not tell.
pub fn cpu_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name before may hold blanks; user and system time are fields 14 and 15.
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    0.01 * fields.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>()
}

/// Memory in use.
pub fn rss_mib() -> f64 {
    status("VmRSS")
}

/// The most that was in use so far.
pub fn peak_rss_mib() -> f64 {
    status("VmHWM")
}

/// Zero where the system does not tell.
fn status(field: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with(field));
    let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kib.unwrap_or(0.0) / 1024.0
}

//! Small inputs and networks that tests share.

use eyebolt_net::coordinates::{Kernel, KernelSpec};
use eyebolt_net::graph::{Domain, Graph, GraphBuilder, NodeId, Source};
use eyebolt_net::{Matrix, Parameters};

/// Numbers without a pattern, uniform in `[-1, 1)`, the same ones in every run (Marsaglia's
/// xorshift).
pub fn noise(seed: u64, count: usize) -> Vec<f32> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1 << 23) as f32 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// A wavy sheet of voxels in each of two items, with a few points twice.
pub fn sheet(edge: i32) -> Vec<[i32; 4]> {
    let voxel = |item: i32, x: i32, y: i32| [item, x - 7, y - 3, (x * y + item) % 5 + x / 3 - 4];
    let cells = (0..2).flat_map(|item| {
        (0..edge).flat_map(move |x| (0..edge - item).map(move |y| voxel(item, x, y)))
    });
    let mut all: Vec<[i32; 4]> = cells.collect();
    all.extend_from_within(3..9);
    all
}

/// Features for so many points.
pub fn features(seed: u64, rows: usize, channels: usize) -> Matrix {
    Matrix::new(rows, channels, noise(seed, rows * channels)).unwrap()
}

/// Parameters with every value disturbed, so that no batch norm is an identity.
pub fn parameters(graph: &Graph, seed: u64) -> Parameters {
    let initial = Parameters::initial(graph, seed);
    let disturbed = initial.values().iter().zip(0..).map(|(values, place)| {
        let noise = noise(seed + place, values.len());
        values.iter().zip(noise).map(|(value, noise)| value + 0.2 * noise).collect()
    });
    Parameters::new(graph, disturbed.collect()).unwrap()
}

/// A kernel within one resolution.
pub fn within(size: u32, dilation: u32, stride: u32) -> KernelSpec {
    KernelSpec::within(Kernel { size, dilation, flat: false }, stride)
}

/// Every operation on voxels once, with branches that join and values used twice.
pub fn every_operation() -> Graph {
    let mut g = GraphBuilder::new();
    let input = g.input(Source::Features, Domain::Voxels { stride: 1 }, 3);
    let a = g.convolution("stem", input, within(5, 1, 1), 18, false).unwrap();
    let a = g.batch_norm("stem.norm", a);
    let a = g.relu(a);
    let b = g.convolution("dilated", a, within(3, 2, 1), 18, true).unwrap();
    let b = g.leaky_relu(b, 0.1);
    let sum = g.add("sum", a, b).unwrap();
    let sum = g.relu(sum);
    let down = g.convolution("down", sum, KernelSpec::down(2, 1, 2), 20, false).unwrap();
    let down = g.batch_norm("down.norm", down);
    let wide = g.convolution("wide", down, KernelSpec::down(3, 2, 2), 7, true).unwrap();
    let even = g.convolution("even", wide, within(2, 1, 4), 70, false).unwrap();
    let even = g.dropout(even, 0.3);
    let up = g.convolution("up", even, KernelSpec::up(3, 4, 2), 20, false).unwrap();
    let joined = g.concatenate("joined", &[up, down]).unwrap();
    let joined = g.batch_norm("joined.norm", joined);
    let up = g.convolution("up2", joined, KernelSpec::up(2, 2, 2), 9, true).unwrap();
    let up = g.convolution("plain", up, within(1, 1, 1), 11, true).unwrap();
    let points = g.slice("slice", up).unwrap();
    let points = g.linear("head", points, 5, true);
    let pooled = pooled(&mut g, even);
    g.finish(&[points, pooled]).unwrap()
}

fn pooled(g: &mut GraphBuilder, value: NodeId) -> NodeId {
    let mean = g.global_average_pool("mean", value).unwrap();
    let largest = g.global_max_pool("largest", value).unwrap();
    let both = g.concatenate("both", &[mean, largest]).unwrap();
    g.linear("regression", both, 4, true)
}

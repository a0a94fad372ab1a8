//! Every operation, forward and backward, against plain PyTorch in 64 bits.

use crate::fixtures::{Fixture, assert_close, hashed_matrix, parameters, reordered};
use crate::runs::{executors, forward_backward};
use crate::scenes::within;
use eyebolt_net::coordinates::{KernelSpec, Neighbours, VoxelSet};
use eyebolt_net::graph::{Domain, GraphBuilder, Source};
use eyebolt_net::{Batch, Graph, Matrix};

const TOLERANCE: f32 = 1e-5;

/// The batch of a graph on the fixture's cells, and the finest voxels in its order.
fn batch(graph: &Graph, cells: &[[i32; 4]], name: &str, channels: usize) -> (Batch, Vec<[i32; 4]>) {
    let features = hashed_matrix(&format!("{name}.features"), cells.len(), channels);
    let batch = Batch::from_voxels(graph, cells, &features).unwrap();
    (batch, VoxelSet::new(cells).unwrap().0.coordinates())
}

/// A gradient in the fixture's order of rows, for values in ours.
fn weigh(name: &str, have: &[[i32; 4]], rows: &[[i32; 4]], channels: usize) -> Matrix {
    let theirs = hashed_matrix(&format!("{name}.weigh"), rows.len(), channels);
    Matrix::new(rows.len(), channels, reordered(&theirs, rows, have)).unwrap()
}

fn convolution(
    name: &str,
    inputs: usize,
    outputs: usize,
    first: Option<KernelSpec>,
    spec: KernelSpec,
) {
    let fixture = Fixture::read("operations");
    let cells = fixture.cells("cells");
    let mut g = GraphBuilder::new();
    let mut x = g.input(Source::Features, Domain::Voxels { stride: 1 }, inputs);
    if let Some(first) = first {
        x = g.convolution("first", x, first, inputs, false).unwrap();
    }
    let y = g.convolution(name, x, spec, outputs, true).unwrap();
    let graph = g.finish(&[y]).unwrap();
    let half = |name: &str, _: &[usize], values: Vec<f32>| {
        let scale = if name.ends_with(".kernel") { 0.5 } else { 1.0 };
        values.into_iter().map(|value| scale * value).collect()
    };
    let parameters = parameters(&graph, half);
    let (batch, finest) = batch(&graph, &cells, name, inputs);
    let mut neighbours = Neighbours::new(VoxelSet::new(&cells).unwrap().0);
    let have = neighbours.voxels(spec.to).unwrap().coordinates();
    let rows = fixture.cells(&format!("{name}.rows"));
    for mut executor in executors() {
        let case = (&graph, &parameters, &batch);
        let of = |_: &[Matrix]| vec![weigh(name, &have, &rows, outputs)];
        let (forward, found) = forward_backward(&mut *executor, case, 0, of);
        let output = reordered(&forward.outputs[0], &have, &rows);
        assert_close(name, &output, fixture.floats(&format!("{name}.output")), TOLERANCE);
        let of_features = reordered(&found.inputs[0], &finest, &cells);
        let expected = |part: &str| fixture.floats(&format!("{name}.of.{part}"));
        assert_close(name, &of_features, expected("features"), TOLERANCE);
        for (spec, values) in graph.parameters().iter().zip(&found.parameters) {
            if let Some(part) = spec.name.strip_prefix(&format!("{name}.")) {
                assert_close(&spec.name, values, expected(part), TOLERANCE);
            }
        }
    }
}

#[test]
fn convolutions() {
    convolution("conv3", 5, 7, None, within(3, 1, 1));
    convolution("conv5", 3, 4, None, within(5, 1, 1));
    convolution("dilated", 3, 4, None, within(3, 2, 1));
    convolution("even", 3, 4, None, within(2, 1, 1));
    convolution("plain", 5, 70, None, within(1, 1, 1));
}

#[test]
fn strided_convolutions() {
    convolution("down2", 6, 5, None, KernelSpec::down(2, 1, 2));
    convolution("down3", 4, 5, None, KernelSpec::down(3, 1, 2));
}

#[test]
fn transposed_convolutions() {
    convolution("up2", 6, 5, Some(KernelSpec::down(2, 1, 2)), KernelSpec::up(2, 2, 2));
    convolution("up3", 4, 5, Some(KernelSpec::down(2, 1, 2)), KernelSpec::up(3, 2, 2));
}

#[test]
fn batch_norms() {
    let fixture = Fixture::read("operations");
    let cells = fixture.cells("cells");
    for name in ["norm", "running"] {
        let mut g = GraphBuilder::new();
        let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 5);
        let y = g.batch_norm(name, x);
        let graph = g.finish(&[y]).unwrap();
        let parameters = parameters(&graph, |name, _, values| {
            let change = |value| match name.rsplit_once('.').unwrap().1 {
                "weight" => 1.0 + 0.2 * value,
                "running_mean" => 0.1 * value,
                "running_var" => 1.0 + 0.3 * value,
                _ => value,
            };
            values.into_iter().map(change).collect()
        });
        let (batch, finest) = batch(&graph, &cells, name, 5);
        let expected = |part: &str| fixture.floats(&format!("{name}.{part}"));
        for mut executor in executors() {
            if name == "running" {
                let output = executor.infer(&graph, &parameters, &batch).unwrap();
                let output = reordered(&output[0], &finest, &cells);
                assert_close(name, &output, expected("output"), TOLERANCE);
                continue;
            }
            let case = (&graph, &parameters, &batch);
            let of = |_: &[Matrix]| vec![weigh(name, &finest, &cells, 5)];
            let (forward, found) = forward_backward(&mut *executor, case, 0, of);
            let output = reordered(&forward.outputs[0], &finest, &cells);
            assert_close(name, &output, expected("output"), TOLERANCE);
            assert_close("mean", &forward.running[0].1, expected("mean"), TOLERANCE);
            assert_close("variance", &forward.running[1].1, expected("variance"), TOLERANCE);
            let of_features = reordered(&found.inputs[0], &finest, &cells);
            assert_close("features", &of_features, expected("of.features"), TOLERANCE);
            assert_close("weight", &found.parameters[0], expected("of.weight"), TOLERANCE);
            assert_close("bias", &found.parameters[1], expected("of.bias"), TOLERANCE);
        }
    }
}

#[test]
fn pools_and_activations() {
    let fixture = Fixture::read("operations");
    let cells = fixture.cells("cells");
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 6);
    let mean = g.global_average_pool("mean", x).unwrap();
    let largest = g.global_max_pool("largest", x).unwrap();
    let pooled = g.concatenate("pooled", &[mean, largest]).unwrap();
    let (leaky, relu) = (g.leaky_relu(x, 0.1), g.relu(x));
    let sum = g.add("sum", leaky, relu).unwrap();
    let graph = g.finish(&[pooled, sum]).unwrap();
    let parameters = parameters(&graph, |_, _, values| values);
    let (batch, finest) = batch(&graph, &cells, "rest", 6);
    for mut executor in executors() {
        let case = (&graph, &parameters, &batch);
        let of = |_: &[Matrix]| {
            vec![hashed_matrix("rest.pooled.weigh", 2, 12), weigh("rest", &finest, &cells, 6)]
        };
        let (forward, found) = forward_backward(&mut *executor, case, 0, of);
        let pooled = forward.outputs[0].values();
        assert_close("pooled", pooled, fixture.floats("rest.pooled"), TOLERANCE);
        let sum = reordered(&forward.outputs[1], &finest, &cells);
        assert_close("sum", &sum, fixture.floats("rest.output"), TOLERANCE);
        let of_features = reordered(&found.inputs[0], &finest, &cells);
        assert_close("features", &of_features, fixture.floats("rest.of.features"), TOLERANCE);
    }
}

#[test]
fn slices_linear_layers_and_dropout() {
    let fixture = Fixture::read("operations");
    let (cells, points) = (fixture.cells("cells"), fixture.cells("points"));
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 6);
    let sliced = g.slice("slice", x).unwrap();
    let linear = g.linear("layer", sliced, 5, true);
    let dropped = g.dropout(linear, 0.3);
    let graph = g.finish(&[linear, dropped]).unwrap();
    let parameters = parameters(&graph, |_, _, values| values);
    let (batch, finest) = batch(&graph, &points, "points", 6);
    for mut executor in executors() {
        let case = (&graph, &parameters, &batch);
        let of = |_: &[Matrix]| {
            let of = |name| hashed_matrix(&format!("{name}.weigh"), points.len(), 5);
            ["linear", "dropout"].map(of).to_vec()
        };
        let (forward, found) = forward_backward(&mut *executor, case, 3, of);
        for (output, name) in forward.outputs.iter().zip(["linear", "dropout"]) {
            assert_close(name, output.values(), fixture.floats(name), TOLERANCE);
        }
        let of_features = reordered(&found.inputs[0], &finest, &cells);
        let expected = |part: &str| fixture.floats(&format!("heads.of.{part}"));
        assert_close("features", &of_features, expected("features"), TOLERANCE);
        assert_close("weight", &found.parameters[0], expected("weight"), TOLERANCE);
        assert_close("bias", &found.parameters[1], expected("bias"), TOLERANCE);
    }
}

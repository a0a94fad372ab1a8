//! A whole MinkUNet18D, forward and backward, against plain PyTorch in 64 bits, on every executor.

use crate::fixtures::{Fixture, assert_close, hashed, hashed_matrix, parameters, reordered};
use crate::runs::{executors, forward_backward};
use eyebolt_net::coordinates::VoxelSet;
use eyebolt_net::models::MinkUNet;
use eyebolt_net::{Batch, Gradients, Graph, Matrix};

/// As `parameter` in the script.
fn parameter(name: &str, shape: &[usize], values: Vec<f32>) -> Vec<f32> {
    let active = match shape[0] {
        125 => 30.0,
        27 => 5.0,
        8 => 2.0,
        _ => 1.0,
    };
    let change = |value: f32| match name.rsplit_once('.').unwrap().1 {
        "kernel" => value * (6.0 / (active * shape[1] as f32)).sqrt(),
        "weight" => 1.0 + 0.2 * value,
        "running_var" => 1.0 + 0.3 * value,
        _ => 0.1 * value,
    };
    values.into_iter().map(change).collect()
}

#[test]
fn forward_and_backward() {
    let fixture = Fixture::read("minkunet18d");
    let cells = fixture.cells("cells");
    let graph = MinkUNet::named("minkunet18d", 3, 3).unwrap().graph().unwrap();
    let parameters = parameters(&graph, parameter);
    let batch = Batch::from_voxels(&graph, &cells, &hashed_matrix("features", cells.len(), 3));
    let batch = batch.unwrap();
    let finest = VoxelSet::new(&cells).unwrap().0.coordinates();
    for mut executor in executors() {
        let inferred = executor.infer(&graph, &parameters, &batch).unwrap();
        assert_close("inferred", inferred[0].values(), fixture.floats("inferred"), 1e-5);
        let case = (&graph, &parameters, &batch);
        let of = |_: &[Matrix]| vec![hashed_matrix("weigh", cells.len(), 3)];
        let (forward, gradients) = forward_backward(&mut *executor, case, 0, of);
        assert_close("trained", forward.outputs[0].values(), fixture.floats("trained"), 1e-5);
        let of_features = reordered(&gradients.inputs[0], &finest, &cells);
        assert_close("features", &of_features, fixture.floats("of.features"), 1e-5);
        let compared = assert_parameters(&graph, &gradients, &fixture);
        // 49 convolutions, 48 batch norms of two each, one bias.
        assert_eq!(compared, 49 + 2 * 48 + 1);
    }
}

/// Length and projection of the gradient of every parameter; how many there are.
fn assert_parameters(graph: &Graph, gradients: &Gradients, fixture: &Fixture) -> usize {
    let mut compared = 0;
    for (spec, values) in graph.parameters().iter().zip(&gradients.parameters) {
        if !spec.role.is_trained() {
            continue;
        }
        let pattern = hashed(&format!("project.{}", spec.name), spec.len());
        let wide = |value: &f32| f64::from(*value);
        let length = values.iter().map(|value| wide(value).powi(2)).sum::<f64>().sqrt();
        let projection: f64 = values.iter().zip(&pattern).map(|(a, b)| wide(a) * wide(b)).sum();
        let found = [length as f32, projection as f32];
        let expected = fixture.floats(&format!("of.{}", spec.name));
        assert_close(&spec.name, &found, expected, 1e-5);
        compared += 1;
    }
    compared
}

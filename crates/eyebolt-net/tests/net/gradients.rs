//! Gradients in 64 bits against differences.

use crate::scenes::{every_operation, features, noise, parameters, sheet};
use eyebolt_net::reference::Reference;
use eyebolt_net::{Batch, Matrix};

type Values = Vec<Vec<f64>>;

fn wide(values: &[f32]) -> Vec<f64> {
    values.iter().map(|&value| value.into()).collect()
}

#[test]
fn gradients_are_what_differences_approach() {
    let graph = every_operation();
    let coordinates = sheet(7);
    let batch =
        Batch::from_voxels(&graph, &coordinates, &features(5, coordinates.len(), 3)).unwrap();
    let parameters: Values =
        parameters(&graph, 11).values().iter().map(|values| wide(values)).collect();
    let inputs: Vec<Matrix<f64>> = batch.inputs().iter().map(|m| m.map(f64::from)).collect();
    let mut reference = Reference::<f64>::new();
    // A loss that is linear in the outputs, with weights of its own.
    let mut loss = |parameters: &Values, inputs: &[Matrix<f64>]| {
        let forward = reference.forward_with(&graph, parameters, &batch, inputs, 3).unwrap();
        let weigh = |output: &Matrix<f64>| {
            let weights = wide(&noise(17, output.values().len()));
            output.values().iter().zip(weights).map(|(a, b)| a * b).sum::<f64>()
        };
        forward.outputs.iter().map(weigh).sum::<f64>()
    };
    loss(&parameters, &inputs);
    let of: Vec<Matrix<f64>> = [(coordinates.len(), 5), (2, 4)]
        .map(|(rows, channels)| {
            Matrix::new(rows, channels, wide(&noise(17, rows * channels))).unwrap()
        })
        .into();
    let mut again = Reference::<f64>::new();
    again.forward_with(&graph, &parameters, &batch, &inputs, 3).unwrap();
    let gradients = again.backward_with(&graph, &parameters, &batch, &of).unwrap();

    // Along one random direction for each parameter, and for the input.
    let step = 1e-6;
    for (place, values) in parameters.iter().enumerate() {
        let direction = wide(&noise(place as u64 + 1, values.len()));
        let mut at = |sign: f64| {
            let mut moved = parameters.clone();
            moved[place].iter_mut().zip(&direction).for_each(|(v, d)| *v += sign * step * d);
            loss(&moved, &inputs)
        };
        let slope = (at(1.0) - at(-1.0)) / (2.0 * step);
        let expected: f64 =
            gradients.parameters[place].iter().zip(&direction).map(|(g, d)| g * d).sum();
        let name = &graph.parameters()[place].name;
        assert!(
            (slope - expected).abs() < 1e-6 * (1.0 + slope.abs()),
            "{name}: {slope} {expected}"
        );
    }
    let direction = wide(&noise(99, inputs[0].values().len()));
    let mut at = |sign: f64| {
        let mut moved = inputs.clone();
        moved[0].values_mut().iter_mut().zip(&direction).for_each(|(v, d)| *v += sign * step * d);
        loss(&parameters, &moved)
    };
    let slope = (at(1.0) - at(-1.0)) / (2.0 * step);
    let expected: f64 =
        gradients.inputs[0].values().iter().zip(&direction).map(|(g, d)| g * d).sum();
    assert!((slope - expected).abs() < 1e-6 * (1.0 + slope.abs()), "input: {slope} {expected}");
}

//! Gradients in 64 bits against differences.

use crate::scenes::{every_operation, features, noise, parameters, sheet};
use eyebolt_net::reference::{Case, Reference};
use eyebolt_net::{Batch, Matrix};

type Values = Vec<Vec<f64>>;

fn wide(values: &[f32]) -> Vec<f64> {
    values.iter().map(|&value| value.into()).collect()
}

/// Of a loss that is linear in the outputs.
fn weights_of(output: &Matrix<f64>) -> Matrix<f64> {
    let weights = wide(&noise(17, output.values().len()));
    Matrix::new(output.rows(), output.channels(), weights).unwrap()
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
    let reference = Reference::<f64>::new();
    let run = |parameters: &Values, inputs: &[Matrix<f64>]| {
        let case = Case { graph: &graph, parameters, batch: &batch, inputs };
        let mut of = |outputs: &[Matrix<f64>]| Ok(outputs.iter().map(weights_of).collect());
        reference.forward_backward_with(case, 3, &mut of).unwrap()
    };
    let loss = |parameters: &Values, inputs: &[Matrix<f64>]| {
        let (forward, _) = run(parameters, inputs);
        let weigh = |output: &Matrix<f64>| {
            let weights = weights_of(output);
            output.values().iter().zip(weights.values()).map(|(a, b)| a * b).sum::<f64>()
        };
        forward.outputs.iter().map(weigh).sum::<f64>()
    };
    let (_, gradients) = run(&parameters, &inputs);

    // Along one random direction for each parameter, and for the input.
    let step = 1e-6;
    for (place, values) in parameters.iter().enumerate() {
        let direction = wide(&noise(place as u64 + 1, values.len()));
        let at = |sign: f64| {
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
    let at = |sign: f64| {
        let mut moved = inputs.clone();
        moved[0].values_mut().iter_mut().zip(&direction).for_each(|(v, d)| *v += sign * step * d);
        loss(&parameters, &moved)
    };
    let slope = (at(1.0) - at(-1.0)) / (2.0 * step);
    let expected: f64 =
        gradients.inputs[0].values().iter().zip(&direction).map(|(g, d)| g * d).sum();
    assert!((slope - expected).abs() < 1e-6 * (1.0 + slope.abs()), "input: {slope} {expected}");
}

//! State dicts of MinkowskiEngine.

use super::{Entry, Tensors};
use crate::graph::{Graph, ParameterSpec, Role};
use crate::{Error, Parameters};

const FILE: &str = "MinkowskiEngine state dict";

/// The parameters of a graph from a state dict as safetensors; how it differs from ours stands at
/// the head of [this module](super).
///
/// # Errors
/// As [`from_bytes`](super::from_bytes).
pub fn from_minkowski(graph: &Graph, bytes: &[u8]) -> Result<Parameters, Error> {
    let mut tensors = Tensors::read(FILE, bytes)?;
    tensors.skip(|name| name.ends_with(".num_batches_tracked"));
    let mut values = tensors.take_all(graph, "", entry)?;
    tensors.finish()?;
    for (spec, values) in graph.parameters().iter().zip(&mut values) {
        if let [volume, inputs, outputs] = spec.shape[..] {
            *values = z_fastest(values, volume, inputs * outputs);
        }
    }
    Parameters::new(graph, values)
}

fn entry(spec: &ParameterSpec) -> Entry {
    let norm = matches!(spec.role, Role::Scale | Role::Shift | Role::Mean | Role::Variance);
    let name = match spec.name.rsplit_once('.') {
        Some((layer, part)) if norm => format!("{layer}.bn.{part}"),
        _ => spec.name.clone(),
    };
    let mut shapes = vec![spec.shape.clone()];
    match spec.shape[..] {
        [1, inputs, outputs] => shapes.push(vec![inputs, outputs]),
        [channels] => shapes.push(vec![1, channels]),
        _ => {}
    }
    Entry { name, shapes }
}

/// Matrices by offset, from x fastest to z fastest.
fn z_fastest(values: &[f32], volume: usize, size: usize) -> Vec<f32> {
    let edge = (1..=volume).find(|edge| edge * edge * edge >= volume).unwrap_or(1);
    let mut turned = Vec::with_capacity(values.len());
    for x in 0..edge {
        for y in 0..edge {
            for z in 0..edge {
                let from = (z * edge + y) * edge + x;
                turned.extend_from_slice(&values[from * size..][..size]);
            }
        }
    }
    turned
}

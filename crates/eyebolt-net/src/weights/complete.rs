//! Files that hold every parameter of a graph.

use super::layout::{FILE, Layout};
use super::numbers;
use super::written::{entries, serialise, serialise_as};
use crate::{Error, Graph, Parameters};
use safetensors::Dtype;

/// The parameters as safetensors of 32 bits.
///
/// # Errors
/// If the graph is another one, or a value is not finite: what is written can be read.
pub fn to_bytes(graph: &Graph, parameters: &Parameters) -> Result<Vec<u8>, Error> {
    serialise(FILE, entries(FILE, graph, "", parameters.values())?, &[])
}

/// The parameters as safetensors of 16 bits (float16), for models that are handed on: half as large, and
/// as good but for the last of three decimals.
///
/// # Errors
/// As [`to_bytes`]; or if a value is beyond 65 504.
pub fn to_half_bytes(graph: &Graph, parameters: &Parameters) -> Result<Vec<u8>, Error> {
    if !graph.has_parameters(parameters.values()) {
        return Err(Error::input("parameters", "made for another network"));
    }
    let entry = |(spec, values): (&crate::graph::ParameterSpec, &Vec<f32>)| {
        let bytes = numbers::encode_half(values);
        let kept = numbers::decode(Dtype::F16, &bytes).unwrap_or_default();
        numbers::check_finite(FILE, &spec.name, &kept)?;
        Ok((spec.name.clone(), spec.shape.clone(), bytes))
    };
    let stored = graph.parameters().iter().zip(parameters.values()).map(entry);
    serialise_as(Dtype::F16, FILE, stored.collect::<Result<_, Error>>()?, &[])
}

/// The parameters of a graph from safetensors of 16 (float16 or bfloat16) or 32 bits.
///
/// # Errors
/// If the bytes are no safetensors, a parameter is missing, has another shape, another type or a
/// value that is not finite, or there is a tensor more.
pub fn from_bytes(graph: &Graph, bytes: &[u8]) -> Result<Parameters, Error> {
    complete(graph, bytes, Layout::Eyebolt)
}

/// The parameters of a graph from a state dict of MinkowskiEngine as safetensors; how it differs
/// from ours stands at the head of [this module](super).
///
/// # Errors
/// As [`from_bytes`].
pub fn from_minkowski(graph: &Graph, bytes: &[u8]) -> Result<Parameters, Error> {
    complete(graph, bytes, Layout::MinkowskiEngine)
}

fn complete(graph: &Graph, bytes: &[u8], layout: Layout) -> Result<Parameters, Error> {
    let mut tensors = layout.open(bytes)?;
    let values = tensors.take_all(graph, "", |spec| layout.entry(spec))?;
    tensors.finish()?;
    Parameters::new(graph, values)
}

//! Weights as safetensors: ours, and state dicts of MinkowskiEngine.
//!
//! Ours hold every parameter of the graph under its name, with its shape. Kernels are
//! `[offsets, inputs, outputs]`, offsets with z fastest.
//!
//! MinkowskiEngine's differ in three ways, which [`from_minkowski`] undoes: offsets have x fastest;
//! batch norms are called `bn0.bn.weight` where ours are `bn0.weight`, and count their batches;
//! kernels of one voxel are `[inputs, outputs]` and biases `[1, outputs]`. A published `.pth` file
//! becomes safetensors by `safetensors.torch.save_file(torch.load(path)["state_dict"], ...)`.

mod minkowski;
mod numbers;
mod tensors;

pub use minkowski::from_minkowski;
pub(crate) use tensors::{Entry, Tensors, entries, serialise};

use crate::{Error, Graph, Parameters};

const FILE: &str = "weights.safetensors";

/// The parameters as safetensors of 32 bits.
///
/// # Errors
/// If the graph is another one.
pub fn to_bytes(graph: &Graph, parameters: &Parameters) -> Result<Vec<u8>, Error> {
    serialise(FILE, entries(graph, "", parameters.values())?, &[])
}

/// The parameters of a graph from safetensors of 16 (float16 or bfloat16) or 32 bits.
///
/// # Errors
/// If the bytes are no safetensors, a parameter is missing, has another shape, another type or a
/// value that is not finite, or there is a tensor more.
pub fn from_bytes(graph: &Graph, bytes: &[u8]) -> Result<Parameters, Error> {
    let mut tensors = Tensors::read(FILE, bytes)?;
    let values = tensors.take_all(graph, "", Entry::plain)?;
    tensors.finish()?;
    Parameters::new(graph, values)
}

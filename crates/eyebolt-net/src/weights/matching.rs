//! The part of a file that fits a network.

use super::layout::Layout;
use super::tensors::Found;
use crate::{Error, Graph, Parameters};

/// A tensor that has the name of a parameter and another shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherShape {
    /// Name of the parameter.
    pub name: String,
    /// Shape in the file.
    pub in_file: Vec<usize>,
    /// Shape in the network.
    pub in_network: Vec<usize>,
}

/// What [`load_matching`] did, parameters in the graph's order.
#[must_use = "what was not loaded is as it was before"]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Matching {
    /// Parameters that have the file's values now.
    pub loaded: Vec<String>,
    /// Parameters that the file does not have.
    pub missing: Vec<String>,
    /// Parameters that the file has with another shape.
    pub other_shape: Vec<OtherShape>,
    /// Tensors of the file, by its names, that belong to no parameter.
    pub unexpected: Vec<String>,
}

/// Sets the parameters that a file has with the same name and shape, and leaves the others as they
/// are: to start from published weights with another head, or with the encoder alone. Which they
/// are is the caller's to look at; a file of another network loads nothing and is no error.
///
/// # Errors
/// If the bytes are no safetensors, or a tensor that fits has another type or a value that is not
/// finite, or the parameters are another graph's. Nothing is changed then.
pub fn load_matching(
    graph: &Graph,
    parameters: &mut Parameters,
    bytes: &[u8],
    layout: Layout,
) -> Result<Matching, Error> {
    let mut tensors = layout.open(bytes)?;
    let mut values = parameters.values().to_vec();
    let mut matching = Matching::default();
    for (spec, values) in graph.parameters().iter().zip(&mut values) {
        let name = spec.name.clone();
        match tensors.look_up(&layout.entry(spec))? {
            Found::Values(found) => {
                *values = found;
                matching.loaded.push(name);
            }
            Found::OtherShape(in_file) => {
                let in_network = spec.shape.clone();
                matching.other_shape.push(OtherShape { name, in_file, in_network });
            }
            Found::Missing => matching.missing.push(name),
        }
    }
    matching.unexpected = tensors.into_left();
    *parameters = Parameters::new(graph, values)?;
    Ok(matching)
}

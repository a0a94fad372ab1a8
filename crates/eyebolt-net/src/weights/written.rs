//! Tensors to the bytes of a safetensors file.

use super::numbers;
use crate::Error;
use crate::graph::{Graph, ParameterSpec};
use safetensors::Dtype;
use safetensors::tensor::TensorView;
use std::collections::HashMap;

/// Name, shape and bytes.
pub(crate) type Stored = (String, Vec<usize>, Vec<u8>);

/// Values by the graph's names with a prefix; all of them finite, so that what is written can be
/// read.
pub(crate) fn entries(
    file: &str,
    graph: &Graph,
    prefix: &str,
    values: &[Vec<f32>],
) -> Result<Vec<Stored>, Error> {
    if !graph.has_parameters(values) {
        return Err(Error::input("parameters", "made for another network"));
    }
    let entry = |(spec, values): (&ParameterSpec, &Vec<f32>)| {
        let name = format!("{prefix}{}", spec.name);
        numbers::check_finite(file, &name, values)?;
        Ok((name, spec.shape.clone(), numbers::encode(values)))
    };
    graph.parameters().iter().zip(values).map(entry).collect()
}

/// The bytes of a file. The same ones for the same tensors, in whatever order.
pub(crate) fn serialise(
    file: &str,
    entries: Vec<Stored>,
    metadata: &[(&str, String)],
) -> Result<Vec<u8>, Error> {
    serialise_as(Dtype::F32, file, entries, metadata)
}

/// As [`serialise`], of numbers of another type.
pub(crate) fn serialise_as(
    dtype: Dtype,
    file: &str,
    entries: Vec<Stored>,
    metadata: &[(&str, String)],
) -> Result<Vec<u8>, Error> {
    let failed = |error: safetensors::SafeTensorError| Error::file(file, "", error.to_string());
    let mut views = Vec::new();
    for (name, shape, bytes) in &entries {
        let view = TensorView::new(dtype, shape.clone(), bytes).map_err(failed)?;
        views.push((name.as_str(), view));
    }
    let metadata: HashMap<String, String> =
        metadata.iter().map(|(key, text)| ((*key).to_owned(), text.clone())).collect();
    let metadata = (!metadata.is_empty()).then_some(metadata);
    safetensors::serialize(views, metadata).map_err(failed)
}

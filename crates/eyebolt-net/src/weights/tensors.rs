//! Named tensors of a safetensors file, each to be taken once.

use super::numbers;
use crate::Error;
use crate::graph::{Graph, ParameterSpec};
use safetensors::tensor::TensorView;
use safetensors::{Dtype, SafeTensors};
use std::collections::{BTreeSet, HashMap};

/// How a parameter is stored.
pub(crate) struct Entry {
    /// Name in the file.
    pub name: String,
    /// Shapes that it may have.
    pub shapes: Vec<Vec<usize>>,
}

impl Entry {
    /// Under its own name with its own shape.
    pub fn plain(spec: &ParameterSpec) -> Self {
        Self { name: spec.name.clone(), shapes: vec![spec.shape.clone()] }
    }
}

/// What is left of a file.
pub(crate) struct Tensors<'a> {
    file: &'static str,
    tensors: SafeTensors<'a>,
    metadata: HashMap<String, String>,
    left: BTreeSet<String>,
}

impl<'a> Tensors<'a> {
    /// Checks the header: every tensor lies within the bytes, none over another.
    pub fn read(file: &'static str, bytes: &'a [u8]) -> Result<Self, Error> {
        let foreign = |error| Error::file(file, "header", format!("no safetensors: {error}"));
        let tensors = SafeTensors::deserialize(bytes).map_err(foreign)?;
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(foreign)?;
        let metadata = header.metadata().clone().unwrap_or_default();
        let left = tensors.names().into_iter().map(str::to_owned).collect();
        Ok(Self { file, tensors, metadata, left })
    }

    /// A text of the metadata.
    pub fn metadata(&self, key: &str) -> Result<String, Error> {
        let missing = || Error::file(self.file, key, "missing in the metadata");
        self.metadata.get(key).cloned().ok_or_else(missing)
    }

    /// Every parameter of a graph, by names with a prefix.
    pub fn take_all(
        &mut self,
        graph: &Graph,
        prefix: &str,
        entry: impl Fn(&ParameterSpec) -> Entry,
    ) -> Result<Vec<Vec<f32>>, Error> {
        let specs = graph.parameters().iter();
        specs
            .map(|spec| {
                let entry = entry(spec);
                self.take(&format!("{prefix}{}", entry.name), &entry.shapes)
            })
            .collect()
    }

    fn take(&mut self, name: &str, shapes: &[Vec<usize>]) -> Result<Vec<f32>, Error> {
        let problem = |problem: String| Error::file(self.file, name, problem);
        if !self.left.remove(name) {
            return Err(problem("missing, or asked for twice: weights of another network?".into()));
        }
        let view = self.tensors.tensor(name).map_err(|error| problem(error.to_string()))?;
        if !shapes.iter().any(|shape| shape == view.shape()) {
            let wanted = shapes.first();
            return Err(problem(format!("shape {:?}, not {wanted:?}", view.shape())));
        }
        let values = numbers::decode(view.dtype(), view.data()).ok_or_else(|| {
            problem(format!("type {:?}; only F32, F16 and BF16 are weights", view.dtype()))
        })?;
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(problem(format!("value {at} is {}", values[at])));
        }
        Ok(values)
    }

    /// Drops what has such a name.
    pub fn skip(&mut self, drop: impl Fn(&str) -> bool) {
        self.left.retain(|name| !drop(name));
    }

    /// That nothing is left.
    pub fn finish(self) -> Result<(), Error> {
        match self.left.first() {
            None => Ok(()),
            Some(name) => Err(Error::file(
                self.file,
                name,
                format!("not of this network ({} such tensors)", self.left.len()),
            )),
        }
    }
}

/// Name, shape and bytes.
pub(crate) type Stored = (String, Vec<usize>, Vec<u8>);

/// Values by the graph's names with a prefix.
pub(crate) fn entries(
    graph: &Graph,
    prefix: &str,
    values: &[Vec<f32>],
) -> Result<Vec<Stored>, Error> {
    let specs = graph.parameters();
    if !values.iter().map(Vec::len).eq(specs.iter().map(ParameterSpec::len)) {
        return Err(Error::input("parameters", "made for another network"));
    }
    let entry = |(spec, values): (&ParameterSpec, &Vec<f32>)| {
        (format!("{prefix}{}", spec.name), spec.shape.clone(), numbers::encode(values))
    };
    Ok(specs.iter().zip(values).map(entry).collect())
}

/// The bytes of a file. The same ones for the same tensors, in whatever order.
pub(crate) fn serialise(
    file: &str,
    entries: Vec<Stored>,
    metadata: &[(&str, String)],
) -> Result<Vec<u8>, Error> {
    let failed = |error: safetensors::SafeTensorError| Error::file(file, "", error.to_string());
    let mut views = Vec::new();
    for (name, shape, bytes) in &entries {
        let view = TensorView::new(Dtype::F32, shape.clone(), bytes).map_err(failed)?;
        views.push((name.as_str(), view));
    }
    let metadata: HashMap<String, String> =
        metadata.iter().map(|(key, text)| ((*key).to_owned(), text.clone())).collect();
    let metadata = (!metadata.is_empty()).then_some(metadata);
    safetensors::serialize(views, metadata).map_err(failed)
}

//! Named tensors of a safetensors file, each to be taken once.

use super::entry::{Entry, Form};
use super::{names, numbers};
use crate::Error;
use crate::graph::{Graph, ParameterSpec};
use safetensors::SafeTensors;
use std::collections::{BTreeSet, HashMap};

/// What is left of a file.
pub(crate) struct Tensors<'a> {
    file: &'static str,
    tensors: SafeTensors<'a>,
    metadata: HashMap<String, String>,
    left: BTreeSet<String>,
}

/// What a file has for a parameter.
pub(crate) enum Found {
    /// Its values, in the network's order.
    Values(Vec<f32>),
    /// A tensor of this shape, which the parameter may not have.
    OtherShape(Vec<usize>),
    /// Nothing.
    Missing,
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
        let entries: Vec<Entry> = specs.map(|spec| entry(spec).prefixed(prefix)).collect();
        let all = self.left.clone();
        entries.iter().map(|entry| self.take(entry, &entries, &all)).collect()
    }

    /// One of the entries that are asked for, of all names that there were at first.
    fn take(
        &mut self,
        entry: &Entry,
        entries: &[Entry],
        all: &BTreeSet<String>,
    ) -> Result<Vec<f32>, Error> {
        let name = entry.name_in(all).unwrap_or(&entry.forms[0].name);
        let problem = match self.look_up(entry)? {
            Found::Values(values) => return Ok(values),
            Found::OtherShape(shape) => {
                format!("shape {shape:?}; the network has {}", entry.shapes(name))
            }
            Found::Missing if all.contains(name) => "two parameters of the network share it".into(),
            Found::Missing => names::missing(entries, all),
        };
        Err(Error::file(self.file, name, problem))
    }

    /// What there is for a parameter, which is then no longer left.
    ///
    /// # Errors
    /// If it is of the right name and shape, but of another type or not finite.
    pub fn look_up(&mut self, entry: &Entry) -> Result<Found, Error> {
        let Some(name) = entry.name_in(&self.left) else {
            return Ok(Found::Missing);
        };
        self.left.remove(name);
        let problem = |problem: String| Error::file(self.file, name, problem);
        let view = self.tensors.tensor(name).map_err(|error| problem(error.to_string()))?;
        let fits = |form: &&Form| form.name == name && form.shape == view.shape();
        let Some(form) = entry.forms.iter().find(fits) else {
            return Ok(Found::OtherShape(view.shape().to_vec()));
        };
        let values = numbers::decode(view.dtype(), view.data()).ok_or_else(|| {
            problem(format!("type {:?}; only F32, F16 and BF16 are weights", view.dtype()))
        })?;
        numbers::check_finite(self.file, name, &values)?;
        Ok(Found::Values(form.in_our_order(values)))
    }

    /// Drops what has such a name.
    pub fn skip(&mut self, drop: impl Fn(&str) -> bool) {
        self.left.retain(|name| !drop(name));
    }

    /// Names that nobody asked for.
    pub fn into_left(self) -> Vec<String> {
        self.left.into_iter().collect()
    }

    /// That nothing is left.
    pub fn finish(self) -> Result<(), Error> {
        match names::unexpected(&self.left) {
            None => Ok(()),
            Some((name, problem)) => Err(Error::file(self.file, name, problem)),
        }
    }
}

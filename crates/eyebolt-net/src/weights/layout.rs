//! Whose names and orders a file has.

use super::entry::{Entry, Form, Order};
use super::tensors::Tensors;
use crate::Error;
use crate::graph::{ParameterSpec, Role};

/// What errors call a file of ours.
pub(super) const FILE: &str = "weights.safetensors";

/// Whose names, shapes and orders the tensors of a file have; the head of [this module](super)
/// says what they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// As [`to_bytes`](super::to_bytes) writes them.
    Eyebolt,
    /// A state dict of MinkowskiEngine.
    MinkowskiEngine,
}

impl Layout {
    /// The tensors of a file that are weights.
    pub(super) fn open(self, bytes: &[u8]) -> Result<Tensors<'_>, Error> {
        let mut tensors = Tensors::read(self.file(), bytes)?;
        if self == Self::MinkowskiEngine {
            tensors.skip(|name| name.ends_with(".num_batches_tracked"));
        }
        Ok(tensors)
    }

    /// How a parameter may be stored.
    pub(super) fn entry(self, spec: &ParameterSpec) -> Entry {
        match self {
            Self::Eyebolt => Entry::plain(spec),
            Self::MinkowskiEngine => minkowski(spec),
        }
    }

    /// What errors call the file.
    pub(super) fn file(self) -> &'static str {
        match self {
            Self::Eyebolt => FILE,
            Self::MinkowskiEngine => "MinkowskiEngine state dict",
        }
    }
}

fn minkowski(spec: &ParameterSpec) -> Entry {
    let (layer, part) = spec.name.rsplit_once('.').unwrap_or(("", &spec.name));
    let form = |name: &str, shape: &[usize], order| Form {
        name: name.to_owned(),
        shape: shape.to_vec(),
        order,
    };
    let (name, shape) = (&spec.name, &spec.shape[..]);
    // MinkowskiLinear wraps PyTorch's layer as MinkowskiBatchNorm wraps its batch norm.
    let (linear, norm) = (format!("{layer}.linear.{part}"), format!("{layer}.bn.{part}"));
    let forms = match (spec.role, shape) {
        (Role::Weight { .. }, &[1, inputs, outputs]) => {
            vec![form(name, shape, Order::Same), form(name, &[inputs, outputs], Order::Same)]
        }
        (Role::Weight { .. }, &[inputs, outputs]) => vec![
            form(&linear, &[outputs, inputs], Order::Transposed),
            form(name, &[outputs, inputs], Order::Transposed),
        ],
        (Role::Weight { .. }, _) => vec![form(name, shape, Order::XFastest)],
        (Role::Bias, &[channels]) => vec![
            form(name, shape, Order::Same),
            form(name, &[1, channels], Order::Same),
            form(&linear, shape, Order::Same),
        ],
        _ => vec![form(&norm, shape, Order::Same)],
    };
    Entry { forms }
}

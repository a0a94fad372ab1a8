//! Under which names, in which shapes and orders a parameter may be stored.

use crate::graph::ParameterSpec;
use std::collections::BTreeSet;

/// How values lie in a file, `shape` being that of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// As ours.
    Same,
    /// `[offsets, inputs, outputs]`, the offsets of a cube with x fastest; ours have z fastest.
    XFastest,
    /// `[outputs, inputs]`; ours are `[inputs, outputs]`.
    Transposed,
}

/// One way to store a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Form {
    /// Name in the file.
    pub name: String,
    /// Shape in the file.
    pub shape: Vec<usize>,
    /// Order in the file.
    pub order: Order,
}

impl Form {
    /// Values of this form as the network has them.
    pub fn in_our_order(&self, values: Vec<f32>) -> Vec<f32> {
        match (self.order, &self.shape[..]) {
            (Order::XFastest, &[volume, inputs, outputs]) => {
                z_fastest(&values, volume, inputs * outputs)
            }
            (Order::Transposed, &[outputs, inputs]) => {
                let column = |input| (0..outputs).map(move |output| output * inputs + input);
                (0..inputs).flat_map(column).map(|place| values[place]).collect()
            }
            _ => values,
        }
    }
}

/// All ways to store a parameter, the likeliest first; there is at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    /// The ways.
    pub forms: Vec<Form>,
}

impl Entry {
    /// Under its own name with its own shape.
    pub fn plain(spec: &ParameterSpec) -> Self {
        let (name, shape) = (spec.name.clone(), spec.shape.clone());
        Self { forms: vec![Form { name, shape, order: Order::Same }] }
    }

    /// The same with something before every name.
    pub fn prefixed(mut self, prefix: &str) -> Self {
        self.forms.iter_mut().for_each(|form| form.name.insert_str(0, prefix));
        self
    }

    /// The first of its names that is among these.
    pub fn name_in(&self, names: &BTreeSet<String>) -> Option<&str> {
        self.forms.iter().map(|form| form.name.as_str()).find(|name| names.contains(*name))
    }

    /// Its shapes under a name, for people.
    pub fn shapes(&self, name: &str) -> String {
        let forms = self.forms.iter().filter(|form| form.name == name);
        forms.map(|form| format!("{:?}", form.shape)).collect::<Vec<_>>().join(" or ")
    }
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

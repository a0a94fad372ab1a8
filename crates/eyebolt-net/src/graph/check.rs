//! What is wrong with a graph as a whole.

use super::network::Graph;
use super::op::Op;
use crate::Error;
use std::collections::BTreeSet;

/// Values that a network may learn: 8 GiB of them.
pub const MAX_PARAMETERS: usize = 1 << 31;

/// That a graph can be run, stored and trained.
pub(super) fn graph(graph: &Graph) -> Result<(), Error> {
    if graph.outputs.is_empty() {
        return Err(Error::network("outputs", "there are none"));
    }
    if graph.outputs.iter().any(|output| output.0 >= graph.nodes.len()) {
        return Err(Error::network("outputs", "an operation of another network"));
    }
    let mut names = BTreeSet::new();
    let mut total = 0_usize;
    for spec in &graph.parameters {
        if !names.insert(&spec.name) {
            return Err(Error::network(&spec.name, "the name of two parameters"));
        }
        let len = spec.shape.iter().try_fold(1_usize, |len, &size| len.checked_mul(size));
        let sum = len.and_then(|len| total.checked_add(len));
        total = sum.filter(|&sum| sum <= MAX_PARAMETERS).ok_or_else(|| {
            let problem = format!("{:?}: more than {MAX_PARAMETERS} values in all", spec.shape);
            Error::network(&spec.name, problem)
        })?;
    }
    graph.nodes.iter().try_for_each(|node| {
        let problem = match node.op {
            Op::Dropout { probability } if !(0.0..1.0).contains(&probability) => {
                format!("dropout {probability} is not from 0 up to but not including 1")
            }
            Op::Activation { slope } if !(0.0..1.0).contains(&slope) => {
                format!("slope {slope} is not from 0 up to but not including 1")
            }
            _ => return Ok(()),
        };
        Err(Error::network(&node.name, problem))
    })
}

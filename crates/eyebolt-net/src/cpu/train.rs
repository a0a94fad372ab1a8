//! The forward pass in training, which keeps what the reverse pass needs.

use super::buffers::Buffers;
use super::convolve::{Epilogue, Pairs, convolve};
use super::panels::Panels;
use super::{elementwise, norm, pool};
use crate::executor::Forward;
use crate::graph::{Graph, NodeId, Op};
use crate::simd::Isa;
use crate::{Batch, Error, Matrix, Parameters};

/// Mean and inverse deviation of a batch norm's channels.
pub struct Moments {
    pub mean: Vec<f32>,
    pub inverse: Vec<f32>,
}

/// Values of a forward pass.
pub struct Kept {
    pub values: Vec<Vec<f32>>,
    pub moments: Vec<Option<Moments>>,
    /// Whose value a node's is: an activation works in place where nothing else needs its input.
    pub holder: Vec<usize>,
    pub seed: u64,
}

impl std::fmt::Debug for Kept {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} values", self.values.len())
    }
}

impl Kept {
    /// The value of a node.
    pub fn value(&self, node: NodeId) -> &[f32] {
        &self.values[self.holder[node.0]]
    }

    /// Whether it is of this graph and batch.
    pub fn fits(&self, graph: &Graph, batch: &Batch) -> bool {
        let fits = |(index, holder): (usize, &usize)| {
            let node = graph.nodes().get(index);
            let len = node.map(|node| batch.rows[node.domain] * node.channels);
            len == self.values.get(*holder).map(Vec::len)
        };
        self.holder.len() == graph.nodes().len() && self.holder.iter().enumerate().all(fits)
    }

    /// All memory.
    pub fn give_back(self, buffers: &mut Buffers) {
        self.values.into_iter().for_each(|value| buffers.give(value));
    }
}

/// Whose value each node's is.
fn holders(graph: &Graph) -> Vec<usize> {
    let uses = graph.uses();
    let mut holders: Vec<usize> = (0..graph.nodes().len()).collect();
    for (index, node) in graph.nodes().iter().enumerate() {
        let Op::Activation { .. } = node.op else { continue };
        let input = node.inputs[0].0;
        let before = &graph.nodes()[input].op;
        // Inputs belong to the batch, and a second activation would need what the first gave.
        if uses[input] == 1 && !matches!(before, Op::Input(_) | Op::Activation { .. }) {
            holders[index] = input;
        }
    }
    holders
}

pub fn forward(
    isa: Isa,
    buffers: &mut Buffers,
    graph: &Graph,
    parameters: &Parameters,
    batch: &Batch,
    seed: u64,
) -> Result<(Forward, Kept), Error> {
    let count = graph.nodes().len();
    let moments = (0..count).map(|_| None).collect();
    let mut kept = Kept { values: Vec::new(), moments, holder: holders(graph), seed };
    let mut running = Vec::new();
    let mut inputs = batch.inputs.iter();
    for (index, node) in graph.nodes().iter().enumerate() {
        let (rows, channels) = (batch.rows[node.domain], node.channels);
        if let Op::Activation { slope } = node.op
            && kept.holder[index] != index
        {
            elementwise::activate(&mut kept.values[kept.holder[index]], slope);
            kept.values.push(Vec::new());
            continue;
        }
        let mut out = buffers.take(rows * channels);
        let value = |place: usize| kept.value(node.inputs[place]);
        match &node.op {
            Op::Input(_) => {
                let input = inputs.next().expect("the batch was checked");
                out.copy_from_slice(input.values());
            }
            Op::Convolution { map, weight, bias } => {
                let pairs = match map {
                    Some(map) => Pairs::Map(batch.kernel(*map)?),
                    None => Pairs::Same(rows),
                };
                let depth = graph.nodes()[node.inputs[0].0].channels;
                let mut packed = buffers.take(Panels::len(pairs.volume(), depth, channels));
                let panels = Panels::pack(&mut packed, parameters.get(*weight), depth, channels);
                let shift = bias.map(|bias| parameters.get(bias));
                let epilogue = Epilogue { shift, ..Epilogue::default() };
                convolve(isa, pairs, value(0), &panels, epilogue, &mut out);
                buffers.give(packed);
            }
            Op::BatchNorm(op) => {
                let (mean, variance) = norm::moments(value(0), channels);
                let get = |id| parameters.get(id);
                let inverse: Vec<f32> = variance
                    .iter()
                    .map(|&value| (1.0 / (value + f64::from(op.epsilon)).sqrt()) as f32)
                    .collect();
                let scale: Vec<f32> =
                    get(op.scale).iter().zip(&inverse).map(|(a, b)| a * b).collect();
                let shift: Vec<f32> = (0..channels)
                    .map(|c| (f64::from(get(op.shift)[c]) - mean[c] * f64::from(scale[c])) as f32)
                    .collect();
                elementwise::scale_shift(value(0), &scale, &shift, None, &mut out);
                // The running variance is the unbiased one, except of a single row.
                let unbiased = if rows > 1 { rows as f64 / (rows as f64 - 1.0) } else { 1.0 };
                let share = f64::from(op.momentum);
                let blend = |old: &[f32], new: &[f64], correction: f64| {
                    let pairs = old.iter().zip(new);
                    let blend = |(&old, &new): (&f32, &f64)| {
                        (f64::from(old) * (1.0 - share) + new * correction * share) as f32
                    };
                    pairs.map(blend).collect::<Vec<f32>>()
                };
                running.push((op.mean, blend(get(op.mean), &mean, 1.0)));
                running.push((op.variance, blend(get(op.variance), &variance, unbiased)));
                let mean = mean.into_iter().map(|value| value as f32).collect();
                kept.moments[index] = Some(Moments { mean, inverse });
            }
            Op::Activation { slope } => {
                out.copy_from_slice(value(0));
                elementwise::activate(&mut out, *slope);
            }
            Op::Add => elementwise::add(value(0), value(1), &mut out),
            Op::Concatenate => {
                let parts: Vec<(&[f32], usize)> = node
                    .inputs
                    .iter()
                    .map(|&part| (kept.value(part), graph.nodes()[part.0].channels))
                    .collect();
                elementwise::concatenate(&parts, &mut out);
            }
            Op::Dropout { probability } => {
                out.copy_from_slice(value(0));
                elementwise::dropout(&mut out, seed, index, *probability);
            }
            Op::Combine { map } => {
                pool::combine(batch.row_map(*map)?, value(0), channels, &mut out)
            }
            Op::MaxPool { map } => pool::max_pool(batch.runs(*map)?, value(0), channels, &mut out),
        }
        kept.values.push(out);
    }
    let outputs = graph.outputs().iter().map(|&output| {
        let node = &graph.nodes()[output.0];
        Matrix::new(batch.rows[node.domain], node.channels, kept.value(output).to_vec())
    });
    Ok((Forward { outputs: outputs.collect::<Result<_, _>>()?, running }, kept))
}

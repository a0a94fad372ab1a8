//! Inference: steps of the plan, each value kept as long as something needs it.

use super::buffers::Buffers;
use super::convolve::{Epilogue, Pairs, convolve};
use super::panels::Panels;
use super::plan::{Step, plan};
use super::{elementwise, pool};
use crate::graph::{BatchNorm, Graph, Op};
use crate::simd::Isa;
use crate::{Batch, Error, Matrix, Parameters};

pub fn infer(
    isa: Isa,
    buffers: &mut Buffers,
    graph: &Graph,
    parameters: &Parameters,
    batch: &Batch,
) -> Result<Vec<Matrix>, Error> {
    let steps = plan(graph);
    let mut needed = vec![0; graph.nodes().len()];
    let needs = steps.iter().flat_map(|step| step.needs(graph));
    needs.chain(graph.outputs().iter().copied()).for_each(|node| needed[node.0] += 1);
    let mut values: Vec<Option<Vec<f32>>> = vec![None; graph.nodes().len()];
    let mut inputs = batch.inputs.iter();
    for step in &steps {
        if let Op::Input(_) = graph.nodes()[step.head.0].op {
            let input = inputs.next().expect("the batch was checked");
            let mut value = buffers.take(input.values().len());
            value.copy_from_slice(input.values());
            values[step.head.0] = Some(value);
            continue;
        }
        let value = run(isa, buffers, graph, parameters, batch, step, &values)?;
        for node in step.needs(graph) {
            needed[node.0] -= 1;
            if needed[node.0] == 0 {
                values[node.0].take().into_iter().for_each(|value| buffers.give(value));
            }
        }
        values[step.last.0] = Some(value);
    }
    let outputs = graph.outputs().iter();
    let outputs = outputs.map(|output| take_output(graph, batch, output.0, &values)).collect();
    values.into_iter().flatten().for_each(|value| buffers.give(value));
    outputs
}

fn take_output(
    graph: &Graph,
    batch: &Batch,
    output: usize,
    values: &[Option<Vec<f32>>],
) -> Result<Matrix, Error> {
    let node = &graph.nodes()[output];
    let value = values[output].clone().expect("outputs are needed to the end");
    Matrix::new(batch.rows[node.domain], node.channels, value)
}

fn run(
    isa: Isa,
    buffers: &mut Buffers,
    graph: &Graph,
    parameters: &Parameters,
    batch: &Batch,
    step: &Step,
    values: &[Option<Vec<f32>>],
) -> Result<Vec<f32>, Error> {
    let node = &graph.nodes()[step.head.0];
    let (rows, channels) = (batch.rows[node.domain], node.channels);
    let value = |node: usize| values[node].as_deref().expect("steps come after what they need");
    let first = &graph.nodes()[node.inputs[0].0];
    let input = value(node.inputs[0].0);
    let mut out = buffers.take(rows * channels);
    match &node.op {
        Op::Convolution { map, weight, bias } => {
            let pairs = match map {
                Some(map) => Pairs::Map(batch.kernel(*map)?),
                None => Pairs::Same(rows),
            };
            let bias = bias.map(|bias| parameters.get(bias));
            let folded = step.norm.map(|norm| fold(&norm, parameters, bias));
            let epilogue = Epilogue {
                scale: folded.as_ref().map(|(scale, _)| scale.as_slice()),
                shift: folded.as_ref().map(|(_, shift)| shift.as_slice()).or(bias),
                residual: step.residual.map(|node| value(node.0)),
                slope: step.slope,
            };
            let depth = first.channels;
            let mut packed = buffers.take(Panels::len(pairs.volume(), depth, channels));
            let panels = Panels::pack(&mut packed, parameters.get(*weight), depth, channels);
            convolve(isa, pairs, input, &panels, epilogue, &mut out);
            buffers.give(packed);
        }
        Op::BatchNorm(norm) => {
            let (scale, shift) = fold(norm, parameters, None);
            elementwise::scale_shift(input, &scale, &shift, None, &mut out);
        }
        Op::Activation { slope } => {
            out.copy_from_slice(input);
            elementwise::activate(&mut out, *slope);
        }
        Op::Add => elementwise::add(input, value(node.inputs[1].0), &mut out),
        Op::Concatenate => {
            let parts: Vec<(&[f32], usize)> = node
                .inputs
                .iter()
                .map(|part| (value(part.0), graph.nodes()[part.0].channels))
                .collect();
            elementwise::concatenate(&parts, &mut out);
        }
        Op::Dropout { .. } => out.copy_from_slice(input),
        Op::Combine { map } => pool::combine(batch.row_map(*map)?, input, channels, &mut out),
        Op::MaxPool { map } => pool::max_pool(batch.runs(*map)?, input, channels, &mut out),
        Op::Input(_) => {}
    }
    Ok(out)
}

/// A batch norm with running statistics, behind a bias, as one scale and shift.
pub fn fold(
    norm: &BatchNorm,
    parameters: &Parameters,
    bias: Option<&[f32]>,
) -> (Vec<f32>, Vec<f32>) {
    let get = |id| parameters.get(id);
    let (mean, variance) = (get(norm.mean), get(norm.variance));
    let scale: Vec<f32> = get(norm.scale)
        .iter()
        .zip(variance)
        .map(|(&scale, &variance)| scale / (variance + norm.epsilon).sqrt())
        .collect();
    let shift = get(norm.shift)
        .iter()
        .enumerate()
        .map(|(c, &shift)| shift + (bias.map_or(0.0, |bias| bias[c]) - mean[c]) * scale[c])
        .collect();
    (scale, shift)
}

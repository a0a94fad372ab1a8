//! Inference: steps of the plan, each value kept as long as something needs it.

use super::buffers::Buffers;
use super::convolve::Epilogue;
use super::elementwise;
use super::plan::{Step, plan};
use super::task::Task;
use crate::graph::{BatchNorm, NodeId, Op};
use crate::{Error, Matrix, Parameters};

pub fn infer(task: &Task<'_>, buffers: &mut Buffers) -> Result<Vec<Matrix>, Error> {
    let graph = task.graph;
    let steps = plan(graph);
    let mut needed = vec![0; graph.nodes().len()];
    let needs = steps.iter().flat_map(|step| step.needs(graph));
    needs.chain(graph.outputs().iter().copied()).for_each(|node| needed[node.0] += 1);
    let mut values: Vec<Option<Vec<f32>>> = vec![None; graph.nodes().len()];
    let mut inputs = task.batch.inputs().iter();
    for step in &steps {
        if let Op::Input(_) = task.node(step.head).op {
            let input = inputs.next().expect("the batch was checked");
            let mut value = buffers.take(input.values().len())?;
            value.copy_from_slice(input.values());
            values[step.head.0] = Some(value);
            continue;
        }
        let value = run(task, buffers, step, &values)?;
        for node in step.needs(graph) {
            needed[node.0] -= 1;
            if needed[node.0] == 0 {
                values[node.0].take().into_iter().for_each(|value| buffers.give(value));
            }
        }
        values[step.last.0] = Some(value);
    }
    let output = |&output: &NodeId| {
        let value = values[output.0].clone().expect("outputs are needed to the end");
        task.matrix(output, value)
    };
    let outputs = graph.outputs().iter().map(output).collect();
    values.into_iter().flatten().for_each(|value| buffers.give(value));
    outputs
}

fn run(
    task: &Task<'_>,
    buffers: &mut Buffers,
    step: &Step,
    values: &[Option<Vec<f32>>],
) -> Result<Vec<f32>, Error> {
    let node = task.node(step.head);
    let value = |node: NodeId| values[node.0].as_deref().expect("steps come after what they need");
    let input = value(node.inputs[0]);
    let mut out = buffers.take(task.rows(node) * node.channels)?;
    match &node.op {
        Op::Convolution { bias, .. } => {
            let bias = bias.map(|bias| task.parameters.get(bias));
            let folded = step.norm.map(|norm| fold(&norm, task.parameters, bias));
            let epilogue = Epilogue {
                scale: folded.as_ref().map(|(scale, _)| scale.as_slice()),
                shift: folded.as_ref().map(|(_, shift)| shift.as_slice()).or(bias),
                residual: step.residual.map(value),
                slope: step.slope,
            };
            task.convolve(buffers, node, input, epilogue, &mut out)?;
        }
        Op::BatchNorm(norm) => {
            let (scale, shift) = fold(norm, task.parameters, None);
            elementwise::scale_shift(input, &scale, &shift, &mut out);
        }
        Op::Dropout { .. } => out.copy_from_slice(input),
        _ => task.plain(node, value, &mut out)?,
    }
    Ok(out)
}

/// A batch norm with running statistics, behind a bias, as one scale and shift.
fn fold(norm: &BatchNorm, parameters: &Parameters, bias: Option<&[f32]>) -> (Vec<f32>, Vec<f32>) {
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

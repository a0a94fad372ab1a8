//! An executor as another crate would write one, of nothing but what is public: gather, multiply,
//! scatter, as on a GPU. What it keeps of batches it finds again by their number.

use crate::fixtures::assert_close;
use crate::scenes::{every_operation, features, parameters, sheet};
use eyebolt_net::executor::{OutputGradients, check, check_outputs};
use eyebolt_net::graph::{Node, NodeId, Op};
use eyebolt_net::models::PointNet2;
use eyebolt_net::reference::Reference;
use eyebolt_net::{
    Batch, Error, Executor, Forward, Gradients, Graph, Map, Matrix, Parameters, PassOptions,
    Sampling,
};
use std::collections::HashMap;

/// Input and output rows of every pair, offset after offset.
type Pairs = Vec<Vec<(usize, usize)>>;

#[derive(Default)]
struct Outside {
    /// Pairs of each kernel map, by batch and place.
    pairs: HashMap<(u64, usize), Pairs>,
    copies: usize,
}

struct Run<'a> {
    graph: &'a Graph,
    parameters: &'a Parameters,
    batch: &'a Batch,
    values: Vec<Matrix>,
}

impl Outside {
    fn pairs(&mut self, batch: &Batch, place: usize) -> &Pairs {
        self.pairs.entry((batch.id(), place)).or_insert_with(|| {
            self.copies += 1;
            let Map::Kernel(map) = &batch.maps()[place] else { panic!("a convolution's map") };
            (0..map.volume()).map(|offset| map.pairs_at(offset).collect()).collect()
        })
    }

    fn convolve(&mut self, run: &Run<'_>, node: &Node, out: &mut Matrix) {
        let Op::Convolution { map, weight, bias } = node.op else { return };
        let (input, width) = (run.value(node.inputs[0]), node.channels);
        let weights = run.parameters.get(weight);
        let same = vec![(0..out.rows()).map(|row| (row, row)).collect()];
        let pairs = map.map_or(&same, |map| self.pairs(run.batch, map.index()));
        for (offset, pairs) in pairs.iter().enumerate() {
            let matrix = &weights[offset * input.channels() * width..];
            for &(from, to) in pairs {
                let row = &mut out.values_mut()[to * width..][..width];
                for (&x, weights) in input.row(from).iter().zip(matrix.chunks(width)) {
                    row.iter_mut().zip(weights).for_each(|(sum, w)| *sum += x * w);
                }
            }
        }
        if let Some(bias) = bias {
            let bias = run.parameters.get(bias);
            out.values_mut().iter_mut().enumerate().for_each(|(at, y)| *y += bias[at % width]);
        }
    }
}

impl Run<'_> {
    fn value(&self, id: NodeId) -> &Matrix {
        &self.values[id.index()]
    }

    /// All but convolutions.
    fn operate(&self, node: &Node, out: &mut Matrix) {
        let (width, get) = (node.channels, |id| self.parameters.get(id));
        let input = |place: usize| self.value(node.inputs[place]);
        let value = |row: usize, c: usize| -> f32 {
            match node.op {
                Op::BatchNorm(norm) => {
                    let deviation = (get(norm.variance)[c] + norm.epsilon).sqrt();
                    let normal = (input(0).row(row)[c] - get(norm.mean)[c]) / deviation;
                    normal * get(norm.scale)[c] + get(norm.shift)[c]
                }
                Op::Activation { slope } => {
                    let x = input(0).row(row)[c];
                    if x > 0.0 { x } else { slope * x }
                }
                Op::Add => input(0).row(row)[c] + input(1).row(row)[c],
                Op::Concatenate => {
                    let mut left = c;
                    let part = node.inputs.iter().map(|&part| self.value(part)).find(|part| {
                        let here = left < part.channels();
                        left -= if here { 0 } else { part.channels() };
                        here
                    });
                    part.unwrap().row(row)[left]
                }
                Op::Combine { map } => match &self.batch.maps()[map.index()] {
                    Map::Rows(map) => {
                        map.entries(row).map(|(from, weight)| weight * input(0).row(from)[c]).sum()
                    }
                    _ => panic!("rows and weights"),
                },
                Op::MaxPool { map } => match &self.batch.maps()[map.index()] {
                    Map::Runs(runs) => {
                        let values = runs.get(row).map(|from| input(0).row(from)[c]);
                        values.fold(f32::NEG_INFINITY, f32::max)
                    }
                    _ => panic!("runs"),
                },
                Op::Dropout { .. } => input(0).row(row)[c],
                Op::Input(_) | Op::Convolution { .. } => unreachable!(),
            }
        };
        let places = out.values_mut().iter_mut().enumerate();
        places.for_each(|(at, out)| *out = value(at / width, at % width));
    }
}

impl Executor for Outside {
    fn device(&self) -> String {
        "outside".into()
    }

    fn infer(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
    ) -> Result<Vec<Matrix>, Error> {
        check(graph, parameters, batch)?;
        let mut run = Run { graph, parameters, batch, values: Vec::new() };
        let mut inputs = batch.inputs().iter();
        for node in run.graph.nodes() {
            let mut out = Matrix::zeros(batch.rows()[node.domain], node.channels);
            match node.op {
                Op::Input(_) => out = inputs.next().unwrap().clone(),
                Op::Convolution { .. } => self.convolve(&run, node, &mut out),
                _ => run.operate(node, &mut out),
            }
            run.values.push(out);
        }
        let outputs: Vec<Matrix> =
            graph.outputs().iter().map(|&output| run.value(output).clone()).collect();
        check_outputs(&outputs)?;
        Ok(outputs)
    }

    fn forward_backward(
        &mut self,
        _: &Graph,
        _: &Parameters,
        _: &Batch,
        _: PassOptions,
        _: OutputGradients<'_>,
    ) -> Result<(Forward, Gradients), Error> {
        Err(Error::Network { place: "outside".into(), problem: "only infers".into() })
    }
}

fn assert_as_the_reference(graph: &Graph, batch: &Batch) {
    let parameters = parameters(graph, 11);
    let mut outside = Outside::default();
    let found = outside.infer(graph, &parameters, batch).unwrap();
    let expected = Reference::<f64>::new().infer(graph, &parameters, batch).unwrap();
    for (found, expected) in found.iter().zip(&expected) {
        assert_close("output", found.values(), expected.values(), 1e-5);
    }
    let copies = outside.copies;
    outside.infer(graph, &parameters, batch).unwrap();
    assert_eq!(outside.copies, copies, "maps are copied once for a batch");
}

#[test]
fn an_executor_needs_only_what_is_public() {
    let graph = every_operation();
    let cells = sheet(24);
    let batch = Batch::from_voxels(&graph, &cells, &features(5, cells.len(), 3)).unwrap();
    assert_as_the_reference(&graph, &batch);
    let graph = PointNet2::single_scale(3, 2).graph().unwrap();
    let cloud = features(3, 300, 3);
    let points = cloud.values().as_chunks::<3>().0;
    let batch = Batch::from_points(&graph, points, &[200, 100], &cloud, Sampling::Farthest);
    assert_as_the_reference(&graph, &batch.unwrap());
}

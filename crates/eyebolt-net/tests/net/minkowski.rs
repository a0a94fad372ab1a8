//! Whole networks and single operations against MinkowskiEngine itself, from its own state dicts.

use crate::fixtures::{Fixture, assert_close, reordered};
use crate::runs::{executors, forward_backward};
use eyebolt_net::coordinates::{Kernel, KernelSpec, Neighbours, VoxelSet};
use eyebolt_net::graph::{Domain, GraphBuilder, MapSpec, NodeId, Source};
use eyebolt_net::models::{Block, Head, MinkUNet};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters, weights};

const TOLERANCE: f32 = 1e-5;

fn state_dict(graph: &Graph, name: &str) -> Parameters {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/minkowski/");
    let bytes = std::fs::read(format!("{folder}{name}.safetensors")).unwrap();
    weights::from_minkowski(graph, &bytes).unwrap()
}

fn values() -> (Fixture, Vec<[i32; 4]>, Matrix) {
    let fixture = Fixture::read("minkowski/values");
    let cells = fixture.cells("cells");
    let features = Matrix::new(cells.len(), 3, fixture.floats("features").to_vec()).unwrap();
    (fixture, cells, features)
}

/// Eval and training, gradients and running statistics: in 64 bits as exactly as the files are; in
/// 32 bits with gradients that went through batch norms of few rows, which lose two digits.
fn network(name: &str, net: &MinkUNet) {
    for mut executor in executors() {
        let is_wide = executor.device() == "reference, f64";
        let tolerances = if is_wide { [1e-6; 2] } else { [TOLERANCE, 1e-4] };
        compare(name, net, &mut *executor, tolerances);
    }
}

fn compare(name: &str, net: &MinkUNet, executor: &mut dyn Executor, tolerances: [f32; 2]) {
    let [outputs, gradients] = tolerances;
    let (fixture, cells, features) = values();
    let graph = net.graph().unwrap();
    let parameters = state_dict(&graph, name);
    let batch = Batch::from_voxels(&graph, &cells, &features).unwrap();
    let inferred = executor.infer(&graph, &parameters, &batch).unwrap();
    let expected = |mode: &str| fixture.floats(&format!("{name}.{mode}"));
    assert_close(name, inferred[0].values(), expected("inferred"), outputs);

    let weigh = Matrix::new(cells.len(), 4, fixture.floats("weigh").to_vec()).unwrap();
    let of = |_: &[Matrix]| vec![weigh.clone()];
    let (forward, found) = forward_backward(executor, (&graph, &parameters, &batch), 0, of);
    assert_close(name, forward.outputs[0].values(), expected("trained"), outputs);
    let trained = state_dict(&graph, &format!("{name}_trained"));
    for (place, spec) in graph.parameters().iter().enumerate() {
        if spec.role.is_trained() {
            let expected = &trained.values()[place];
            assert_close(&spec.name, &found.parameters[place], expected, gradients);
        }
    }
    assert!(!forward.running.is_empty());
    for (id, values) in &forward.running {
        let name = &graph.parameters()[id.index()].name;
        assert_close(name, values, trained.get(*id), outputs);
    }
}

#[test]
fn a_network_of_basic_blocks() {
    network(
        "basic",
        &MinkUNet {
            block: Block::Basic,
            layers: [1, 2, 1, 1, 1, 1, 1, 1],
            channels: [3, 2, 3, 2, 3, 2, 3, 2],
            stem_channels: 3,
            stem_kernel: 5,
            flat: false,
            inputs: 3,
            outputs: 4,
            head: Head::Convolution,
        },
    );
}

#[test]
fn a_network_of_bottlenecks() {
    network(
        "bottleneck",
        &MinkUNet {
            block: Block::Bottleneck,
            layers: [1, 1, 1, 1, 1, 1, 1, 2],
            channels: [2, 2, 2, 2, 2, 2, 2, 3],
            stem_channels: 3,
            stem_kernel: 3,
            flat: false,
            inputs: 3,
            outputs: 4,
            head: Head::Convolution,
        },
    );
}

/// Name, kernel, dilation, stride before and after, channels, bias.
type Operation = (&'static str, u32, u32, u32, u32, usize, bool);

const FROM_FINEST: [Operation; 7] = [
    ("odd", 3, 1, 1, 1, 4, true),
    ("wide", 5, 1, 1, 1, 2, false),
    ("even", 2, 1, 1, 1, 4, false),
    ("dilated", 3, 2, 1, 1, 4, false),
    ("down3", 3, 1, 1, 2, 4, false),
    ("down2", 2, 1, 1, 2, 3, false),
    ("down4", 3, 1, 1, 4, 2, false),
];
const FROM_DOWN2: [Operation; 2] = [("up3", 3, 1, 2, 1, 4, false), ("up2", 2, 1, 2, 1, 5, true)];

#[test]
fn single_operations() {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 3);
    let mut outputs: Vec<Output> = Vec::new();
    let mut add = |g: &mut GraphBuilder, x, (name, size, dilation, from, to, channels, bias)| {
        let spec = KernelSpec { kernel: Kernel { size, dilation, flat: false }, from, to };
        let node = g.convolution(name, x, spec, channels, bias).unwrap();
        outputs.push((name, Some(to), node));
        node
    };
    let nodes = FROM_FINEST.map(|operation| add(&mut g, x, operation));
    let _ = FROM_DOWN2.map(|operation| add(&mut g, nodes[5], operation));
    let domain = Domain::Voxels { stride: 1 };
    outputs.extend([
        ("square", Some(1), g.linear("square", x, 3, true)),
        ("linear", Some(1), g.linear("linear", x, 5, false)),
        ("mean", None, g.combine("mean", x, MapSpec::Means(domain)).unwrap()),
        ("largest", None, g.max_pool("largest", x, MapSpec::Maxima(domain)).unwrap()),
    ]);
    compare_operations(g, outputs);
}

/// Name, stride of the voxels that it is on if it is on any, node.
type Output = (&'static str, Option<u32>, NodeId);

fn compare_operations(g: GraphBuilder, outputs: Vec<Output>) {
    let (fixture, cells, features) = values();
    let ids: Vec<NodeId> = outputs.iter().map(|&(.., node)| node).collect();
    let graph = g.finish(&ids).unwrap();
    let batch = Batch::from_voxels(&graph, &cells, &features).unwrap();
    let found = Cpu::new().infer(&graph, &state_dict(&graph, "operations"), &batch).unwrap();
    let mut neighbours = Neighbours::new(VoxelSet::new(&cells).unwrap().0);
    for ((name, stride, _), found) in outputs.into_iter().zip(found) {
        // Rows of the finest voxels are stored once, as cells.
        let (have, rows) = match stride {
            None => (vec![[0; 4], [1, 0, 0, 0]], format!("{name}.rows")),
            Some(1) => (neighbours.voxels(1).unwrap().coordinates(), "cells".into()),
            Some(stride) => {
                (neighbours.voxels(stride).unwrap().coordinates(), format!("{name}.rows"))
            }
        };
        let rows = fixture.cells(&rows);
        assert_eq!(rows.len(), have.len(), "{name}");
        let found = reordered(&found, &have, &rows);
        assert_close(name, &found, fixture.floats(&format!("{name}.output")), TOLERANCE);
    }
}

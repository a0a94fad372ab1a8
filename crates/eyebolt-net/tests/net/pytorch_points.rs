//! Sampling, neighbours, interpolation and small PointNet++ networks against plain PyTorch.

use crate::fixtures::{Fixture, assert_close, assert_within, hashed, hashed_matrix};
use crate::runs::{executors, forward_backward};
use eyebolt_net::graph::SampleLevel;
use eyebolt_net::models::{Abstraction, PointNet2, Scale, Task};
use eyebolt_net::reference::Reference;
use eyebolt_net::sampling::{ball_query, farthest_points, three_nearest, uniform_points};
use eyebolt_net::{Batch, Cpu, Executor, Graph, GraphBuilder, Matrix, Parameters, Sampling};

fn points() -> Vec<[f32; 3]> {
    hashed("points", 600).as_chunks::<3>().0.to_vec()
}

fn centres() -> Vec<[f32; 3]> {
    let points = points();
    farthest_points(&points, 40).into_iter().map(|at| points[at as usize]).collect()
}

fn integers(values: impl IntoIterator<Item = u32>) -> Vec<i32> {
    values.into_iter().map(|value| value as i32).collect()
}

#[test]
fn sampling_and_grouping() {
    let fixture = Fixture::read("points");
    let points = points();
    assert_eq!(integers(farthest_points(&points, 40)), fixture.integers("farthest"));
    assert_eq!(integers(ball_query(&points, &centres(), 0.4, 9)), fixture.integers("ball"));
    let nearest = three_nearest(&centres(), &points);
    assert_eq!(integers(nearest.iter().flat_map(|(at, _)| *at)), fixture.integers("nearest"));
    let weights: Vec<f32> = nearest.iter().flat_map(|(_, weights)| *weights).collect();
    assert_close("weights", &weights, fixture.floats("weights"), 1e-5);
}

#[test]
fn fewer_than_three_sources_share_what_they_are_due() {
    let sources = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let between = three_nearest(&sources, &[[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]);
    assert_eq!(between[0].1, [0.5, 0.5, 0.0]);
    assert!(between[1].1[0] > 0.999_999 && between[1].0[0] == 0);
    assert_eq!(three_nearest(&sources[..1], &sources), [([0; 3], [1.0, 0.0, 0.0]); 2]);
}

#[test]
fn uniform_samples_are_different_points() {
    let mut chosen = uniform_points(50, 20, 4);
    assert_ne!(chosen, uniform_points(50, 20, 5));
    chosen.dedup();
    assert!(chosen.len() == 20 && chosen.is_sorted() && chosen.iter().all(|&at| at < 50));
    assert_eq!(uniform_points(3, 7, 0), [0, 1, 2, 0, 1, 2, 0]);
}

fn network(several: bool) -> PointNet2 {
    let scale = |radius, neighbours, channels: [usize; 2]| Scale {
        radius,
        neighbours,
        channels: channels.to_vec(),
    };
    let level = |samples, near, far| Abstraction {
        samples,
        scales: if several { vec![near, far] } else { vec![far] },
    };
    PointNet2 {
        inputs: 3,
        outputs: 3,
        abstractions: vec![
            level(40, scale(0.2, 4, [6, 7]), scale(0.4, 8, [6, 8])),
            level(10, scale(0.4, 4, [10, 12]), scale(0.8, 8, [10, 12])),
        ],
        task: Task::Segmentation(vec![vec![11], vec![12, 13]]),
        head: vec![9],
        dropout: 0.0,
    }
}

/// As published: a last group with where samples are, and two layers before the logits.
fn classification() -> PointNet2 {
    PointNet2 { task: Task::Classification(vec![16, 24]), head: vec![20, 16], ..network(true) }
}

fn parameters(graph: &Graph, prefix: &str) -> Parameters {
    let values = graph.parameters().iter().map(|spec| {
        let change = |value: f32| match (spec.name.rsplit_once('.').unwrap().1, &spec.shape[..]) {
            ("weight", &[inputs, _]) => value * (6.0 / inputs as f32).sqrt(),
            ("weight", _) => 1.0 + 0.2 * value,
            ("running_var", _) => 1.0 + 0.3 * value,
            _ => 0.1 * value,
        };
        hashed(&format!("{prefix}{}", spec.name), spec.len()).into_iter().map(change).collect()
    });
    Parameters::new(graph, values.collect()).unwrap()
}

/// The network of this name of the script, on items of 25 points each, against what it says.
fn compare(name: &str, net: &PointNet2, items: usize) {
    let fixture = Fixture::read("points");
    let graph = net.graph().unwrap();
    let features = hashed_matrix("points", 25 * items, 3);
    let points = features.values().as_chunks::<3>().0;
    let sizes = vec![25; items];
    let batch = Batch::from_points(&graph, points, &sizes, &features, Sampling::Farthest).unwrap();
    let parameters = parameters(&graph, &format!("{name}."));
    let expected = |part: &str| fixture.floats(&format!("{name}.{part}"));
    for mut executor in executors() {
        let tolerance = if executor.device() == "reference, f64" { 1e-6 } else { 1e-5 };
        let logits = executor.infer(&graph, &parameters, &batch).unwrap();
        assert_close(name, logits[0].values(), expected("inferred"), tolerance);
        let of = |outputs: &[Matrix]| {
            vec![hashed_matrix(&format!("{name}.weigh"), outputs[0].rows(), 3)]
        };
        let case = (&graph, &parameters, &batch);
        let (forward, found) = forward_backward(&mut *executor, case, 0, of);
        assert_close(name, forward.outputs[0].values(), expected("trained"), tolerance);
        assert_close(name, found.inputs[0].values(), expected("of.features"), tolerance);
        for (spec, values) in graph.parameters().iter().zip(&found.parameters) {
            if spec.role.is_trained() {
                let wanted = expected(&format!("of.{}", spec.name));
                // A bias before a batch norm has no gradient, so the scale is the weights'.
                let weights = expected(&format!("of.{}", spec.name.replace(".bias", ".weight")));
                let largest = weights.iter().fold(0.0_f32, |a, b| a.max(b.abs()));
                assert_within(&spec.name, values, wanted, tolerance * largest);
            }
        }
    }
}

#[test]
fn networks_forward_and_backward() {
    compare("one", &network(false), 8);
    compare("two", &network(true), 8);
    compare("class", &classification(), 20);
}

#[test]
fn two_items_are_as_each_alone_and_gradients_are_those_of_the_reference() {
    for net in [network(false), classification()] {
        let graph = net.graph().unwrap();
        let parameters = parameters(&graph, "");
        let points = points();
        let batch = |range: std::ops::Range<usize>, sizes: &[usize]| {
            let all = hashed("points", 600);
            let features = all[3 * range.start..3 * range.end].to_vec();
            let features = Matrix::new(range.len(), 3, features).unwrap();
            let points = &points[range];
            Batch::from_points(&graph, points, sizes, &features, Sampling::Farthest).unwrap()
        };
        let mut cpu = Cpu::new();
        let mut infer = |batch: &Batch| cpu.infer(&graph, &parameters, batch).unwrap()[0].clone();
        let both = infer(&batch(0..200, &[120, 80]));
        let parts = [infer(&batch(0..120, &[120])), infer(&batch(120..200, &[80]))];
        assert_eq!(both.values(), [parts[0].values(), parts[1].values()].concat());

        // Of two rows a batch norm leaves only signs, and gradients are what rounding leaves.
        let batch = batch(0..200, &[25; 8]);
        let gradients = |executor: &mut dyn Executor| {
            forward_backward(executor, (&graph, &parameters, &batch), 9, <[_]>::to_vec).1
        };
        let expected = gradients(&mut Reference::<f64>::new());
        let found = gradients(&mut Cpu::new());
        for ((found, expected), spec) in
            found.parameters.iter().zip(&expected.parameters).zip(graph.parameters())
        {
            // What a batch norm takes out again, as a bias before it, has no gradient.
            if expected.iter().any(|value| value.abs() > 1e-6) {
                assert_close(&spec.name, found, expected, 1e-4);
            }
        }
        assert_close("input", found.inputs[0].values(), expected.inputs[0].values(), 1e-4);
    }
}

/// Where so many samples are, level after level, of items with the same points.
fn positions(items: usize, counts: [usize; 2], sampling: Sampling) -> [Vec<f32>; 2] {
    let levels = counts.map(|samples| SampleLevel { samples, scales: vec![] });
    let mut g = GraphBuilder::with_sampling(levels.to_vec());
    let outputs = [1, 2].map(|level| g.positions(level));
    let graph = g.finish(&outputs).unwrap();
    let points = points()[..40].repeat(items);
    let features = Matrix::zeros(points.len(), 0);
    let sizes = vec![40; items];
    let batch = Batch::from_points(&graph, &points, &sizes, &features, sampling).unwrap();
    [0, 1].map(|level| batch.inputs()[level].values().to_vec())
}

#[test]
fn uniform_samples_of_items_and_levels_are_drawn_apart() {
    let uniform = |items, counts| positions(items, counts, Sampling::Uniform(7));
    let [both, _] = uniform(2, [20, 10]);
    let (first, second) = both.split_at(20 * 3);
    assert_ne!(first, second);
    let [farthest, _] = positions(2, [20, 10], Sampling::Farthest);
    assert_eq!(farthest[..60], farthest[60..], "items alike");
    // The first level keeps all points, so that both levels draw 10 of the same 40.
    assert_ne!(uniform(1, [40, 10])[1], uniform(1, [10, 5])[0]);
    assert_eq!(uniform(1, [20, 10])[0], first, "items behind it change nothing");
    assert_eq!(uniform(2, [20, 10])[0], both);
    assert_ne!(positions(1, [20, 10], Sampling::Uniform(8))[0], first);
}

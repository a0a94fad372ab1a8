//! A small MinkUNet learns to tell three shapes from each other and from noise.

use crate::fixtures::hashed;
use crate::scenes::within;
use eyebolt_net::graph::{Domain, GraphBuilder, MapSpec, Source};
use eyebolt_net::losses::cross_entropy;
use eyebolt_net::models::MinkUNet;
use eyebolt_net::training::{Rule, Schedule, Trainer};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use std::collections::BTreeMap;

const STEPS: u64 = 300;

fn network() -> Graph {
    let mut net = MinkUNet::named("minkunet14a", 1, 4).unwrap();
    net.stem_channels = 16;
    net.channels = [16, 16, 24, 32, 32, 24, 16, 16];
    net.stem_kernel = 3;
    net.graph().unwrap()
}

/// Voxels of a sphere, a box and a disc at places of their own, and noise: classes 0 to 3.
fn scene(seed: u64) -> (Vec<[i32; 4]>, Vec<u32>) {
    let random = hashed(&format!("scene {seed}"), 12_000);
    let mut random = random.into_iter().cycle();
    let mut next = move || random.next().unwrap();
    let mut voxels = BTreeMap::new();
    for _ in 0..120 {
        voxels.insert([0; 3].map(|_: i32| (40.0 * next()) as i32), 3);
    }
    for (class, x) in [(0, -22.0), (1, 0.0), (2, 22.0)] {
        let (size, centre) = (6.0 + 2.0 * next(), [x, 20.0 * next(), 20.0 * next()]);
        for _ in 0..900 {
            let [mut a, mut b, mut c] = [next(), next(), next()];
            match class {
                0 => {
                    let length = (a * a + b * b + c * c).sqrt().max(1e-3);
                    [a, b, c] = [a, b, c].map(|value| value / length);
                }
                1 => {
                    let side = next();
                    let face = if side > 0.0 { 1.0 } else { -1.0 };
                    match (side.abs() * 3.0) as u32 {
                        0 => a = face,
                        1 => b = face,
                        _ => c = face,
                    }
                }
                _ if a * a + b * b > 1.0 => continue,
                _ => c = 0.0,
            }
            let cell = [0, 1, 2].map(|axis| (centre[axis] + size * [a, b, c][axis]).floor() as i32);
            voxels.insert(cell, class);
        }
    }
    voxels.into_iter().map(|([x, y, z], class)| ([0, x, y, z], class)).unzip()
}

fn batch(graph: &Graph, seed: u64) -> (Batch, Vec<u32>) {
    let (voxels, labels) = scene(seed);
    let ones = Matrix::new(voxels.len(), 1, vec![1.0; voxels.len()]).unwrap();
    (Batch::from_voxels(graph, &voxels, &ones).unwrap(), labels)
}

fn train(graph: &Graph, trainer: &mut Trainer, until: u64) {
    let mut cpu = Cpu::new();
    while trainer.step_count() < until {
        let (batch, labels) = batch(graph, trainer.step_count());
        let loss = |outputs: &[Matrix]| Ok(vec![cross_entropy(&outputs[0], &labels, 255, None)?]);
        trainer.step(&mut cpu, graph, &batch, loss).unwrap();
    }
}

fn trainer(graph: &Graph) -> Trainer {
    let schedule = Schedule::Cosine { rate: 5e-3, warm_up: 10, total: STEPS };
    Trainer::new(graph, Rule::adamw(1e-4), schedule, 1)
}

#[test]
fn three_shapes_in_noise() {
    let graph = network();
    let mut trainer = trainer(&graph);
    train(&graph, &mut trainer, STEPS);
    let (mut right, mut total) = (0, 0);
    for seed in 1000..1010 {
        let (batch, labels) = batch(&graph, seed);
        let logits = Cpu::new().infer(&graph, trainer.parameters(), &batch).unwrap();
        let classes = logits[0].argmax();
        right += classes.iter().zip(&labels).filter(|(found, label)| found == label).count();
        total += labels.len();
    }
    let share = right as f64 / total as f64;
    assert!(share >= 0.98, "{share} of {total} points");
}

#[test]
fn killed_and_resumed_it_ends_in_the_same_bytes() {
    let graph = network();
    let mut whole = trainer(&graph);
    train(&graph, &mut whole, 6);
    let mut killed = trainer(&graph);
    train(&graph, &mut killed, 3);
    let bytes = killed.checkpoint(&graph).unwrap();
    let mut resumed = Trainer::resume(&graph, &bytes).unwrap();
    assert_eq!(resumed, killed);
    train(&graph, &mut resumed, 6);
    assert!(resumed.checkpoint(&graph).unwrap() == whole.checkpoint(&graph).unwrap());
}

#[test]
fn dropout_goes_on_as_it_would_have() {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 1);
    let x = g.convolution("first", x, within(3, 1, 1), 8, true).unwrap();
    let x = g.dropout(x, 0.5);
    let x = g.linear("logits", x, 4, true);
    let x = g.combine("slice", x, MapSpec::Slice).unwrap();
    let graph = g.finish(&[x]).unwrap();
    let from = |seed| {
        let weights = Parameters::initial(&graph, 3);
        let schedule = Schedule::Constant { rate: 1e-2 };
        Trainer::from_parameters(weights, Rule::adam(0.0), schedule, seed)
    };
    let (mut whole, mut other) = (from(7), from(8));
    train(&graph, &mut whole, 2);
    let mut resumed = Trainer::resume(&graph, &whole.checkpoint(&graph).unwrap()).unwrap();
    for trainer in [&mut whole, &mut resumed, &mut other] {
        train(&graph, trainer, 4);
    }
    assert_eq!(resumed.parameters(), whole.parameters());
    assert_ne!(other.parameters(), whole.parameters(), "dropout does not follow the seed");
}

#[test]
fn steps_that_would_spoil_a_network_change_nothing() {
    let graph = network();
    let (voxels, labels) = scene(0);
    let features = |size: f32| Matrix::new(voxels.len(), 1, vec![size; voxels.len()]).unwrap();
    let step = |trainer: &mut Trainer, size: f32| {
        let batch = Batch::from_voxels(&graph, &voxels, &features(size)).unwrap();
        let loss = |outputs: &[Matrix]| Ok(vec![cross_entropy(&outputs[0], &labels, 255, None)?]);
        trainer.step(&mut Cpu::new(), &graph, &batch, loss)
    };
    let mut large = trainer(&graph);
    let before = large.clone();
    let error = step(&mut large, 1e20).unwrap_err().to_string();
    assert!(error.contains("bn0.running_var would be inf"), "{error}");
    assert_eq!(large, before);
    for (rule, schedule, name) in [
        (Rule::adam(0.0), Schedule::Constant { rate: f64::NAN }, "rate: NaN"),
        (Rule::adam(0.0), Schedule::Constant { rate: 1e300 }, "rate: 1"),
        (Rule::adam(-1.0), Schedule::Constant { rate: 0.1 }, "weight_decay: -1"),
        (
            Rule::Sgd { momentum: 1.0, weight_decay: 0.0 },
            Schedule::Constant { rate: 0.1 },
            "momentum: 1",
        ),
    ] {
        let mut wrong = Trainer::new(&graph, rule, schedule, 1);
        let error = step(&mut wrong, 1.0).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
        assert_eq!(wrong.step_count(), 0);
    }
}

#[test]
fn broken_checkpoints_are_refused() {
    let graph = network();
    let bytes = trainer(&graph).checkpoint(&graph).unwrap();
    for end in (0..bytes.len()).step_by(bytes.len() / 50) {
        assert!(Trainer::resume(&graph, &bytes[..end]).is_err(), "cut at {end}");
    }
    let other = MinkUNet::named("minkunet14a", 2, 4).unwrap().graph().unwrap();
    let error = Trainer::resume(&other, &bytes).unwrap_err().to_string();
    assert!(error.contains("checkpoint: conv0p1s1.kernel: shape"), "{error}");
}

#[test]
fn learning_goes_on_from_weights_and_with_another_schedule() {
    let graph = network();
    let mut first = trainer(&graph);
    train(&graph, &mut first, 2);
    let schedule = Schedule::Constant { rate: 1e-3 };
    let weights = first.parameters().clone();
    let mut tuned = Trainer::from_parameters(weights.clone(), Rule::adamw(1e-4), schedule, 5);
    assert_eq!((tuned.parameters(), tuned.step_count()), (&weights, 0));
    train(&graph, &mut tuned, 1);
    assert_ne!(tuned.parameters(), &weights);
    let mut slower = first.clone();
    slower.set_schedule(schedule);
    train(&graph, &mut slower, 3);
    train(&graph, &mut first, 3);
    assert_ne!(slower.parameters(), first.parameters());
}

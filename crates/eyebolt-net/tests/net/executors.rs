//! The same suite for every executor: against the plain one in 64 bits, on any number of threads.

use crate::scenes::{every_operation, features, noise, parameters, sheet};
use eyebolt_net::reference::Reference;
use eyebolt_net::simd::Isa;
use eyebolt_net::{Batch, Cpu, Executor, Gradients, Graph, Matrix, Parameters};

struct Case {
    graph: Graph,
    parameters: Parameters,
    batch: Batch,
}

fn case(edge: i32) -> Case {
    let graph = every_operation();
    let coordinates = sheet(edge);
    let batch = Batch::from_voxels(&graph, &coordinates, &features(5, coordinates.len(), 3));
    Case { parameters: parameters(&graph, 11), batch: batch.unwrap(), graph }
}

struct Answer {
    inferred: Vec<Matrix>,
    forward: eyebolt_net::Forward,
    gradients: Gradients,
}

fn run(executor: &mut dyn Executor, case: &Case) -> Answer {
    let Case { graph, parameters, batch } = case;
    let inferred = executor.infer(graph, parameters, batch).unwrap();
    let forward = executor.forward(graph, parameters, batch, 3).unwrap();
    let of = |output: &Matrix| {
        let values = noise(17, output.values().len());
        Matrix::new(output.rows(), output.channels(), values).unwrap()
    };
    let of: Vec<Matrix> = forward.outputs.iter().map(of).collect();
    let gradients = executor.backward(graph, parameters, batch, &of, true).unwrap();
    Answer { inferred, forward, gradients }
}

/// Largest difference, in shares of the largest value.
fn difference(found: &[f32], expected: &[f32]) -> f32 {
    assert_eq!(found.len(), expected.len());
    let largest = expected.iter().fold(1e-20_f32, |a, b| a.max(b.abs()));
    let pairs = found.iter().zip(expected);
    pairs.map(|(a, b)| (a - b).abs() / largest).fold(0.0, f32::max)
}

fn lists(answer: &Answer) -> Vec<(String, &[f32])> {
    let mut lists = Vec::new();
    let mut add = |name: String, values| lists.push((name, values));
    for (index, output) in answer.inferred.iter().enumerate() {
        add(format!("inferred {index}"), output.values());
    }
    for (index, output) in answer.forward.outputs.iter().enumerate() {
        add(format!("output {index}"), output.values());
    }
    for (id, values) in &answer.forward.running {
        add(format!("running {}", id.index()), values);
    }
    for (index, values) in answer.gradients.parameters.iter().enumerate() {
        add(format!("gradient {index}"), values);
    }
    for (index, values) in answer.gradients.inputs.iter().enumerate() {
        add(format!("input gradient {index}"), values.values());
    }
    lists
}

fn assert_close(found: &Answer, expected: &Answer, tolerance: f32) {
    for ((name, found), (_, expected)) in lists(found).into_iter().zip(lists(expected)) {
        let difference = difference(found, expected);
        assert!(difference < tolerance, "{name}: {difference}");
    }
}

#[test]
fn the_cpu_does_what_the_reference_does() {
    let case = case(24);
    let expected = run(&mut Reference::<f64>::new(), &case);
    for isa in Isa::available() {
        assert_close(&run(&mut Cpu::with_isa(isa), &case), &expected, 1e-5);
    }
}

#[test]
fn buffers_used_again_change_nothing() {
    let (case, other) = (case(24), case(9));
    let expected = run(&mut Cpu::new(), &case);
    let mut cpu = Cpu::new();
    run(&mut cpu, &case);
    run(&mut cpu, &other);
    let again = run(&mut cpu, &case);
    assert!(lists(&again) == lists(&expected));
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let case = case(60);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&mut Cpu::new(), &case))
    };
    let one = on(1);
    for threads in [2, 5] {
        assert!(lists(&on(threads)) == lists(&one), "{threads} threads");
    }
}

#[test]
fn what_belongs_to_another_network_is_refused() {
    let case = case(6);
    let mut g = eyebolt_net::GraphBuilder::new();
    let domain = eyebolt_net::graph::Domain::Voxels { stride: 1 };
    let input = g.input(eyebolt_net::graph::Source::Features, domain, 4);
    let other = g.finish(&[input]).unwrap();
    let mut cpu = Cpu::new();
    let error = cpu.infer(&other, &Parameters::initial(&other, 0), &case.batch).unwrap_err();
    assert!(error.to_string().contains("another network"), "{error}");
    let error = cpu.infer(&case.graph, &Parameters::initial(&other, 0), &case.batch).unwrap_err();
    assert!(error.to_string().contains("another network"), "{error}");
    let error = cpu.backward(&case.graph, &case.parameters, &case.batch, &[], false).unwrap_err();
    assert!(error.to_string().contains("output gradients"), "{error}");
}

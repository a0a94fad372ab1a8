//! The same suite for every executor: against the plain one in 64 bits, on any number of threads.

use crate::fixtures;
use crate::runs::{executors, forward_backward};
use crate::scenes::{every_operation, features, noise, parameters, sheet, within};
use eyebolt_net::coordinates::{BLOCK_ROWS, KernelSpec};
use eyebolt_net::executor::OutputGradients;
use eyebolt_net::graph::{Domain, GraphBuilder, MapSpec, Op, Source};
use eyebolt_net::reference::Reference;
use eyebolt_net::{
    Batch, Cpu, Error, Executor, Gradients, Graph, Isa, Matrix, Parameters, PassOptions,
};

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
    let of = |output: &Matrix| {
        let values = noise(17, output.values().len());
        Matrix::new(output.rows(), output.channels(), values).unwrap()
    };
    let of = |outputs: &[Matrix]| outputs.iter().map(of).collect();
    let (forward, gradients) = forward_backward(executor, (graph, parameters, batch), 3, of);
    Answer { inferred, forward, gradients }
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
        fixtures::assert_close(&name, found, expected, tolerance);
    }
}

#[test]
fn all_do_what_the_reference_does() {
    let case = case(24);
    let expected = run(&mut Reference::<f64>::new(), &case);
    for mut executor in executors() {
        assert_close(&run(&mut *executor, &case), &expected, 1e-5);
    }
}

/// Many blocks of rows and several panels of channels, which the CPU shares out in another way
/// than few.
fn large_case() -> Case {
    let mut g = GraphBuilder::new();
    let input = g.input(Source::Features, Domain::Voxels { stride: 1 }, 3);
    let x = g.convolution("wide", input, within(3, 1, 1), 70, true).unwrap();
    let x = g.batch_norm("norm", x);
    let x = g.relu(x);
    let x = g.convolution("even", x, within(2, 1, 1), 66, false).unwrap();
    let mean = MapSpec::Means(Domain::Voxels { stride: 1 });
    let mean = g.combine("mean", x, mean).unwrap();
    let graph = g.finish(&[x, mean]).unwrap();
    let cells = sheet(100);
    assert!(cells.len() > 16 * BLOCK_ROWS);
    let batch = Batch::from_voxels(&graph, &cells, &features(5, cells.len(), 3)).unwrap();
    Case { parameters: parameters(&graph, 11), batch, graph }
}

#[test]
fn clouds_of_many_blocks() {
    let case = large_case();
    let expected = run(&mut Reference::<f64>::new(), &case);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    for isa in Isa::available() {
        let on = |threads: usize| pool(threads).install(|| run(&mut Cpu::with_isa(isa), &case));
        let (one, three) = (on(1), on(3));
        assert!(lists(&one) == lists(&three), "{} on one thread and on three", isa.name());
        for ((name, found), (_, expected)) in lists(&one).into_iter().zip(lists(&expected)) {
            // A bias before a batch norm has no gradient but what rounding leaves.
            let bias = case.graph.parameters().iter().position(|spec| spec.name == "wide.bias");
            if name != format!("gradient {}", bias.unwrap()) {
                fixtures::assert_close(&name, found, expected, 1e-5);
            }
        }
    }
}

#[test]
fn means_over_whole_clouds_are_exact() {
    let mut g = GraphBuilder::new();
    let domain = Domain::Voxels { stride: 1 };
    let x = g.input(Source::Features, domain, 1);
    let mean = g.combine("mean", x, MapSpec::Means(domain)).unwrap();
    let slice = g.combine("slice", x, MapSpec::Slice).unwrap();
    let graph = g.finish(&[mean, slice]).unwrap();
    // 150 000 voxels of one value, and as many points in one voxel more.
    let mut cells: Vec<[i32; 4]> = (0..150_000).map(|i| [0, i % 400, i / 400, 0]).collect();
    cells.extend(vec![[0, -1, 0, 0]; 150_000]);
    let features = Matrix::new(cells.len(), 1, vec![0.1; cells.len()]).unwrap();
    let batch = Batch::from_voxels(&graph, &cells, &features).unwrap();
    assert!(batch.inputs()[0].values().iter().all(|&value| value == 0.1));
    let parameters = Parameters::initial(&graph, 0);
    let mut cpu = Cpu::new();
    let inferred = cpu.infer(&graph, &parameters, &batch).unwrap();
    assert!((inferred[0].values()[0] - 0.1).abs() < 1e-6, "{:?}", inferred[0]);
    let of = |outputs: &[Matrix]| outputs.iter().map(|output| output.map(|_| 0.1)).collect();
    let (_, found) = forward_backward(&mut cpu, (&graph, &parameters, &batch), 0, of);
    // Of the crowded voxel.
    let largest = found.inputs[0].values().iter().fold(0.0_f32, |a, &b| a.max(b));
    assert!((largest - 15_000.0).abs() < 0.05, "{largest}");
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

fn network(outputs: usize, kernel: KernelSpec) -> Graph {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 3);
    let y = g.convolution("layer", x, kernel, outputs, false).unwrap();
    g.finish(&[y]).unwrap()
}

#[test]
fn what_belongs_to_another_network_is_refused() {
    let cells = sheet(6);
    let features = features(5, cells.len(), 3);
    let graph = network(2, within(3, 1, 1));
    let batch = |graph: &Graph| Batch::from_voxels(graph, &cells, &features).unwrap();
    let of_more = network(3, within(3, 1, 1));
    for mut executor in executors() {
        let mut infer = |parameters_of: &Graph, batch: &Batch| {
            let parameters = Parameters::initial(parameters_of, 0);
            executor.infer(&graph, &parameters, batch)
        };
        assert!(infer(&graph, &batch(&graph)).is_ok());
        // Whose neighbours they are is the same, however many channels come out.
        assert!(infer(&graph, &batch(&of_more)).is_ok());
        let error = infer(&of_more, &batch(&graph)).unwrap_err().to_string();
        assert_eq!(error, "parameters: made for another network");
        // Of the same rows and as many maps, but other neighbours.
        for other in [within(5, 1, 1), within(3, 2, 1), within(2, 1, 1)] {
            let error = infer(&graph, &batch(&network(2, other))).unwrap_err().to_string();
            assert_eq!(error, "batch: made for another network");
        }
    }
}

#[test]
fn gradients_that_do_not_fit_are_refused_and_losses_may_fail() {
    let case = case(6);
    let Case { graph, parameters, batch } = &case;
    for mut executor in executors() {
        let mut refusal = |of: OutputGradients<'_>| {
            let options = PassOptions::default();
            let result = executor.forward_backward(graph, parameters, batch, options, of);
            result.unwrap_err().to_string()
        };
        assert!(refusal(&mut |_| Ok(Vec::new())).starts_with("output gradients: not as many"));
        let own = Error::Input { field: "loss".into(), problem: "of its own".into() };
        assert_eq!(refusal(&mut |_| Err(own.clone())), "loss: of its own");
    }
}

#[test]
fn versions_tell_when_values_may_have_changed() {
    let Case { graph, mut parameters, batch } = case(6);
    let same = parameters.clone();
    assert_eq!(same.version(), parameters.version());
    assert_eq!(batch.clone().id(), batch.id());
    let weights = graph.nodes().iter().find_map(|node| match node.op {
        Op::Convolution { weight, .. } => Some(weight),
        _ => None,
    });
    parameters.get_mut(weights.unwrap())[0] += 1.0;
    assert_ne!(same.version(), parameters.version());
    assert_ne!(same, parameters);
    assert_ne!(Parameters::initial(&graph, 1).version(), Parameters::initial(&graph, 1).version());
}

//! Inputs that are empty, odd or too much: a right answer or an error that says what and where.

use crate::runs::{executors, forward_backward};
use crate::scenes::{every_operation, features, parameters};
use eyebolt_net::coordinates::{KernelSpec, Neighbours, VoxelSet};
use eyebolt_net::graph::{Domain, GraphBuilder, NodeId, SampleLevel, Source};
use eyebolt_net::models::{MinkEncoder, MinkUNet, PointNet2, Task};
use eyebolt_net::{Batch, Cpu, Error, Executor, Graph, Matrix, Parameters, PassOptions, Sampling};

fn refusal(result: Result<Batch, Error>) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn clouds_that_cannot_be_used() {
    let graph = every_operation();
    let voxels =
        |cells: &[[i32; 4]], features: &Matrix| Batch::from_voxels(&graph, cells, features);
    let one = [[0, 1, 2, 3]];
    let none = refusal(voxels(&[], &Matrix::zeros(0, 3)));
    assert_eq!(none, "coordinates: there are none");
    let nan = Matrix::new(1, 3, vec![0.0, 0.0, f32::NAN]).unwrap();
    assert!(refusal(voxels(&one, &nan)).contains("features: row 0, channel 2 is NaN"));
    let channels = refusal(voxels(&one, &Matrix::zeros(1, 4)));
    assert_eq!(channels, "features: 4 channels; the network takes 3");
    assert!(refusal(voxels(&one, &Matrix::zeros(2, 3))).contains("2 rows for 1 points"));
    let gap = [[0, 0, 0, 0], [2, 0, 0, 0]];
    assert!(
        refusal(voxels(&gap, &Matrix::zeros(2, 3))).contains("item 1 of the batch has no point")
    );
    let of_points = PointNet2::single_scale(3, 2).graph().unwrap();
    assert!(
        refusal(Batch::from_voxels(&of_points, &one, &Matrix::zeros(1, 3))).contains("from_points")
    );
    let points = |points: &[[f32; 3]], sizes: &[usize], features: &Matrix| {
        refusal(Batch::from_points(&of_points, points, sizes, features, Sampling::Farthest))
    };
    assert!(points(&[], &[], &Matrix::zeros(0, 3)).contains("without a point"));
    assert!(points(&[[0.0; 3]], &[2], &Matrix::zeros(1, 3)).contains("not as many"));
    assert!(points(&[[0.0; 3]], &[usize::MAX, 2], &Matrix::zeros(1, 3)).contains("not as many"));
    assert!(points(&[[f32::NAN; 3]], &[1], &Matrix::zeros(1, 3)).contains("points: row 0"));
    assert!(points(&[[-2e9; 3]], &[1], &Matrix::zeros(1, 3)).contains("beyond 1000000000"));
    assert!(points(&[[0.0; 3]], &[1], &Matrix::zeros(1, 2)).contains("takes 3"));
}

fn assert_finite(graph: &Graph, parameters: &Parameters, batch: &Batch) {
    let finite = |values: &[f32]| values.iter().all(|value| value.is_finite());
    for mut executor in executors() {
        let inferred = executor.infer(graph, parameters, batch).unwrap();
        assert!(inferred.iter().map(Matrix::values).all(finite));
        let case = (graph, parameters, batch);
        let (forward, found) = forward_backward(&mut *executor, case, 0, <[_]>::to_vec);
        let matrices = forward.outputs.iter().chain(&found.inputs);
        assert!(matrices.map(Matrix::values).all(finite));
        assert!(found.parameters.iter().all(|values| finite(values)));
    }
}

/// Inference gives finite values, training says what a batch norm needs.
fn assert_only_inferred(graph: &Graph, parameters: &Parameters, batch: &Batch) {
    for mut executor in executors() {
        let inferred = executor.infer(graph, parameters, batch).unwrap();
        assert!(inferred.iter().flat_map(Matrix::values).all(|value| value.is_finite()));
        let mut of = |outputs: &[Matrix]| Ok(outputs.to_vec());
        let options = PassOptions::default();
        let trained = executor.forward_backward(graph, parameters, batch, options, &mut of);
        let error = trained.unwrap_err().to_string();
        assert!(error.contains("a batch norm in training needs two or more"), "{error}");
    }
}

#[test]
fn a_single_point() {
    let graph = every_operation();
    let batch = Batch::from_voxels(&graph, &[[0, -5, 0, 9]], &features(1, 1, 3)).unwrap();
    assert_only_inferred(&graph, &parameters(&graph, 2), &batch);
    // Without features, too: where points are is then all that is known of them.
    for inputs in [3, 0] {
        let mut net = PointNet2::multi_scale_classification(inputs, 2);
        for level in &mut net.abstractions {
            level.samples = 4;
            level.scales.iter_mut().for_each(|scale| scale.neighbours = 4);
        }
        let graph = net.graph().unwrap();
        let parameters = Parameters::initial(&graph, 0);
        let batch = |points: &[[f32; 3]]| {
            let (items, features) = (vec![1; points.len()], features(1, points.len(), inputs));
            Batch::from_points(&graph, points, &items, &features, Sampling::Farthest).unwrap()
        };
        assert_only_inferred(&graph, &parameters, &batch(&[[0.1; 3]]));
        assert_finite(&graph, &parameters, &batch(&[[0.1; 3], [0.2; 3]]));
    }
}

#[test]
fn corners_of_space() {
    let graph = every_operation();
    let limit = eyebolt_net::coordinates::COORDINATE_LIMIT;
    let ends = [-limit, limit - 1];
    let corners: Vec<[i32; 4]> = (0..8)
        .map(|corner| [0, ends[corner & 1], ends[corner >> 1 & 1], ends[corner >> 2]])
        .collect();
    let batch = Batch::from_voxels(&graph, &corners, &features(1, 8, 3)).unwrap();
    assert_finite(&graph, &parameters(&graph, 2), &batch);
}

#[test]
fn many_points() {
    // Ten million points in five million voxels.
    let mut net = MinkUNet::named("minkunet14a", 1, 2).unwrap();
    net.stem_channels = 1;
    net.stem_kernel = 1;
    net.channels = [1; 8];
    let graph = net.graph().unwrap();
    let cells: Vec<[i32; 4]> =
        (0..10_000_000).map(|i| [0, i % 1000, i / 1000 % 1000, 7 * (i % 7) % 5]).collect();
    let ones = Matrix::new(cells.len(), 1, vec![1.0; cells.len()]).unwrap();
    let batch = Batch::from_voxels(&graph, &cells, &ones).unwrap();
    let logits = Cpu::new().infer(&graph, &Parameters::initial(&graph, 1), &batch).unwrap();
    assert_eq!(logits[0].rows(), cells.len());
    assert!(logits[0].values().iter().all(|value| value.is_finite()));
}

#[test]
fn no_channels() {
    let mut g = GraphBuilder::new();
    let input = g.input(Source::Features, Domain::Voxels { stride: 1 }, 0);
    let some = g.convolution("some", input, crate::scenes::within(3, 1, 1), 2, true).unwrap();
    let none = g.linear("none", some, 0, true);
    let none = g.batch_norm("norm", none);
    let graph = g.finish(&[some, none]).unwrap();
    let batch =
        Batch::from_voxels(&graph, &[[0, 1, 2, 3], [0, 1, 2, 4]], &Matrix::zeros(2, 0)).unwrap();
    assert_finite(&graph, &Parameters::initial(&graph, 0), &batch);
}

#[test]
fn networks_that_are_none() {
    assert!(MinkUNet::named("minkunet99", 3, 3).unwrap_err().to_string().contains("not known"));
    let mut net = MinkUNet::named("MinkUNet34C", 3, 3).unwrap();
    net.channels[3] = 0;
    assert!(net.graph().unwrap_err().to_string().contains("channels: 0 channels"));
    let mut net = MinkUNet::named("50", 3, 3).unwrap();
    net.layers[6] = 65;
    assert!(net.graph().unwrap_err().to_string().contains("65 blocks; there must be 1 to 64"));
    let mut net = PointNet2::single_scale(3, 2);
    net.abstractions[1].scales[0].radius = f32::NAN;
    assert!(net.graph().unwrap_err().to_string().contains("radius NaN"));
    net.abstractions.pop();
    assert!(net.graph().unwrap_err().to_string().contains("radius NaN"));
    net.abstractions.pop();
    net.abstractions.pop();
    assert!(net.graph().unwrap_err().to_string().contains("4 levels up"));
    net.abstractions.clear();
    net.task = Task::Classification(vec![8]);
    assert!(net.graph().unwrap_err().to_string().contains("abstractions: 0 of them"));
}

#[test]
fn encoders_that_are_none() {
    let refusal = |change: &dyn Fn(&mut MinkEncoder)| {
        let mut net = MinkEncoder::named("minkunet18", 3, &[2048, 4]).unwrap();
        net.graph().unwrap();
        change(&mut net);
        net.graph().unwrap_err().to_string()
    };
    assert!(MinkEncoder::named("18e", 3, &[4]).unwrap_err().to_string().contains("not known"));
    assert!(refusal(&|net| net.widths.clear()).contains("widths: 0 layers"));
    assert!(refusal(&|net| net.widths[0] = 4097).contains("widths: 4097 channels"));
    assert!(refusal(&|net| net.widths = vec![1; 65]).contains("widths: 65 layers"));
    assert!(refusal(&|net| net.layers[2] = 1 << 40).contains("blocks; there must be 1 to 64"));
    assert!(refusal(&|net| net.stem_kernel = 4).contains("stem_kernel 4"));
    assert!(refusal(&|net| net.inputs = 0).contains("inputs: 0 channels"));
}

#[test]
fn operations_that_do_not_fit() {
    let level = SampleLevel { samples: 4, scales: vec![] };
    let mut g = GraphBuilder::with_sampling(vec![level]);
    let voxels = g.input(Source::Features, Domain::Voxels { stride: 2 }, 3);
    let points = g.input(Source::Features, Domain::Points, 3);
    let (samples, items) = (g.positions(1), g.global_max_pool("max", voxels).unwrap());
    let refused = |result: Result<_, Error>| result.unwrap_err().to_string();
    assert!(refused(g.slice("slice", voxels)).contains("slice: needs a value on"));
    assert!(refused(g.global_average_pool("mean", items)).contains("mean: "));
    assert!(refused(g.group("group", points, 0)).contains("no scale 0 at level 1"));
    assert!(refused(g.group("group", samples, 0)).contains("no scale 0 at level 2"));
    assert!(refused(g.group("group", voxels, 0)).contains("needs a value of samples"));
    assert!(refused(g.group_max_pool("pool", samples)).contains("needs a value of neighbours"));
    assert!(refused(g.interpolate("up", points)).contains("not a map between rows"));
    assert!(g.interpolate("up", samples).is_ok());
    for spec in [
        KernelSpec::down(2, u32::MAX, 2),
        KernelSpec::up(2, 8, 3),
        KernelSpec::up(2, 8, 0),
        KernelSpec::up(2, 0, 0),
    ] {
        assert!(spec.check().is_err(), "{spec:?}");
    }
    // Places of points are not known of voxels.
    let graph = g.finish(&[samples]).unwrap();
    assert!(Batch::from_voxels(&graph, &[[0, 1, 2, 3]], &Matrix::zeros(1, 3)).is_err());
}

#[test]
fn voxels_that_are_none_of_the_set() {
    let graph = every_operation();
    let (finest, _) = VoxelSet::new(&[[0, 1, 2, 3], [1, 0, 0, 0]]).unwrap();
    let with = |features: Matrix, voxel_of_point: Vec<u32>| {
        let mut neighbours = Neighbours::new(finest.clone());
        refusal(Batch::from_neighbours(&graph, &mut neighbours, features, voxel_of_point))
    };
    let outside = with(Matrix::zeros(2, 3), vec![0, 7]);
    assert_eq!(outside, "voxel_of_point: point 1 is in voxel 7 of 2");
    assert_eq!(with(Matrix::zeros(3, 3), vec![0, 1]), "features: 3 rows for 2 voxels");
    let infinite = Matrix::new(2, 3, vec![f32::INFINITY; 6]).unwrap();
    assert!(with(infinite, vec![0, 1]).contains("row 0, channel 0 is inf"));
}

#[test]
fn features_of_other_rows_than_the_graph_takes() {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Points, 1);
    let graph = g.finish(&[x]).unwrap();
    let error = refusal(Batch::from_voxels(&graph, &[[0; 4]], &Matrix::zeros(1, 1)));
    assert!(error.contains("takes features on Points"), "{error}");
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 1);
    let graph = g.finish(&[x]).unwrap();
    let (points, one) = ([[0.0; 3]], Matrix::zeros(1, 1));
    let error = Batch::from_points(&graph, &points, &[1], &one, Sampling::Farthest);
    assert!(refusal(error).contains("from_voxels"));
}

#[test]
fn values_too_large_for_32_bits_are_no_answer() {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 2);
    let y = g.linear("sum", x, 1, false);
    let graph = g.finish(&[y]).unwrap();
    let parameters = Parameters::new(&graph, vec![vec![1.0; 2]]).unwrap();
    let large = Matrix::new(2, 2, vec![1.0, 2.0, 3e38, 3e38]).unwrap();
    let batch = Batch::from_voxels(&graph, &[[0, 0, 0, 0], [0, 1, 0, 0]], &large).unwrap();
    for mut executor in executors() {
        let error = executor.infer(&graph, &parameters, &batch).unwrap_err().to_string();
        assert!(error.contains("output 0: row 1, channel 0 is inf"), "{error}");
        let mut of = |_: &[Matrix]| panic!("no loss of that");
        let options = PassOptions::default();
        let trained = executor.forward_backward(&graph, &parameters, &batch, options, &mut of);
        assert!(trained.unwrap_err().to_string().contains("too large"));
    }
}

#[test]
fn memory_has_a_limit() {
    let graph = every_operation();
    let parameters = parameters(&graph, 2);
    let cells = crate::scenes::sheet(20);
    let batch = Batch::from_voxels(&graph, &cells, &features(1, cells.len(), 3)).unwrap();
    let mut roomy = Cpu::new().with_memory_limit(64 << 20);
    assert!(roomy.infer(&graph, &parameters, &batch).is_ok());
    let mut narrow = Cpu::new().with_memory_limit(64 << 10);
    let error = narrow.infer(&graph, &parameters, &batch).unwrap_err().to_string();
    assert!(error.starts_with("batch: more than 0 MiB of memory"), "{error}");
    let mut of = |outputs: &[Matrix]| Ok(outputs.to_vec());
    let options = PassOptions::default();
    assert!(narrow.forward_backward(&graph, &parameters, &batch, options, &mut of).is_err());
    // Nothing is lost by that.
    let mut again = narrow.with_memory_limit(64 << 20);
    let expected = roomy.infer(&graph, &parameters, &batch).unwrap();
    assert_eq!(again.infer(&graph, &parameters, &batch).unwrap(), expected);
}

#[test]
fn graphs_that_are_none() {
    let finish = |build: &dyn Fn(&mut GraphBuilder, NodeId) -> Vec<NodeId>| {
        let mut g = GraphBuilder::new();
        let x = g.input(Source::Features, Domain::Points, 3);
        let outputs = build(&mut g, x);
        g.finish(&outputs).unwrap_err().to_string()
    };
    assert!(finish(&|_, _| vec![]).contains("outputs: there are none"));
    let twice = finish(&|g, x| vec![g.linear("a", x, 2, true), g.linear("a", x, 2, true)]);
    assert!(twice.contains("a.weight: the name of two parameters"), "{twice}");
    assert!(finish(&|g, x| vec![g.dropout(x, 1.0)]).contains("dropout 1"));
    assert!(finish(&|g, x| vec![g.dropout(x, f32::NAN)]).contains("dropout NaN"));
    assert!(finish(&|g, x| vec![g.leaky_relu(x, -0.5)]).contains("slope -0.5"));
    let huge = finish(&|g, x| vec![g.linear("huge", x, usize::MAX, false)]);
    assert!(huge.contains("huge.weight") && huge.contains("more than"), "{huge}");
}

//! Inputs that are empty, odd or too much: a right answer or an error that says what and where.

use crate::scenes::{every_operation, features, parameters};
use eyebolt_net::coordinates::KernelSpec;
use eyebolt_net::graph::{Domain, SampleLevel, Source};
use eyebolt_net::models::{MinkEncoder, MinkUNet, PointNet2, Task};
use eyebolt_net::{Batch, Cpu, Error, Executor, Graph, GraphBuilder, Matrix, Parameters, Sampling};

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
    assert!(points(&[[0.0; 3]], &[1], &Matrix::zeros(1, 2)).contains("takes 3"));
}

fn assert_finite(graph: &Graph, parameters: &Parameters, batch: &Batch) {
    let mut cpu = Cpu::new();
    let inferred = cpu.infer(graph, parameters, batch).unwrap();
    let forward = cpu.forward(graph, parameters, batch, 0).unwrap();
    let found = cpu.backward(graph, parameters, batch, &forward.outputs, true).unwrap();
    let matrices = inferred.iter().chain(&forward.outputs).chain(&found.inputs);
    let finite = |values: &[f32]| values.iter().all(|value| value.is_finite());
    assert!(matrices.map(Matrix::values).all(finite));
    assert!(found.parameters.iter().all(|values| finite(values)));
}

#[test]
fn a_single_point() {
    let graph = every_operation();
    let batch = Batch::from_voxels(&graph, &[[0, -5, 0, 9]], &features(1, 1, 3)).unwrap();
    assert_finite(&graph, &parameters(&graph, 2), &batch);
    // Without features, too: where points are is then all that is known of them.
    for inputs in [3, 0] {
        for net in [PointNet2::single_scale, PointNet2::multi_scale_classification] {
            let graph = net(inputs, 2).graph().unwrap();
            let (points, features) = ([[0.1; 3]], features(1, 1, inputs));
            let batch = Batch::from_points(&graph, &points, &[1], &features, Sampling::Farthest);
            assert_finite(&graph, &Parameters::initial(&graph, 0), &batch.unwrap());
        }
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
    // Ten million points in a million voxels.
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
    let batch = Batch::from_voxels(&graph, &[[0, 1, 2, 3]; 2], &Matrix::zeros(2, 0)).unwrap();
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

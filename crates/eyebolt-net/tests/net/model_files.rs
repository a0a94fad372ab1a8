//! Models in and out of files, and used as they are.

use crate::fixtures::hashed_matrix;
use crate::weights::network;
use eyebolt_net::coordinates::voxelise;
use eyebolt_net::models::{Architecture, MinkEncoder, Model, ModelDescription, PointNet2};
use eyebolt_net::{Batch, Cpu, Executor, Matrix, Parameters, Sampling};

fn description(architecture: Architecture, features: usize, outputs: usize) -> ModelDescription {
    ModelDescription {
        voxel_m: (!matches!(architecture, Architecture::Pointnet2(_))).then_some(0.005),
        image_columns: None,
        window_m: None,
        features: (0..features).map(|index| format!("feature {index}")).collect(),
        classes: (0..outputs).map(|index| format!("class {index}")).collect(),
        frame: "camera".into(),
        trained_on: "nothing".into(),
        commit: "0".into(),
        metrics: [("accuracy".to_owned(), 0.5)].into(),
        architecture,
    }
}

fn model(description: ModelDescription) -> Model {
    let parameters = Parameters::initial(&description.graph().unwrap(), 3);
    Model::new(description, parameters).unwrap()
}

#[test]
fn a_model_is_its_description_and_its_weights() {
    let points = Architecture::Pointnet2(PointNet2::multi_scale(3, 6));
    let mut encoder = MinkEncoder::named("minkunet14", 2, &[8, 4]).unwrap();
    encoder.channels = [3, 4, 4, 4];
    let encoder = Architecture::MinkunetRegression(encoder);
    for (architecture, features, outputs) in
        [(Architecture::Minkunet(network()), 2, 3), (encoder, 2, 4), (points, 3, 6)]
    {
        let model = model(description(architecture, features, outputs));
        let (text, bytes) = model.save().unwrap();
        assert_eq!(Model::load(&text, &bytes).unwrap(), model);
    }
}

#[test]
fn descriptions_that_lie_are_refused() {
    let model = model(description(Architecture::Minkunet(network()), 2, 3));
    let (text, bytes) = model.save().unwrap();
    Model::load(&text, &bytes).unwrap();
    for (from, to, said) in [
        ("inputs = 2", "inputs = 4000000000000", "4000000000000 channels"),
        ("stem_kernel = 5", "stem_kernel = 4", "stem_kernel 4"),
        ("stem_kernel = 5", "stem_kernel = 3", "conv0p1s1.kernel: shape"),
        ("voxel_m = ", "voxel_m = -", "not a positive length"),
        ("frame = ", "frames = ", "frame"),
        ("\"feature 1\"", "", "features: 1 names for the network's 2 channels"),
        ("\"class 1\", ", "", "classes: 2 names for the network's 3 channels"),
        ("voxel_m = 0.005", "", "voxel_m: missing"),
    ] {
        assert!(text.contains(from), "{text}");
        let error = Model::load(&text.replace(from, to), &bytes).unwrap_err().to_string();
        assert!(error.contains(said), "{from} -> {to}: {error}");
    }
}

#[test]
fn points_have_no_voxels() {
    let mut description = description(Architecture::Pointnet2(PointNet2::single_scale(3, 6)), 3, 6);
    description.voxel_m = Some(0.01);
    let error = description.graph().unwrap_err().to_string();
    assert!(error.contains("voxel_m: the network is on points or images"), "{error}");
}

#[test]
fn what_cannot_be_loaded_is_not_saved() {
    let sound = model(description(Architecture::Minkunet(network()), 2, 3));
    let refusal = |change: &dyn Fn(&mut Model)| {
        let mut model = sound.clone();
        change(&mut model);
        model.save().unwrap_err().to_string()
    };
    let voxel = refusal(&|model| model.description.voxel_m = Some(0.0));
    assert!(voxel.contains("voxel_m: 0 is not a positive length"), "{voxel}");
    let classes = refusal(&|model| drop(model.description.classes.pop()));
    assert!(classes.contains("classes: 2 names"), "{classes}");
    let value = refusal(&|model| {
        let first = model.graph.nodes().iter().find_map(|node| match node.op {
            eyebolt_net::graph::Op::Convolution { weight, .. } => Some(weight),
            _ => None,
        });
        model.parameters.get_mut(first.unwrap())[3] = f32::NAN;
    });
    assert!(value.contains("conv0p1s1.kernel: value 3 is NaN"), "{value}");
    let mut other = network();
    other.stem_kernel = 3;
    let graph = refusal(&|model| {
        model.description.architecture = Architecture::Minkunet(other.clone());
    });
    assert!(graph.contains("architecture: describes another graph"), "{graph}");
}

fn cloud(name: &str, points: usize, channels: usize) -> (Vec<[f32; 3]>, Matrix) {
    let places = hashed_matrix(name, points, 3);
    (places.values().as_chunks::<3>().0.to_vec(), hashed_matrix("features", points, channels))
}

#[test]
fn a_cloud_is_cut_into_voxels_or_sampled_as_the_network_wants() {
    let mut cpu = Cpu::new();
    let voxels = model(description(Architecture::Minkunet(network()), 2, 3));
    let (points_m, features) = cloud("cloud", 50, 2);
    let cells = voxelise(0, &points_m, 0.005).unwrap();
    let batch = Batch::from_voxels(&voxels.graph, &cells, &features).unwrap();
    let expected = cpu.infer(&voxels.graph, &voxels.parameters, &batch).unwrap();
    assert_eq!(voxels.infer(&mut cpu, &points_m, &features).unwrap(), expected[0]);

    let points = model(description(Architecture::Pointnet2(PointNet2::single_scale(3, 6)), 3, 6));
    let (places, features) = cloud("points", 50, 3);
    let batch = Batch::from_points(&points.graph, &places, &[50], &features, Sampling::Farthest);
    let expected = cpu.infer(&points.graph, &points.parameters, &batch.unwrap()).unwrap();
    assert_eq!(points.infer(&mut cpu, &places, &features).unwrap(), expected[0]);
}

#[test]
fn clouds_of_a_batch_are_apart() {
    let mut cpu = Cpu::new();
    let voxels = model(description(Architecture::Minkunet(network()), 2, 3));
    let points = model(description(Architecture::Pointnet2(PointNet2::single_scale(2, 6)), 2, 6));
    for model in [voxels, points] {
        let [a, b] = [("a", 40), ("b", 60)].map(|(name, count)| cloud(name, count, 2));
        let batch = model.batch(&[(&a.0, &a.1), (&b.0, &b.1)]).unwrap();
        let both = cpu.infer(&model.graph, &model.parameters, &batch).unwrap();
        let mut apart = Vec::new();
        for (points, features) in [&a, &b] {
            apart.extend(model.infer(&mut cpu, points, features).unwrap().into_values());
        }
        assert_eq!(both[0].values(), apart);
    }
}

#[test]
fn clouds_that_do_not_fit_are_refused() {
    let model = model(description(Architecture::Minkunet(network()), 2, 3));
    let (points, features) = cloud("cloud", 5, 2);
    let refusal = |clouds: &[(&[[f32; 3]], &Matrix)]| model.batch(clouds).unwrap_err().to_string();
    let rows = refusal(&[(&points, &features), (&points[..4], &features)]);
    assert!(rows.contains("cloud 1: 5 rows of 2 features for 4 points"), "{rows}");
    let (_, wide) = cloud("cloud", 5, 3);
    assert!(refusal(&[(&points, &wide)]).contains("3 channels; the network takes 2"));
    assert!(refusal(&[(&points, &features), (&points, &wide)]).contains("cloud 1"));
    assert!(refusal(&[(&[], &Matrix::zeros(0, 2))]).contains("cloud 0"));
    refusal(&[]);
}

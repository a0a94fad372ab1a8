//! Weights in and out: completely, or an error that says which tensor.

use crate::fixtures::{hashed, parameters};
use eyebolt_net::models::{
    Architecture, MinkEncoder, MinkUNet, Model, ModelDescription, PointNet2,
};
use eyebolt_net::{Graph, weights};
use proptest::prelude::*;
use safetensors::Dtype;
use safetensors::tensor::TensorView;

fn network() -> MinkUNet {
    let mut net = MinkUNet::named("minkunet14a", 2, 3).unwrap();
    net.stem_channels = 3;
    net.channels = [3, 4, 4, 4, 4, 4, 4, 3];
    net
}

fn graph() -> Graph {
    network().graph().unwrap()
}

type Stored = (String, Dtype, Vec<usize>, Vec<u8>);

fn bytes(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// All parameters as tensors, to be changed before they are written.
fn stored(graph: &Graph) -> Vec<Stored> {
    let parameters = parameters(graph, |_, _, values| values.into_iter().map(f32::abs).collect());
    let pairs = graph.parameters().iter().zip(parameters.values());
    pairs
        .map(|(spec, values)| (spec.name.clone(), Dtype::F32, spec.shape.clone(), bytes(values)))
        .collect()
}

fn file(stored: &[Stored]) -> Vec<u8> {
    let views = stored.iter().map(|(name, dtype, shape, bytes)| {
        (name.as_str(), TensorView::new(*dtype, shape.clone(), bytes).unwrap())
    });
    safetensors::serialize(views, None).unwrap()
}

#[test]
fn what_is_written_is_read() {
    let graph = graph();
    let parameters = weights::from_bytes(&graph, &file(&stored(&graph))).unwrap();
    let written = weights::to_bytes(&graph, &parameters).unwrap();
    assert_eq!(weights::from_bytes(&graph, &written).unwrap(), parameters);
    assert_eq!(weights::to_bytes(&graph, &parameters).unwrap(), written);
}

#[test]
fn sixteen_bits_are_read() {
    let graph = graph();
    let exact = |values: &[f32]| values.iter().map(|value| (value * 8.0).round() / 8.0).collect();
    let mut stored = stored(&graph);
    let wanted: Vec<Vec<f32>> =
        graph.parameters().iter().map(|spec| exact(&hashed(&spec.name, spec.len()))).collect();
    for (place, (entry, values)) in stored.iter_mut().zip(&wanted).enumerate() {
        let values: Vec<f32> = values.iter().map(|value| value.abs()).collect();
        let half = |value: &f32| half::f16::from_f32(*value).to_le_bytes();
        let brain = |value: &f32| half::bf16::from_f32(*value).to_le_bytes();
        (entry.1, entry.3) = if place % 2 == 0 {
            (Dtype::F16, values.iter().flat_map(half).collect())
        } else {
            (Dtype::BF16, values.iter().flat_map(brain).collect())
        };
    }
    let parameters = weights::from_bytes(&graph, &file(&stored)).unwrap();
    for (found, wanted) in parameters.values().iter().zip(&wanted) {
        assert!(found.iter().zip(wanted).all(|(found, wanted)| *found == wanted.abs()));
    }
}

/// As MinkowskiEngine names and orders them.
fn minkowski(graph: &Graph) -> Vec<Stored> {
    let mut theirs = Vec::new();
    for (name, dtype, shape, bytes) in stored(graph) {
        let (layer, part) = name.rsplit_once('.').unwrap();
        let is_norm = part == "weight"
            || part.starts_with("running")
            || !(layer == "final" || part == "kernel");
        let name = if is_norm { format!("{layer}.bn.{part}") } else { name.clone() };
        let (shape, bytes) = match shape[..] {
            [1, inputs, outputs] => (vec![inputs, outputs], bytes),
            [channels] if !is_norm => (vec![1, channels], bytes),
            [volume, inputs, outputs] => {
                // Offset (x, y, z) lies at x + k y + k^2 z.
                let edge = (1..9).find(|edge| edge * edge * edge == volume).unwrap();
                let size = 4 * inputs * outputs;
                let mut turned = vec![0; bytes.len()];
                for (place, matrix) in bytes.chunks_exact(size).enumerate() {
                    let (x, y, z) = (place / edge / edge, place / edge % edge, place % edge);
                    let to = x + edge * y + edge * edge * z;
                    turned[to * size..][..size].copy_from_slice(matrix);
                }
                (shape, turned)
            }
            _ => (shape, bytes),
        };
        theirs.push((name, dtype, shape, bytes));
    }
    theirs.push(("bn0.bn.num_batches_tracked".into(), Dtype::I64, vec![], vec![0; 8]));
    theirs
}

#[test]
fn a_state_dict_of_minkowski_engine_is_ours_in_other_words() {
    let graph = graph();
    let theirs = minkowski(&graph);
    assert!(theirs.iter().any(|(name, ..)| name == "block1.0.norm1.bn.running_mean"));
    assert!(theirs.iter().any(|(name, ..)| name == "conv0p1s1.kernel"));
    let found = weights::from_minkowski(&graph, &file(&theirs)).unwrap();
    assert_eq!(found, weights::from_bytes(&graph, &file(&stored(&graph))).unwrap());
}

#[test]
fn what_does_not_belong_is_refused_by_name() {
    let graph = graph();
    let refusal = |change: &dyn Fn(&mut Vec<Stored>)| {
        let mut stored = stored(&graph);
        change(&mut stored);
        weights::from_bytes(&graph, &file(&stored)).unwrap_err().to_string()
    };
    let missing = refusal(&|stored| drop(stored.remove(0)));
    assert!(missing.contains("conv0p1s1.kernel: missing"), "{missing}");
    let more = refusal(&|stored| stored.push(("more".into(), Dtype::F32, vec![1], vec![0; 4])));
    assert!(more.contains("more: not of this network"), "{more}");
    let shape = refusal(&|stored| stored[1].2 = vec![3, 1]);
    assert!(shape.contains("bn0.weight: shape [3, 1], not Some([3])"), "{shape}");
    let kind = refusal(&|stored| stored[1].1 = Dtype::I32);
    assert!(kind.contains("bn0.weight: type I32"), "{kind}");
    let value = refusal(&|stored| stored[1].3[..4].copy_from_slice(&f32::NAN.to_le_bytes()));
    assert!(value.contains("bn0.weight: value 0 is NaN"), "{value}");
    let variance = refusal(&|stored| stored[4].3[..4].copy_from_slice(&(-1.0_f32).to_le_bytes()));
    assert!(variance.contains("bn0.running_var: a negative variance"), "{variance}");
}

proptest! {
    /// Headers that lie about sizes, bytes that are cut or changed.
    #[test]
    fn no_bytes_make_it_panic(
        cut in 0.0_f64..1.0,
        changes in prop::collection::vec((0.0_f64..1.0, any::<u8>()), 0..6),
    ) {
        let graph = graph();
        let mut bytes = file(&stored(&graph));
        let at = |share: f64, len: usize| (share * share * len as f64) as usize;
        for (place, value) in changes {
            let place = at(place, bytes.len());
            bytes[place] = value;
        }
        bytes.truncate(bytes.len() - at(cut, bytes.len() / 2));
        let _ = weights::from_bytes(&graph, &bytes);
        let _ = weights::from_minkowski(&graph, &bytes);
    }
}

#[test]
fn a_header_longer_than_the_file() {
    let graph = graph();
    let error = weights::from_bytes(&graph, &[0xff; 16]).unwrap_err().to_string();
    assert!(error.contains("weights.safetensors: header: no safetensors"), "{error}");
}

fn description(architecture: Architecture, features: usize) -> ModelDescription {
    ModelDescription {
        voxel_m: Some(0.005),
        features: (0..features).map(|index| format!("feature {index}")).collect(),
        classes: vec!["background".into(), "arm".into(), "end-effector".into()],
        frame: "camera".into(),
        trained_on: "nothing".into(),
        commit: "0".into(),
        metrics: [("accuracy".to_owned(), 0.5)].into(),
        architecture,
    }
}

#[test]
fn a_model_is_its_description_and_its_weights() {
    let points = Architecture::Pointnet2(PointNet2::multi_scale(3, 6));
    let mut encoder = MinkEncoder::named("minkunet14", 2, &[8, 4]).unwrap();
    encoder.channels = [3, 4, 4, 4];
    let encoder = Architecture::MinkunetRegression(encoder);
    for (architecture, features) in
        [(Architecture::Minkunet(network()), 2), (encoder, 2), (points, 3)]
    {
        let description = description(architecture, features);
        let text = description.to_toml().unwrap();
        let graph = description.architecture.graph().unwrap();
        let parameters = eyebolt_net::Parameters::initial(&graph, 3);
        let model = Model::load(&text, &weights::to_bytes(&graph, &parameters).unwrap()).unwrap();
        assert_eq!((model.description, model.parameters), (description, parameters));
    }
}

#[test]
fn descriptions_that_lie_are_refused() {
    let graph = graph();
    let parameters = eyebolt_net::Parameters::initial(&graph, 3);
    let bytes = weights::to_bytes(&graph, &parameters).unwrap();
    let text = description(Architecture::Minkunet(network()), 2).to_toml().unwrap();
    Model::load(&text, &bytes).unwrap();
    for (from, to, said) in [
        ("inputs = 2", "inputs = 4000000000000", "4000000000000 channels"),
        ("stem_kernel = 5", "stem_kernel = 4", "stem_kernel 4"),
        ("stem_kernel = 5", "stem_kernel = 3", "conv0p1s1.kernel: shape"),
        ("voxel_m = ", "voxel_m = -", "not a positive length"),
        ("frame = ", "frames = ", "frame"),
        ("\"feature 1\"", "", "1 names"),
    ] {
        assert!(text.contains(from), "{text}");
        let error = Model::load(&text.replace(from, to), &bytes).unwrap_err().to_string();
        assert!(error.contains(said), "{from} -> {to}: {error}");
    }
}

//! Weights in and out: completely, or an error that says which tensor.

use crate::fixtures::{hashed, parameters};
use eyebolt_net::models::MinkUNet;
use eyebolt_net::weights::Layout;
use eyebolt_net::{Graph, Parameters, weights};
use proptest::prelude::*;
use safetensors::Dtype;
use safetensors::tensor::TensorView;

pub fn network() -> MinkUNet {
    let mut net = MinkUNet::named("minkunet14a", 2, 3).unwrap();
    net.stem_channels = 3;
    net.channels = [3, 4, 4, 4, 4, 4, 4, 3];
    net
}

pub fn graph() -> Graph {
    network().graph().unwrap()
}

pub type Stored = (String, Dtype, Vec<usize>, Vec<u8>);

pub fn bytes(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// All parameters as tensors, to be changed before they are written.
pub fn stored(graph: &Graph) -> Vec<Stored> {
    let parameters = parameters(graph, |_, _, values| values.into_iter().map(f32::abs).collect());
    let pairs = graph.parameters().iter().zip(parameters.values());
    pairs
        .map(|(spec, values)| (spec.name.clone(), Dtype::F32, spec.shape.clone(), bytes(values)))
        .collect()
}

pub fn file(stored: &[Stored]) -> Vec<u8> {
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

#[test]
fn what_does_not_belong_is_refused_by_name() {
    let graph = graph();
    let refusal = |change: &dyn Fn(&mut Vec<Stored>)| {
        let mut stored = stored(&graph);
        change(&mut stored);
        weights::from_bytes(&graph, &file(&stored)).unwrap_err().to_string()
    };
    let missing = refusal(&|stored| drop(stored.remove(0)));
    assert!(missing.contains("conv0p1s1.kernel: missing; the file has nothing"), "{missing}");
    let more = refusal(&|stored| {
        stored.extend(["b", "more"].map(|name| (name.into(), Dtype::F32, vec![1], vec![0; 4])));
    });
    assert!(more.contains("b: not of this network, and neither are more"), "{more}");
    let shape = refusal(&|stored| stored[1].2 = vec![3, 1]);
    assert!(shape.contains("bn0.weight: shape [3, 1]; the network has [3]"), "{shape}");
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
        let mut parameters = Parameters::initial(&graph, 0);
        let before = parameters.clone();
        if weights::load_matching(&graph, &mut parameters, &bytes, Layout::Eyebolt).is_err() {
            prop_assert_eq!(parameters, before);
        }
    }
}

#[test]
fn a_header_longer_than_the_file() {
    let graph = graph();
    let error = weights::from_bytes(&graph, &[0xff; 16]).unwrap_err().to_string();
    assert!(error.contains("weights.safetensors: header: no safetensors"), "{error}");
}

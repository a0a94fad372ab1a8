//! State dicts of MinkowskiEngine, and what is said of names that do not fit.

use crate::weights::{Stored, file, graph, network, stored};
use eyebolt_net::models::{Head, MinkUNet};
use eyebolt_net::training::{Rule, Schedule, Trainer};
use eyebolt_net::weights::{self, Layout, load_matching};
use eyebolt_net::{Graph, Parameters};
use safetensors::Dtype;

/// With linear layers, one of them square.
fn with_head() -> Graph {
    let mut net = network();
    net.head = Head::Hidden(vec![5, 5]);
    net.graph().unwrap()
}

/// A matrix of numbers of four bytes.
fn transposed(bytes: &[u8], rows: usize, columns: usize) -> Vec<u8> {
    let at = |row, column| &bytes[4 * (row * columns + column)..][..4];
    (0..columns)
        .flat_map(|column| (0..rows).flat_map(move |row| at(row, column).to_vec()))
        .collect()
}

/// As MinkowskiEngine names and orders them.
fn minkowski(graph: &Graph) -> Vec<Stored> {
    let mut theirs = Vec::new();
    for (name, dtype, shape, bytes) in stored(graph) {
        let (layer, part) = name.rsplit_once('.').unwrap();
        let is_norm = part == "weight"
            || part.starts_with("running")
            || !(layer == "final" || part == "kernel");
        let is_linear = layer.starts_with("head.");
        let name = match (is_linear, is_norm) {
            (true, _) => format!("{layer}.linear.{part}"),
            (_, true) => format!("{layer}.bn.{part}"),
            _ => name.clone(),
        };
        let (shape, bytes) = match shape[..] {
            [inputs, outputs] => (vec![outputs, inputs], transposed(&bytes, inputs, outputs)),
            [channels] if is_linear => (vec![channels], bytes),
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
    for graph in [graph(), with_head()] {
        let theirs = minkowski(&graph);
        assert!(theirs.iter().any(|(name, ..)| name == "block1.0.norm1.bn.running_mean"));
        assert!(theirs.iter().any(|(name, ..)| name == "conv0p1s1.kernel"));
        let found = weights::from_minkowski(&graph, &file(&theirs)).unwrap();
        assert_eq!(found, weights::from_bytes(&graph, &file(&stored(&graph))).unwrap());
    }
}

#[test]
fn linear_layers_are_transposed_under_either_name() {
    let graph = with_head();
    let mut theirs = minkowski(&graph);
    let square = theirs.iter().find(|(name, ..)| name == "head.0.linear.weight").unwrap();
    assert_eq!(square.2, [5, 5]);
    for entry in &mut theirs {
        entry.0 = entry.0.replace(".linear.", ".");
    }
    let found = weights::from_minkowski(&graph, &file(&theirs)).unwrap();
    assert_eq!(found, weights::from_bytes(&graph, &file(&stored(&graph))).unwrap());
    // The other way round it is another layer's.
    theirs.iter_mut().find(|(name, ..)| name == "head.1.weight").unwrap().2.reverse();
    let error = weights::from_minkowski(&graph, &file(&theirs)).unwrap_err().to_string();
    assert!(error.ends_with("head.1.weight: shape [5, 3]; the network has [3, 5]"), "{error}");
}

#[test]
fn shapes_and_names_of_others_are_told_with_a_remedy() {
    let graph = graph();
    let (ours, theirs) = (stored(&graph), minkowski(&graph));
    let renamed = |stored: &[Stored], prefix: &str| {
        let mut stored = stored.to_vec();
        stored.iter_mut().for_each(|entry| entry.0.insert_str(0, prefix));
        file(&stored)
    };
    let said = |result: Result<Parameters, eyebolt_net::Error>| result.unwrap_err().to_string();
    let swapped = said(weights::from_bytes(&graph, &file(&theirs)));
    assert!(
        swapped.contains("bn0.weight: missing, as are bn0.bias, bn0.running_mean"),
        "{swapped}"
    );
    assert!(swapped.contains("there instead: block1.0.norm1.bn.bias, "), "{swapped}");
    assert!(swapped.ends_with("MinkowskiEngine's: use from_minkowski"), "{swapped}");
    let swapped = said(weights::from_minkowski(&graph, &file(&ours)));
    assert!(swapped.contains("bn0.bn.weight: missing"), "{swapped}");
    assert!(swapped.ends_with("eyebolt's own names: use from_bytes"), "{swapped}");
    let wrapped = said(weights::from_minkowski(&graph, &renamed(&theirs, "module.")));
    assert!(wrapped.contains("conv0p1s1.kernel: missing"), "{wrapped}");
    assert!(wrapped.contains("strip the prefix `module.`"), "{wrapped}");
    let mut other = theirs.clone();
    other.iter_mut().find(|(name, ..)| name == "final.kernel").unwrap().2 = vec![3, 1, 3];
    let shape = said(weights::from_minkowski(&graph, &file(&other)));
    let expected = "final.kernel: shape [3, 1, 3]; the network has [1, 3, 3] or [3, 3]";
    assert!(shape.ends_with(expected), "{shape}");
}

#[test]
fn of_a_checkpoint_parameters_are_told_not_the_optimisers_copies() {
    let cut = MinkUNet { layers: [1, 1, 1, 1, 1, 1, 1, 2], ..network() }.graph().unwrap();
    let trainer = Trainer::new(&cut, Rule::adam(0.0), Schedule::Constant { rate: 0.1 }, 0);
    let checkpoint = trainer.checkpoint(&cut).unwrap();
    let more = MinkUNet { layers: [1, 1, 1, 1, 1, 1, 2, 1], ..network() }.graph().unwrap();
    let resumed = Trainer::resume(&more, &checkpoint).unwrap_err().to_string();
    assert!(resumed.contains("block7.1.conv1.kernel: missing, as are block7.1.norm1"), "{resumed}");
    assert!(resumed.contains("there instead: block8.1.conv1.kernel, "), "{resumed}");
    assert!(resumed.ends_with(" and 7 more"), "{resumed}");
}

#[test]
fn what_matches_is_loaded_and_the_rest_is_told() {
    let graph = graph();
    let other = {
        let mut net = network();
        (net.outputs, net.stem_kernel) = (7, 3);
        net.layers[7] = 2;
        net.graph().unwrap()
    };
    for (layout, stored) in
        [(Layout::Eyebolt, stored(&graph)), (Layout::MinkowskiEngine, minkowski(&graph))]
    {
        let mut more = stored.clone();
        more.push(("more".into(), Dtype::I64, vec![], vec![0; 8]));
        let initial = Parameters::initial(&other, 5);
        let mut found = initial.clone();
        let matching = load_matching(&other, &mut found, &file(&more), layout).unwrap();
        let shapes: Vec<_> = matching.other_shape.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(shapes, ["conv0p1s1.kernel", "final.kernel", "final.bias"]);
        assert_eq!(matching.other_shape[0].in_file, [125, 2, 3]);
        assert_eq!(matching.other_shape[0].in_network, [27, 2, 3]);
        assert!(matching.missing.iter().all(|name| name.starts_with("block8.1.")));
        assert_eq!((matching.missing.len(), &matching.unexpected[..]), (10, &["more".into()][..]));
        let all = weights::from_bytes(&graph, &file(&self::stored(&graph))).unwrap();
        let places = |name: &str| graph.parameters().iter().position(|spec| spec.name == name);
        for (place, spec) in other.parameters().iter().enumerate() {
            let is_loaded = matching.loaded.contains(&spec.name);
            let expected = match places(&spec.name).filter(|_| is_loaded) {
                Some(theirs) => &all.values()[theirs],
                None => &initial.values()[place],
            };
            assert_eq!(&found.values()[place], expected, "{}", spec.name);
        }
        assert_eq!(matching.loaded.len() + 10 + 3, other.parameters().len());
    }
}

#[test]
fn what_matches_must_still_be_weights() {
    let graph = graph();
    let mut stored = stored(&graph);
    stored[7].3[..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let mut found = Parameters::initial(&graph, 5);
    let before = found.clone();
    let error = load_matching(&graph, &mut found, &file(&stored), Layout::Eyebolt).unwrap_err();
    assert!(error.to_string().ends_with("value 0 is inf"), "{error}");
    assert!(load_matching(&graph, &mut found, &[0; 20], Layout::Eyebolt).is_err());
    assert_eq!(found, before);
}

//! `model.toml`: which network, up to its graph.
#![no_main]

use eyebolt_net::models::ModelDescription;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(model) = ModelDescription::from_toml(text) else { return };
    let again = model.to_toml().expect("what was read can be written");
    assert!(ModelDescription::from_toml(&again).expect("its own text") == model);
    let Ok(graph) = model.graph() else { return };
    assert!(!graph.outputs().is_empty());
    assert!(graph.parameters().iter().all(|spec| !spec.name.is_empty()));
});

//! Weights as safetensors, state dicts of MinkowskiEngine and checkpoints, up to a run of the network.
#![no_main]

use eyebolt_fuzz::network;
use eyebolt_net::training::Trainer;
use eyebolt_net::{Batch, Cpu, Executor, Matrix, Parameters, weights};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let graph = network();
    if let Ok(trainer) = Trainer::resume(&graph, bytes) {
        let again = trainer.checkpoint(&graph).expect("its own graph");
        let resumed = Trainer::resume(&graph, &again).expect("its own checkpoint");
        assert!(resumed == trainer, "a checkpoint holds everything");
    }
    for layout in [weights::Layout::Eyebolt, weights::Layout::MinkowskiEngine] {
        let before = Parameters::initial(&graph, 1);
        let mut parameters = before.clone();
        match weights::load_matching(&graph, &mut parameters, bytes, layout) {
            Ok(matching) => assert!(matching.loaded.is_empty() || matching.missing.len() < 8),
            Err(_) => assert!(parameters == before, "an error changes nothing"),
        }
    }
    for read in [weights::from_bytes, weights::from_minkowski] {
        let Ok(parameters) = read(&graph, bytes) else { continue };
        let again = weights::to_bytes(&graph, &parameters).expect("its own graph");
        let back = weights::from_bytes(&graph, &again).expect("its own bytes");
        assert!(back == parameters, "bytes hold everything");
        let cells = [[0, 0, 0, 0], [0, 0, 0, 1], [1, 3, 2, 1]];
        let features = Matrix::new(3, 1, vec![1.0, -2.0, 0.5]).expect("three values");
        let batch = Batch::from_voxels(&graph, &cells, &features).expect("three voxels");
        // Weights may be so large that outputs are not finite, which is an error.
        let Ok(outputs) = Cpu::new().infer(&graph, &parameters, &batch) else { continue };
        assert_eq!((outputs[0].rows(), outputs[0].channels()), (3, 1));
    }
});

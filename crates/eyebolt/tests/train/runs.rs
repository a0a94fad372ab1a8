//! Runs that end before their end, and on other numbers of threads.

use crate::small::{Memory, Until, lesson, plan, small_net};
use eyebolt::train::{Beginning, Plan, TrainError, teach};
use rayon::ThreadPoolBuilder;

/// Killed at any moment, a run goes on from its last checkpoint to the same bytes.
#[test]
fn a_run_that_was_ended_comes_to_the_same_bytes() {
    let (lesson, plan) = (lesson(), plan(12, 3));
    let mut whole = Memory::default();
    let model = teach(&lesson, &plan, Beginning::Anew, &mut whole, &Until(usize::MAX)).unwrap();
    for end in [4, 8] {
        let mut first = Memory::default();
        let ended = teach(&lesson, &plan, Beginning::Anew, &mut first, &Until(end));
        assert!(matches!(ended, Err(TrainError::Cancelled(_))));
        let kept = first.checkpoints.last().unwrap();
        let mut rest = Memory::default();
        let again =
            teach(&lesson, &plan, Beginning::Checkpoint(kept), &mut rest, &Until(usize::MAX))
                .unwrap();
        assert_eq!(again.save().unwrap(), model.save().unwrap());
        assert_eq!(rest.checkpoints.last(), whole.checkpoints.last());
    }
}

#[test]
fn threads_change_nothing() {
    let (lesson, plan) = (lesson(), plan(6, 3));
    let on = |threads: usize, feeding: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let plan = Plan { threads: feeding, ..plan };
        let mut keep = Memory::default();
        pool.install(|| teach(&lesson, &plan, Beginning::Anew, &mut keep, &Until(usize::MAX)))
            .unwrap();
        keep.checkpoints
    };
    let one = on(1, 1);
    assert_eq!(one, on(3, 1));
    assert_eq!(one, on(2, 3));
}

#[test]
fn checkpoints_of_other_runs_and_cut_ones_are_refused() {
    let (lesson, plan) = (lesson(), plan(2, 2));
    let mut keep = Memory::default();
    teach(&lesson, &plan, Beginning::Anew, &mut keep, &Until(usize::MAX)).unwrap();
    let bytes = keep.checkpoints.last().unwrap();
    let refusal = |bytes: &[u8], plan: &Plan| {
        let again = teach(
            &lesson,
            plan,
            Beginning::Checkpoint(bytes),
            &mut Memory::default(),
            &Until(usize::MAX),
        );
        again.unwrap_err().to_string()
    };
    let other = refusal(bytes, &Plan { seed: 8, ..plan });
    assert!(other.contains("seed 7") && other.contains("begin anew"), "{other}");
    for end in [0, 7, 24, 200, bytes.len() - 1] {
        let cut = refusal(&bytes[..end], &plan);
        assert!(cut.contains("checkpoint") || cut.contains("cut"), "{end}: {cut}");
    }
    let longer = [bytes.as_slice(), &[0]].concat();
    assert!(refusal(&longer, &plan).contains("after its end"));
}

/// A network with another number of classes takes all but its head.
#[test]
fn weights_of_another_network_are_a_beginning() {
    let (lesson, plan) = (lesson(), plan(2, 2));
    let mut keep = Memory::default();
    let model = teach(&lesson, &plan, Beginning::Anew, &mut keep, &Until(usize::MAX)).unwrap();
    let (_, bytes) = model.save().unwrap();
    let mut two = small_net(2);
    two.validation = 4;
    let begin = Beginning::Weights(&bytes);
    let from = teach(&two, &plan, begin, &mut Memory::default(), &Until(usize::MAX)).unwrap();
    let anew =
        teach(&two, &plan, Beginning::Anew, &mut Memory::default(), &Until(usize::MAX)).unwrap();
    assert_ne!(from.save().unwrap(), anew.save().unwrap());
    let stem = |model: &eyebolt_net::models::Model| model.parameters.values()[0].clone();
    let moved =
        |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(moved(&stem(&from), &stem(&model)) < moved(&stem(&anew), &stem(&model)) + 0.05);
    let other = Beginning::Weights(b"nothing of the kind");
    assert!(teach(&two, &plan, other, &mut Memory::default(), &Until(usize::MAX)).is_err());
}

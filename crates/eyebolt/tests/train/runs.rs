//! Runs that end before their end, and on other numbers of threads.

use crate::small::{Memory, Until, lesson, plan};
use eyebolt::train::{Plan, TrainError, teach};
use rayon::ThreadPoolBuilder;

/// Killed at any moment, a run goes on from its last checkpoint to the same bytes.
#[test]
fn a_run_that_was_ended_comes_to_the_same_bytes() {
    let (lesson, plan) = (lesson(), plan(12, 3));
    let mut whole = Memory::default();
    let model = teach(&lesson, &plan, None, &mut whole, &Until(usize::MAX)).unwrap();
    for end in [4, 8] {
        let mut first = Memory::default();
        let ended = teach(&lesson, &plan, None, &mut first, &Until(end));
        assert!(matches!(ended, Err(TrainError::Cancelled(_))));
        let kept = first.checkpoints.last().unwrap();
        let mut rest = Memory::default();
        let again = teach(&lesson, &plan, Some(kept), &mut rest, &Until(usize::MAX)).unwrap();
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
        pool.install(|| teach(&lesson, &plan, None, &mut keep, &Until(usize::MAX))).unwrap();
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
    teach(&lesson, &plan, None, &mut keep, &Until(usize::MAX)).unwrap();
    let bytes = keep.checkpoints.last().unwrap();
    let refusal = |bytes: &[u8], plan: &Plan| {
        let again = teach(&lesson, plan, Some(bytes), &mut Memory::default(), &Until(usize::MAX));
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

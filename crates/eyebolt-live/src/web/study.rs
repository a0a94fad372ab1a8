//! What follows from an answer, for the page.

use super::board::Board;
use super::coverage::Coverage;
use super::drawing::Drawing;
use super::next::Next;
use eyebolt::pipeline::Outcome;
use eyebolt::plan::MovableArm;
use eyebolt_registration::LinkCache;
use eyebolt_robot::{Arm, JointPositions};
use std::sync::Arc;

/// An answer with what it was made from.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The answer.
    pub outcome: Outcome,
    /// The arm.
    pub arm: Arm,
    /// Where its joints are now, and all others.
    pub joints: JointPositions,
    /// Where shapes of links are kept between runs.
    pub cache: LinkCache,
    /// Of all random choices.
    pub seed: u64,
}

/// Puts on the board what follows from `finding`: what was seen of the arm, where the arm is to be drawn, and what to record
/// next, each as soon as it is known. The last takes seconds.
pub fn study(board: &Board, finding: &Finding) {
    let Finding { outcome, arm, joints, cache, seed } = finding;
    board.update(|account| account.coverage = Coverage::of(outcome));
    let arm = match MovableArm::new(arm, joints, cache) {
        Ok(arm) => Arc::new(arm),
        Err(error) => {
            return board.update(|account| account.next = Some(Next::none(error.to_string())));
        }
    };
    let parts = outcome.observations.as_ref().zip(outcome.calibration.refinement.as_ref());
    let drawing = parts.map(|(observations, refinement)| {
        Drawing::new(Arc::clone(&arm), &observations.camera, refinement.end())
    });
    board.draw(drawing.clone());
    let (next, positions) = Next::plan(outcome, &arm, joints, *seed);
    if let Some((drawing, positions)) = drawing.zip(positions) {
        board.draw(Some(drawing.with_ghost(&positions)));
    }
    board.update(|account| account.next = Some(next));
}

//! What a network that knows arms in general says of an image, beside one that knows one arm.

use super::error::SegmentError;
use super::features::FEATURES;
use super::grid::Grid;
use super::thinned::Thinned;
use eyebolt_net::models::Model;
use eyebolt_net::{Cpu, Executor, Matrix};

/// A network that knows arms in general, asked beside one that knows one of them.
///
/// The one knows its base and its links, and loses what it never saw so: near the camera, with a tool, in noise. The other
/// never saw this arm. Each says hardly anything of an arm where there is none, so that a pixel is as likely of the arm as the one of
/// them says that is surer of it.
#[derive(Debug)]
pub(super) struct SecondOpinion {
    model: Model,
    executor: Cpu,
}

impl SecondOpinion {
    /// Of a network that tells an arm from the rest; `None` if it sees images otherwise than in the cells of `grid`.
    pub fn new(model: Model, grid: Grid) -> Option<Self> {
        let about = &model.description;
        let is_alike = Grid::of(about) == Some(grid) && about.features == FEATURES;
        let is_one = is_alike && about.classes == ["background", "arm"];
        is_one.then(|| Self { model, executor: Cpu::new() })
    }

    /// Raises in `logits`, of which each row is of a pixel of `image` with depth and begins with the background's, the odds of
    /// all else to those of the arm here; which part of the arm it is stays as it was.
    pub fn raise(
        &mut self,
        grid: Grid,
        image: &Thinned,
        logits: &mut Matrix,
    ) -> Result<(), SegmentError> {
        let Model { graph, parameters, .. } = &self.model;
        let batch = grid.batch(graph, &[image])?;
        let own = self.executor.infer(graph, parameters, &batch)?.swap_remove(0);
        let classes = logits.channels();
        for (row, logits) in logits.values_mut().chunks_exact_mut(classes).enumerate() {
            let by = log_odds(own.row(row)) - log_odds(logits);
            if by > 0.0 {
                logits.iter_mut().skip(1).for_each(|logit| *logit += by);
            }
        }
        Ok(())
    }
}

/// Logarithm of how much likelier all other classes together are than the first.
fn log_odds(logits: &[f32]) -> f32 {
    let [first, others @ ..] = logits else { return 0.0 };
    let most = others.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    most + others.iter().map(|logit| (logit - most).exp()).sum::<f32>().ln() - first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odds_are_those_of_the_softmax() {
        let logits = [0.3_f32, -1.0, 2.0];
        let total: f32 = logits.iter().map(|logit| logit.exp()).sum();
        let first = logits[0].exp() / total;
        assert!((log_odds(&logits) - ((1.0 - first) / first).ln()).abs() < 1e-6);
    }
}

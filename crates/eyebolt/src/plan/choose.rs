//! The candidates that together tell most.

use super::candidates::Candidate;
use super::gain::Measured;
use crate::calibrate::Deviation;
use eyebolt_registration::PredictedInformation;
use rayon::prelude::*;

/// Which configurations are good together: by each camera that may be the one, what is known before and where errors are
/// measured.
pub(super) struct Design {
    pub(super) known: Vec<PredictedInformation>,
    pub(super) measured: Vec<Measured>,
}

/// Times that each chosen one may be exchanged.
const SWEEPS: usize = 4;
/// An exchange that gains less than this part is none.
const GAIN: f64 = 1e-3;

impl Design {
    /// What is known after the configurations that tell `information`, each by each camera.
    pub(super) fn after<'c>(
        &self,
        chosen: impl Iterator<Item = &'c Candidate>,
    ) -> Vec<PredictedInformation> {
        let mut sums = self.known.clone();
        for candidate in chosen {
            add(&mut sums, candidate, 1.0);
        }
        sums
    }

    /// Error to expect by `sums`, as root mean squares over the cameras, times `scale`.
    pub(super) fn expected(&self, sums: &[PredictedInformation], scale: [f64; 2]) -> Deviation {
        let each = sums.iter().zip(&self.measured).map(|(sum, at)| at.expected(sum));
        let each: Vec<Deviation> = each.collect();
        let mean = |part: &dyn Fn(&Deviation) -> f64| {
            (each.iter().map(|one| part(one).powi(2)).sum::<f64>() / each.len().max(1) as f64)
                .sqrt()
        };
        Deviation {
            translation_m: scale[0] * mean(&|one| one.translation_m),
            rotation_rad: scale[1] * mean(&|one| one.rotation_rad),
        }
    }

    /// What is made small: the logarithm of the squared error to expect, on average over the cameras.
    pub(super) fn cost(&self, sums: &[PredictedInformation]) -> f64 {
        let costs = sums.iter().zip(&self.measured).map(|(sum, at)| at.cost(sum).ln());
        costs.sum::<f64>() / sums.len().max(1) as f64
    }

    /// Places of up to `count` of `candidates`: one after the other that which gains most, then exchanges of one for
    /// another while that gains (Fedorov, Theory of Optimal Experiments, 1972). None of `excluded` is taken.
    pub(super) fn choose(
        &self,
        candidates: &[Candidate],
        count: usize,
        excluded: &[bool],
    ) -> Vec<usize> {
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < count {
            let sums = self.after(chosen.iter().map(|place| &candidates[*place]));
            let Some((place, _)) = self.best(candidates, &sums, &chosen, excluded) else { break };
            chosen.push(place);
        }
        for _ in 0..SWEEPS {
            let mut changed = false;
            for turn in 0..chosen.len() {
                let others = chosen.iter().enumerate().filter(|(place, _)| *place != turn);
                let sums = self.after(others.map(|(_, place)| &candidates[*place]));
                let mut with_own = sums.clone();
                add(&mut with_own, &candidates[chosen[turn]], 1.0);
                let own = self.cost(&with_own);
                match self.best(candidates, &sums, &chosen, excluded) {
                    Some((place, cost)) if cost < own - GAIN => {
                        chosen[turn] = place;
                        changed = true;
                    }
                    _ => {}
                }
            }
            if !changed {
                break;
            }
        }
        chosen
    }

    /// The candidate, none of `chosen`, that makes the cost least with what `sums` say; and that cost.
    fn best(
        &self,
        candidates: &[Candidate],
        sums: &[PredictedInformation],
        chosen: &[usize],
        excluded: &[bool],
    ) -> Option<(usize, f64)> {
        let may =
            |place: &usize| !chosen.contains(place) && !excluded.get(*place).is_some_and(|e| *e);
        let costs = (0..candidates.len()).into_par_iter().filter(may).map(|place| {
            let mut with = sums.to_vec();
            add(&mut with, &candidates[place], 1.0);
            (place, self.cost(&with))
        });
        let costs: Vec<(usize, f64)> = costs.collect();
        costs.into_iter().filter(|(_, cost)| cost.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

fn add(sums: &mut [PredictedInformation], candidate: &Candidate, factor: f64) {
    for (sum, own) in sums.iter_mut().zip(&candidate.information) {
        *sum += own * factor;
    }
}

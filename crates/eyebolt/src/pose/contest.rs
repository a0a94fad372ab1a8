//! Hypotheses against each other.

use super::comparison::Comparison;
use super::hypotheses::PoseHypothesis;
use super::judge::Judge;
use super::judged::{Judged, keep_distinct, refined};
use super::observed::Observed;
use super::shape::EndEffectorShape;
use super::smooth::SmoothSurface;
use eyebolt_registration::{IcpOptions, Posture};
use nalgebra::Point3;
use rayon::prelude::*;

/// What hypotheses are held against.
#[derive(Clone, Copy)]
pub struct Contest<'a> {
    /// The end-effector.
    pub shape: &'a EndEffectorShape,
    /// What was seen of it.
    pub observed: &'a Observed,
    /// Openings of its fingers, at least one; the first one until the last round.
    pub openings: &'a [Posture],
}

/// Points of the first round, which is only to tell hypotheses apart.
const FEW: usize = 300;
/// Hypotheses of the second round, and those of them whose fingers are opened and closed.
const FINALISTS: usize = 4;
const OPENED: usize = 2;
/// From centimetres and a dozen degrees on, by few points.
const FIRST: IcpOptions = IcpOptions { first_scale_m: 0.03, least_scale_m: 0.004, most_steps: 15 };

/// Poses are told apart by residuals of so many times the deviation of the best one: labels and shapes are not exact.
const MEASURE: f64 = 1.5;

/// Standard deviation of the depth where the best of `judged` lies, metres.
fn measure_m(judged: &[Judged]) -> f64 {
    let least = judged.iter().map(|it| it.fit.deviation_m).fold(f64::INFINITY, f64::min);
    least.max(0.5 * Contest::LAST.least_scale_m)
}

impl Contest<'_> {
    /// On from there.
    pub const LAST: IcpOptions =
        IcpOptions { first_scale_m: 0.01, least_scale_m: 0.002, most_steps: 30 };

    /// The best of `hypotheses`, refined, best first; no two are the same pose.
    pub fn ranked(&self, hypotheses: Vec<PoseHypothesis>) -> Vec<Judged> {
        let points = &self.observed.points;
        let step = points.len().div_ceil(FEW).max(1);
        let few: Vec<Point3<f32>> = points.iter().step_by(step).copied().collect();
        let mut judged = self.round(hypotheses.into_iter().map(|it| (it, 0)), &few, FIRST);
        keep_distinct(self.shape, &mut judged, FINALISTS);
        let again = |it: &Judged| PoseHypothesis { pose: it.fit.camera_from_base, ..it.hypothesis };
        let entries = judged.iter().map(|it| (again(it), 0));
        let mut judged = self.round(entries, points, Self::LAST);
        self.by_one_measure(&mut judged);
        keep_distinct(self.shape, &mut judged, FINALISTS);
        let opened = judged.iter().take(OPENED).flat_map(|it| {
            let hypothesis = again(it);
            (1..self.openings.len()).map(move |opening| (hypothesis, opening))
        });
        let opened = self.round(opened.collect::<Vec<_>>().into_iter(), points, Self::LAST);
        judged.extend(opened);
        self.by_one_measure(&mut judged);
        keep_distinct(self.shape, &mut judged, FINALISTS);
        self.look_closely(&mut judged);
        judged
    }

    /// Hypotheses with the numbers of their openings, each by itself.
    fn round(
        &self,
        entries: impl Iterator<Item = (PoseHypothesis, usize)>,
        points: &[Point3<f32>],
        options: IcpOptions,
    ) -> Vec<Judged> {
        let entries: Vec<_> = entries.collect();
        let judge = || Judge::new(self.shape, self.observed);
        let judged = entries.into_par_iter().map_init(judge, |judge, (hypothesis, opening)| {
            let posture = (&self.openings[opening], opening);
            refined(judge, self.shape, posture, points, hypothesis, options)
        });
        judged.collect()
    }

    /// By how much the frame speaks for the first of `judged` against each of the others.
    pub fn comparisons(&self, judged: &[Judged]) -> Vec<Comparison> {
        let Some((best, others)) = judged.split_first() else { return Vec::new() };
        let mut judge = Judge::new(self.shape, self.observed);
        let deviation_m = MEASURE * measure_m(judged);
        let between = |other: &Judged| {
            let [first, second] =
                [best, other].map(|it| (&self.openings[it.opening], &it.fit.camera_from_base));
            Comparison::between(&mut judge, first, second, deviation_m)
        };
        others.iter().map(between).collect()
    }

    /// By how much the frame speaks for the best of `judged` against a smooth surface that is no end-effector.
    pub fn against_smooth(&self, best: &Judged) -> Option<Comparison> {
        let smooth = SmoothSurface::fit(self.observed)?;
        let deviation_m = best.fit.deviation_m.min(smooth.deviation_m);
        let deviation_m = MEASURE * deviation_m.max(0.5 * Contest::LAST.least_scale_m);
        let mut judge = Judge::new(self.shape, self.observed);
        let pose = (&self.openings[best.opening], &best.fit.camera_from_base);
        Some(Comparison::with_smooth(&mut judge, pose, &smooth, deviation_m))
    }

    /// At the best of `judged`, whose place does not depend on it.
    fn look_closely(&self, judged: &mut [Judged]) {
        let deviation_m = MEASURE * measure_m(judged);
        let Some(best) = judged.first_mut() else { return };
        let mut judge = Judge::new(self.shape, self.observed);
        let pose = &best.fit.camera_from_base;
        best.support = judge.close_support(&self.openings[best.opening], pose, deviation_m);
    }

    /// Judges all by the deviation of the one that fits best.
    fn by_one_measure(&self, judged: &mut [Judged]) {
        let deviation_m = measure_m(judged);
        let judge = || Judge::new(self.shape, self.observed);
        judged.par_iter_mut().for_each_init(judge, |judge, it| {
            let posture = &self.openings[it.opening];
            it.support = judge.support(posture, &it.fit.camera_from_base, MEASURE * deviation_m);
        });
    }
}

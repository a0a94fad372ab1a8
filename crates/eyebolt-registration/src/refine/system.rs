//! The linearised problem of one step: ARCHITECTURE.md, (5) and (6).
//!
//! Factors are summed once, for each view, link and kind of evidence apart. All that is asked of
//! them later - the step, priors of other widths, scores of clusters, the problem without a view -
//! follows from these sums.

use super::clusters::Cluster;
use super::gather::ViewFactors;
use super::start::Trust;
use crate::evidence::KINDS;
use crate::normal_equations::NormalEquations;
use crate::robust::{geman_mcclure, geman_mcclure_curvature};
use crate::unknowns::{EVIDENCE_KINDS, UNKNOWNS};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Normal equations of all unknowns.
pub(super) type Sum = NormalEquations<UNKNOWNS>;

/// What remains of a kind of evidence that is not trusted: enough to determine the pose.
const DISTRUSTED: f64 = 0.01;

/// What a residual's square counts in the matrix of the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Matrix {
    /// Its robust weight: steps that always descend (iteratively reweighted least squares).
    Reweighted,
    /// The second derivative of its robust loss, which also sees that weights change with the
    /// residual (Newton).
    Curvature,
}

/// How residuals are weighed in one step, by kind of evidence.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    /// Scales of the robust kernels.
    pub scales: [f64; EVIDENCE_KINDS],
    /// Standard deviations of the residuals.
    pub deviations: [f64; EVIDENCE_KINDS],
    pub trust: Trust,
}

/// Sums of all factors, without priors.
pub(super) struct System<'a> {
    clusters: &'a [Vec<Cluster>],
    /// By view, link and kind; those of one cluster add up to the weight of one view.
    sums: Vec<Vec<[Sum; EVIDENCE_KINDS]>>,
    /// Whether outlines are those of masks.
    pub masked: bool,
}

impl<'a> System<'a> {
    /// Sums the factors of each view.
    pub fn new(
        gathered: &[ViewFactors],
        clusters: &'a [Vec<Cluster>],
        weights: &Weights,
        matrix: Matrix,
    ) -> Self {
        let views = gathered.par_iter().zip(clusters);
        let sums = views.map(|(view, clusters)| {
            let mut sums = vec![<[Sum; EVIDENCE_KINDS]>::default(); clusters.len()];
            for kind in 0..EVIDENCE_KINDS {
                add_kind(view, kind, weights, matrix, &mut sums);
            }
            for (link, cluster) in sums.iter_mut().zip(clusters) {
                let share = (cluster.views as f64).recip();
                link.iter_mut().for_each(|sum| {
                    sum.mirror();
                    sum.scale(share);
                });
            }
            sums
        });
        let masked = gathered.iter().any(|view| view.masked);
        Self { clusters, sums: sums.collect(), masked }
    }

    /// The sum of all views, in their order.
    pub fn total(&self) -> Sum {
        let mut total = Sum::default();
        for sum in self.sums.iter().flatten().flatten() {
            total.add_all(sum);
        }
        total
    }

    /// The sum of one kind of evidence.
    pub fn total_of_kind(&self, kind: usize) -> Sum {
        let mut total = Sum::default();
        for sums in self.sums.iter().flatten() {
            total.add_all(&sums[kind]);
        }
        total
    }

    /// The sum of one view.
    pub fn total_of(&self, view: usize) -> Sum {
        let mut total = Sum::default();
        for sum in self.sums[view].iter().flatten() {
            total.add_all(sum);
        }
        total
    }

    /// The sum of all views but those `left_out`; the rest of a cluster then counts as much as the
    /// whole did. `total` and `cluster_totals` are those of this system.
    pub fn total_without(&self, left_out: &[usize], total: &Sum, cluster_totals: &[Sum]) -> Sum {
        let mut rest = total.clone();
        // Of each cluster that others are in too: how many of its views go, how many there are, and
        // what goes with them.
        let mut thinned: BTreeMap<usize, (usize, usize, Sum)> = BTreeMap::new();
        for view in left_out {
            for (cluster, sums) in self.clusters[*view].iter().zip(&self.sums[*view]) {
                sums.iter().for_each(|sum| rest.subtract_all(sum));
                if cluster.views > 1 {
                    let known = thinned.entry(cluster.number);
                    let (gone, _, sum) = known.or_insert((0, cluster.views, Sum::default()));
                    *gone += 1;
                    sums.iter().for_each(|own| sum.add_all(own));
                }
            }
        }
        for (number, (gone, views, sum)) in &thinned {
            // Of `n` views `k` left out: the others count `n / (n - k)` times as much.
            let left = views - gone;
            if left > 0 {
                let more = *gone as f64 / left as f64;
                rest.add_scaled(&cluster_totals[*number], more);
                rest.add_scaled(sum, -more);
            }
        }
        rest
    }

    /// The sums of each cluster, all kinds of evidence together.
    pub fn cluster_totals(&self) -> Vec<Sum> {
        let by_kind = self.by_cluster();
        let of_all = |kinds: &[Sum]| {
            let mut total = Sum::default();
            kinds.iter().for_each(|sum| total.add_all(sum));
            total
        };
        by_kind.chunks(EVIDENCE_KINDS).map(of_all).collect()
    }

    /// The sums of each cluster and kind of evidence.
    pub fn by_cluster(&self) -> Vec<Sum> {
        let numbers = self.clusters.iter().flatten().map(|cluster| cluster.number + 1);
        let mut found = vec![Sum::default(); EVIDENCE_KINDS * numbers.max().unwrap_or(0)];
        for (clusters, sums) in self.clusters.iter().zip(&self.sums) {
            for (cluster, sums) in clusters.iter().zip(sums) {
                for (kind, sum) in sums.iter().enumerate() {
                    found[EVIDENCE_KINDS * cluster.number + kind].add_all(sum);
                }
            }
        }
        found
    }
}

fn add_kind(
    view: &ViewFactors,
    kind: usize,
    weights: &Weights,
    matrix: Matrix,
    sums: &mut [[Sum; EVIDENCE_KINDS]],
) {
    let trusted = match weights.trust {
        Trust::Only(other) if other != kind => DISTRUSTED,
        _ => 1.0,
    };
    // Correlated samples count as one.
    let independent = (view.samples[kind] / KINDS[kind].correlated_samples()).min(1.0);
    let all = trusted * independent / weights.deviations[kind].powi(2);
    let scale = weights.scales[kind];
    for factor in &view.factors[kind] {
        let weight = all * geman_mcclure(factor.residual, scale);
        let sum = &mut sums[factor.link][kind];
        let curvature = match matrix {
            Matrix::Reweighted => weight,
            Matrix::Curvature => all * geman_mcclure_curvature(factor.residual, scale),
        };
        sum.add_lower(&factor.jacobian, factor.residual, weight, curvature);
    }
}

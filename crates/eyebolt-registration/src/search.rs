//! A start from nothing: where the base may be, over all rotations and translations.
//!
//! Rotations spread over SO(3), each with the translation that lays the visible side of the arm
//! on the points seen; every one is polished on a coarse distance field of the whole arm, the best
//! are polished further with all points, and what the camera saw through counts against them.

use crate::arm::{ArmModel, Posture};
use crate::distance_field::{DistanceField, bounded_grid};
use crate::normal_equations::NormalEquations;
use crate::robust::geman_mcclure;
use crate::rotations::spread_rotations;
use crate::surface_sample::SurfacePoint;
use crate::view::{Consistency, View};
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::{Isometry3, Matrix6, Point3, Translation3, UnitQuaternion, Vector3};
use rayon::prelude::*;

/// One configuration in the search.
#[derive(Clone, Debug)]
pub struct SearchView<'a> {
    /// What was seen, and the arm's configuration.
    pub view: View<'a>,
    /// Points that are on the arm, or most of them: camera frame, metres.
    pub arm_points: Vec<Point3<f32>>,
    /// Middles of the patches that these points form, and of all of them: the arm is one of these, or
    /// near it.
    pub middles: Vec<Point3<f32>>,
    /// The part of the arm's surface that `arm_points` came from, base frame.
    pub surface: Vec<SurfacePoint>,
}

/// A pose that the search found.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// The pose.
    pub camera_from_base: Transform<Camera, Base>,
    /// Mean distance of the points seen from the arm, capped, metres.
    pub distance_m: f64,
    /// Share of the arm's surface that the views contradict, of what they can judge.
    pub contradicted: f64,
}

impl Candidate {
    /// What the search minimises: metres, with one cap's worth for a wholly contradicted arm.
    pub fn score(&self) -> f64 {
        self.distance_m + CAP_M * self.contradicted
    }
}

/// What is farther than this from the arm is wrong, no matter how far: a link's thickness.
const CAP_M: f64 = 0.10;
/// Rotations tried: one within about 14 degrees of any.
const ROTATIONS: usize = 4000;
/// How many starts are looked at more closely.
const HOPEFUL: usize = 1000;
/// How many of these are polished with all points, and with which scales.
const POLISHED: usize = 120;
/// From the spacing of the starts to what a coarse field tells.
const POLISH: [f64; 8] = [0.10, 0.08, 0.06, 0.05, 0.04, 0.03, 0.03, 0.03];
/// Half of what a pose has to be right to for the refinement to take over.
const COARSE_VOXEL_M: f32 = 0.03;
/// Starts are off by about this: farther away, distances need not be exact.
const COARSE_MARGIN_M: f32 = 0.15;
/// Farther away, all is as far.
const LARGEST_M: f32 = 2.0;
/// Grid points of the coarse field of one configuration; a sliding joint may put links far apart.
const MOST_COARSE_POINTS: usize = 2_000_000;

/// Poses of the base that explain the views, best first, each at least 10 degrees or 10 cm from
/// the ones before it; at most `wanted`. `seed` turns the rotations tried.
///
/// Empty if there are no views or a view has no points.
pub fn search(
    arm: &ArmModel,
    views: &[SearchView<'_>],
    seed: u64,
    wanted: usize,
) -> Vec<Candidate> {
    let is_empty = |view: &SearchView<'_>| {
        view.arm_points.is_empty() || view.middles.is_empty() || view.surface.is_empty()
    };
    if views.is_empty() || views.iter().any(is_empty) {
        return Vec::new();
    }
    let fields: Vec<DistanceField> =
        views.par_iter().map(|view| whole_arm(arm, view.view.posture)).collect();
    let few: Vec<Problem<'_>> = problems(views, &fields, 24, 40);
    let many: Vec<Problem<'_>> = problems(views, &fields, 200, 120);
    let starts = spread_rotations(ROTATIONS, seed);
    let starts: Vec<Isometry3<f64>> =
        starts.par_iter().map(|rotation| start_translation(&few, rotation)).collect();
    // Most starts are hopeless, which two steps are enough to tell.
    let starts = best(&few, &starts, &[0.20, 0.15], HOPEFUL);
    let starts = best(&few, &poses(&starts), &[0.12, 0.10, 0.08], HOPEFUL);
    let starts = distinct(&starts, POLISHED, 0.05, 6f64.to_radians());
    let polished = best(&many, &poses(&starts), &POLISH, POLISHED);
    distinct(&polished, wanted, 0.10, 10f64.to_radians())
}

/// The `count` best of `starts` after one step of least squares for each of `scales`, best first.
fn best(
    problems: &[Problem<'_>],
    starts: &[Isometry3<f64>],
    scales: &[f64],
    count: usize,
) -> Vec<Candidate> {
    let mut found: Vec<Candidate> =
        starts.par_iter().map(|start| judge(problems, polish(problems, *start, scales))).collect();
    found.sort_by(|a, b| a.score().total_cmp(&b.score()));
    found.truncate(count);
    found
}

fn poses(candidates: &[Candidate]) -> Vec<Isometry3<f64>> {
    candidates.iter().map(|candidate| *candidate.camera_from_base.inverse().isometry()).collect()
}

fn distinct(sorted: &[Candidate], wanted: usize, apart_m: f64, apart_rad: f64) -> Vec<Candidate> {
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in sorted {
        if kept.len() == wanted {
            break;
        }
        let near = kept.iter().any(|other| {
            let (metres, radians) = candidate.camera_from_base.distance_to(&other.camera_from_base);
            metres < apart_m && radians < apart_rad
        });
        if !near {
            kept.push(*candidate);
        }
    }
    kept
}

/// The distance to the whole arm in one configuration, base frame, on a coarse grid.
fn whole_arm(arm: &ArmModel, posture: &Posture) -> DistanceField {
    let mut low = Point3::from(Vector3::repeat(f32::INFINITY));
    let mut high = Point3::from(Vector3::repeat(f32::NEG_INFINITY));
    for (link, base_from_link) in arm.links().iter().zip(posture.base_from_link()) {
        for surface in &link.model.surface {
            let p = base_from_link.point(&surface.point.cast()).cast();
            (low, high) = (low.inf(&p), high.sup(&p));
        }
    }
    let origin = low - Vector3::repeat(COARSE_MARGIN_M);
    let span = high - low + Vector3::repeat(2.0 * COARSE_MARGIN_M);
    let (voxel_m, size) = bounded_grid(&span, COARSE_VOXEL_M, MOST_COARSE_POINTS);
    // From one grid point to the next the distance grows by no more than their spacing, or little
    // more: with that as the limit most links are passed over.
    let (mut link, mut before_m) = (0, f32::INFINITY);
    DistanceField::from_fn(origin, voxel_m, size, LARGEST_M, |p| {
        let limit_m = before_m.abs() + 1.5 * voxel_m;
        let nearest = posture
            .nearest_within(arm, p, limit_m, link)
            .or_else(|| posture.nearest_within(arm, p, f32::INFINITY, link));
        let Some(nearest) = nearest else { return f32::INFINITY };
        (link, before_m) = (nearest.link, nearest.distance_m);
        nearest.distance_m
    })
}

/// One view with as many points as a stage of the search looks at.
struct Problem<'a> {
    view: &'a View<'a>,
    field: &'a DistanceField,
    arm_points: Vec<Point3<f32>>,
    surface: Vec<SurfacePoint>,
    middles: &'a [Point3<f32>],
}

fn problems<'a>(
    views: &'a [SearchView<'a>],
    fields: &'a [DistanceField],
    points: usize,
    surface: usize,
) -> Vec<Problem<'a>> {
    let pair = views.iter().zip(fields);
    pair.map(|(view, field)| Problem {
        view: &view.view,
        field,
        arm_points: thinned(&view.arm_points, points),
        surface: thinned(&view.surface, surface),
        middles: &view.middles,
    })
    .collect()
}

/// About `count` of `items`, evenly spread.
fn thinned<T: Copy>(items: &[T], count: usize) -> Vec<T> {
    let count = count.min(items.len());
    (0..count).map(|i| items[(2 * i + 1) * items.len() / (2 * count)]).collect()
}

/// Translations from single views that are nearer to each other than this may be of the same pose,
/// metres: of a patch of the arm its middle is not the arm's.
const CONSENSUS_M: f32 = 0.3;

/// `base_from_camera` of this rotation that lays the side of the arm turned to the camera on a patch of
/// points seen, in as many views as agree on a translation.
fn start_translation(
    problems: &[Problem<'_>],
    base_from_camera: &UnitQuaternion<f64>,
) -> Isometry3<f64> {
    let rotation = base_from_camera.cast::<f32>();
    let of_view = |problem: &Problem<'_>| -> Vec<Vector3<f32>> {
        let lay = |middle: &Point3<f32>| {
            let sight = rotation * middle.coords;
            let visible = problem.surface.iter().filter(|s| s.normal.dot(&sight) < 0.0);
            let (total, count) =
                visible.fold((Vector3::zeros(), 0usize), |(t, n), s| (t + s.point.coords, n + 1));
            total / count.max(1) as f32 - sight
        };
        problem.middles.iter().map(lay).collect()
    };
    let views: Vec<Vec<Vector3<f32>>> = problems.iter().map(of_view).collect();
    let nearest = |view: &[Vector3<f32>], to: &Vector3<f32>| {
        let near = |a: &&Vector3<f32>, b: &&Vector3<f32>| {
            (*a - to).norm_squared().total_cmp(&(*b - to).norm_squared())
        };
        view.iter().min_by(near).copied().filter(|t| (t - to).norm() < CONSENSUS_M)
    };
    let supporters = |to: &Vector3<f32>| -> Vec<Vector3<f32>> {
        views.iter().filter_map(|view| nearest(view, to)).collect()
    };
    let spread = |to: &Vector3<f32>, all: &[Vector3<f32>]| -> f32 {
        all.iter().map(|t| (t - to).norm()).sum::<f32>() / all.len().max(1) as f32
    };
    let best =
        views.iter().flatten().map(|to| (to, supporters(to))).max_by(|(a, by_a), (b, by_b)| {
            let tighter = || spread(b, by_b).total_cmp(&spread(a, by_a));
            by_a.len().cmp(&by_b.len()).then_with(tighter)
        });
    let translation = best
        .map_or(Vector3::zeros(), |(_, all)| all.iter().sum::<Vector3<f32>>() / all.len() as f32);
    Isometry3::from_parts(Translation3::from(translation.cast::<f64>()), *base_from_camera)
}

/// Robust least squares of the points' distances on the coarse fields, one step for each scale.
fn polish(
    problems: &[Problem<'_>],
    mut base_from_camera: Isometry3<f64>,
    scales: &[f64],
) -> Isometry3<f64> {
    for scale in scales {
        let pose = base_from_camera.cast::<f32>();
        let rotation = pose.rotation.to_rotation_matrix();
        let pivot = pose.translation.vector;
        let mut sum = LowerTriangle::default();
        for problem in problems {
            for point in &problem.arm_points {
                let turned = rotation * point.coords;
                let sample = problem.field.sample(&Point3::from(turned + pivot));
                let weight = geman_mcclure(f64::from(sample.distance_m), *scale);
                let turn = turned.cross(&sample.gradient);
                let g = sample.gradient;
                let jacobian = [g.x, g.y, g.z, turn.x, turn.y, turn.z].map(f64::from);
                sum.add(&jacobian, f64::from(sample.distance_m), weight);
            }
        }
        let sum = sum.complete();
        let Some(step) = sum.solve(1e-3) else { break };
        let turn = UnitQuaternion::new(step.fixed_rows::<3>(3).into_owned());
        base_from_camera.rotation = turn * base_from_camera.rotation;
        base_from_camera.translation.vector += step.fixed_rows::<3>(0);
    }
    base_from_camera
}

/// Normal equations of six unknowns of which half the matrix is summed: this is the hottest loop of
/// the search.
#[derive(Default)]
struct LowerTriangle {
    columns: [[f64; 6]; 6],
    gradient: [f64; 6],
}

impl LowerTriangle {
    #[inline]
    fn add(&mut self, jacobian: &[f64; 6], residual: f64, weight: f64) {
        for (c, column) in self.columns.iter_mut().enumerate() {
            let scaled = weight * jacobian[c];
            for (sum, along) in column[c..].iter_mut().zip(&jacobian[c..]) {
                *sum += scaled * along;
            }
        }
        let slope = weight * residual;
        for (sum, along) in self.gradient.iter_mut().zip(jacobian) {
            *sum += slope * along;
        }
    }

    fn complete(&self) -> NormalEquations<6> {
        let entry = |r: usize, c: usize| self.columns[r.min(c)][r.max(c)];
        let information = Matrix6::from_fn(entry);
        NormalEquations { information, gradient: self.gradient.into(), weight: 0.0 }
    }
}

fn judge(problems: &[Problem<'_>], base_from_camera: Isometry3<f64>) -> Candidate {
    let camera_from_base = Transform::<Camera, Base>::from_isometry(base_from_camera.inverse());
    let (inward, outward) =
        (base_from_camera.cast::<f32>(), camera_from_base.isometry().cast::<f32>());
    let (mut distance, mut contradicted) = (0.0, 0.0);
    for problem in problems {
        let mut sum = 0.0;
        for point in &problem.arm_points {
            sum += f64::from(problem.field.distance(&(inward * point))).abs().min(CAP_M);
        }
        distance += sum / problem.arm_points.len() as f64;
        let (mut against, mut judged) = (0.0, 1e-9);
        for surface in &problem.surface {
            let p = outward * surface.point;
            if (outward.rotation * surface.normal).dot(&p.coords) > 0.0 {
                continue;
            }
            match problem.view.consistency(&p) {
                Consistency::Agrees => judged += 1.0,
                Consistency::Contradicts => (against, judged) = (against + 1.0, judged + 1.0),
                // Behind the camera or out of sight, a pose must not hide from judgement for free.
                Consistency::Unknown => (against, judged) = (against + 0.25, judged + 1.0),
            }
        }
        contradicted += against / judged;
    }
    let views = problems.len() as f64;
    Candidate { camera_from_base, distance_m: distance / views, contradicted: contradicted / views }
}

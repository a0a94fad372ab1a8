//! Frames in, reports out.

use super::belief::{Belief, Quadratic};
use super::counted::CountedViews;
use super::detector::{Detector, Moment, Rate};
use super::known::{Known, both};
use super::moved::{BY, FAR, KNOWN_RAD, Moved, Suspect, beliefs, suspects};
use super::report::{Drift, ViewReport, WhyNot};
use super::scene::{Scene, Witness};
use crate::answer::Pose;
use crate::calibrate::covariance_at;
use crate::observations::Observations;
use crate::record::posture;
use crate::refine::observe_one;
use eyebolt_geometry::{Base, Camera, DepthImage, Mask, Transform};
use eyebolt_registration::{
    Margin, Posture, Reach, RefineView, SHIFTS, ShiftDeviations, Start, View, ViewEvidence,
    ViewFit, view_evidence,
};
use eyebolt_render::Raster;
use eyebolt_robot::{Arm, JointPositions, KinematicsError};
use nalgebra::{DMatrix, DVector, Matrix6, Vector3, Vector6};

/// Watches whether a calibration is still true.
///
/// Frames are of a resting arm, and of the camera of the observations: whoever feeds it sees to that.
pub struct Monitor<'a> {
    arm: &'a Arm,
    observations: &'a Observations,
    known: Known,
    detector: Detector,
    counted: CountedViews,
    scene: Scene,
    raster: Raster,
}

/// Variances of one view are so many times what the noise model says: errors of shapes, of depth at edges and of joints go
/// together over whole links of a posture. With it, squared deviations of simulated views have the quantiles of their
/// chi-square (`examples/monitor_study.rs`; with 1 the 95th is 1.4 times as large, with 2 it is 0.8 times).
const INFLATION: f64 = 1.5;
/// A view that tells fewer nats of where the pose is, of what may have moved, tells nothing: one for each number.
const LEAST_GAIN: f64 = 6.0;
/// A view where more of the arm's pixels show what is behind it has the arm elsewhere, and not nearby.
const ABSENT_SHARE: f64 = 0.5;
/// Of so many pixels at least.
const LEAST_PIXELS: usize = 200;
/// A view that has the arm farther from where it should be is labelled again, metres and radians.
const FAR_M: f64 = 2e-3;
const FAR_RAD: f64 = 3e-3;
/// While a view is looked at: with joints held fast, links behind one that slipped would pass for outliers.
const ALLOWED: ShiftDeviations =
    ShiftDeviations { translation_m: 0.05, rotation_rad: 0.05, joint_rad: 0.01 };

impl<'a> Monitor<'a> {
    /// Of the arm and the camera of `observations`, against what is `known`.
    pub fn new(arm: &'a Arm, observations: &'a Observations, known: Known, rate: &Rate) -> Self {
        Self {
            arm,
            observations,
            detector: Detector::new(beliefs(&observations.arm, &known), rate),
            counted: CountedViews::default(),
            scene: Scene::empty(&observations.camera),
            raster: Raster::new(&observations.camera),
            known,
        }
    }

    /// Whether something moved.
    pub fn alarms(&self) -> bool {
        self.detector.alarms()
    }

    /// How many views counted.
    pub fn counted(&self) -> usize {
        self.detector.counted()
    }

    /// Looks at a frame, of the size of the observations' camera, with the arm's pixels if they are known.
    ///
    /// # Errors
    ///
    /// Joints that are not of this arm.
    pub fn see(
        &mut self,
        frame: &str,
        (depth, mask): (&DepthImage, Option<&Mask>),
        joints: &JointPositions,
    ) -> Result<ViewReport, KinematicsError> {
        let Some(posture) = posture(self.arm, &self.observations.arm, joints)? else {
            return Ok(self.report(frame, None, Some(WhyNot::Unplaced), (depth, 0.0)));
        };
        let camera = &self.observations.camera;
        let view = View { camera, depth, depth_factor: 1.0, mask, posture: &posture };
        let (first, share) = self.look(&view);
        let Some(seen) = first else {
            return Ok(self.report(frame, None, Some(WhyNot::TellsNothing), (depth, share)));
        };
        let why_not = self.count(&posture, &seen, share, depth);
        Ok(self.report(frame, Some(seen), why_not, (depth, share)))
    }

    /// What a view says, and how much of the arm is seen through where it should be.
    fn look(&mut self, view: &View<'_>) -> (Option<Seen>, f64) {
        let (observations, known) = (self.observations, self.known.start);
        let (observed, _) = observe_one(observations, view, &mut self.raster, &known);
        let share = seen_through(view, &self.raster, known.depth_factor());
        let raster = &mut self.raster;
        let mut found =
            evidence(observations, &observed, raster, (&known, &known), (5, Reach::Near));
        let end = found.as_ref().map(|found| found.end);
        let far = |end: &Start| {
            let (metres, radians) = end.camera_from_base.distance_to(&known.camera_from_base);
            let offsets = end.joint_offsets.rad.iter().zip(&known.joint_offsets.rad);
            let slipped = offsets.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            metres > FAR_M || radians > FAR_RAD || slipped > FAR_RAD
        };
        if let Some(end) = end.filter(far) {
            let (observed, _) = observe_one(observations, view, raster, &end);
            found = evidence(observations, &observed, raster, (&known, &end), (3, Reach::Close));
        }
        (found.and_then(Seen::new), share)
    }

    /// Counts a view, unless there is a reason not to.
    fn count(
        &mut self,
        posture: &Posture,
        seen: &Seen,
        share: f64,
        depth: &DepthImage,
    ) -> Option<WhyNot> {
        if share > ABSENT_SHARE {
            // Whatever was taken for it is not the arm.
            self.detector.count_absent();
            return None;
        }
        if Belief::about_zero(&[FAR; 6]).gain(&seen.pose) < LEAST_GAIN {
            return Some(WhyNot::TellsNothing);
        }
        let links = posture.base_from_link();
        if !self.counted.is_new(links, &seen.pose) {
            return Some(WhyNot::SeenBefore);
        }
        self.detector.count(&seen.whole);
        self.counted.push(links, seen.pose.clone());
        if seen.surprise(&self.known) < UNSURPRISING && !self.alarms() {
            self.scene.remember(depth, &self.raster);
        }
        None
    }

    fn report(
        &self,
        frame: &str,
        seen: Option<Seen>,
        why_not: Option<WhyNot>,
        (depth, share): (&DepthImage, f64),
    ) -> ViewReport {
        let alarm = self.alarms();
        let log = self.detector.log_evidence();
        let moment = self.detector.moment();
        let alarming = moment.filter(|_| alarm);
        let moved = alarming.map_or_else(Vec::new, |moment| self.moved(moment, depth));
        // Where a joint slipped the camera is where it was.
        let slipped = |moved: &Moved| matches!(moved.what, Suspect::JointZero(_));
        let proposed = alarming.filter(|_| !moved.first().is_some_and(slipped)).and_then(shift);
        ViewReport {
            frame: frame.to_owned(),
            counts: why_not.is_none(),
            why_not,
            residual_mm: seen.as_ref().and_then(|seen| Some(1e3 * seen.fit.surface_m()?)),
            expected_residual_mm: self.known.residual_m.map(|metres| 1e3 * metres),
            seen_through_share: share,
            surprise: seen.as_ref().map(|seen| seen.surprise(&self.known)),
            log10_evidence: log.is_finite().then(|| log / std::f64::consts::LN_10),
            alarm,
            drift: moment.and_then(|moment| self.drift(moment)),
            moved,
            proposed_camera_from_base: proposed
                .map(|shift| Pose::new(&self.in_optical(&self.shifted(&shift)))),
        }
    }

    fn shifted(&self, shift: &Vector6<f64>) -> Transform<Camera, Base> {
        self.known.start.camera_from_base.retract(shift)
    }

    fn in_optical(&self, pose: &Transform<Camera, Base>) -> Transform<Camera, Base> {
        self.observations.optical_from_camera * *pose
    }

    fn drift(&self, moment: &Moment) -> Option<Drift> {
        let views = self.counted() - moment.since;
        let pose = &self.known.start.camera_from_base;
        let shift = shift(moment)?;
        let (_, belief) = moment.pose()?;
        let of_views = Matrix6::from_fn(|i, j| belief.covariance[(i, j)]);
        let covariance = of_views + self.known.covariance;
        let reach = pose.direction(&self.known.workspace_in_base.coords);
        let rotation: Vector3<f64> = shift.fixed_rows::<3>(3).into_owned();
        let translation = shift.fixed_rows::<3>(0) + rotation.cross(&reach);
        let at = covariance_at(&covariance, pose, &self.known.workspace_in_base);
        let turn = both(&self.observations.optical_from_camera);
        let turned =
            turn * Vector6::from_iterator(translation.iter().chain(rotation.iter()).copied());
        let part = |first: usize, unit: f64| std::array::from_fn(|i| unit * turned[first + i]);
        let degree = 1f64.to_degrees();
        Some(Drift {
            translation_mm: 1e3 * translation.norm(),
            translation_sigma_mm: 1e3 * at.trace().sqrt(),
            rotation_deg: degree * rotation.norm(),
            rotation_sigma_deg: degree * covariance.fixed_view::<3, 3>(3, 3).trace().sqrt(),
            views,
            translation_in_camera_mm: part(0, 1e3),
            rotation_in_camera_deg: part(3, degree),
        })
    }

    fn moved(&self, moment: &Moment, depth: &DepthImage) -> Vec<Moved> {
        let mut found = suspects(&self.observations.arm, moment);
        let witness = shift(moment).map_or(Witness::Silent, |shift| {
            let before = self.known.start.camera_from_base;
            let after_from_before = self.shifted(&shift) * before.inverse();
            let Observations { camera, rays, .. } = self.observations;
            self.scene.witness(camera, rays, (depth, &self.raster), &after_from_before)
        });
        for suspect in found.iter_mut().filter(|moved| moved.what == Suspect::CameraOrBase) {
            suspect.what = match witness {
                Witness::Camera => Suspect::Camera,
                Witness::Base => Suspect::Base,
                Witness::Silent => Suspect::CameraOrBase,
            };
        }
        found
    }
}

/// The scene of views that have the arm about where it should be is remembered: squared standard deviations for each of
/// six parts.
const UNSURPRISING: f64 = 4.0;

fn evidence(
    observations: &Observations,
    view: &RefineView<'_>,
    raster: &mut Raster,
    known_and_at: (&Start, &Start),
    how: (usize, Reach),
) -> Option<ViewEvidence> {
    view_evidence(&observations.arm, view, raster, known_and_at, &ALLOWED, how)
}

/// Where the views since `moment` have the pose, against the stored one, if camera or base moved; `None` where they hardly
/// tell.
fn shift(moment: &Moment) -> Option<Vector6<f64>> {
    let (number, belief) = moment.pose()?;
    let is_told = (0..6).all(|i| belief.covariance[(i, i)] < (TOLD * BY[number]).powi(2));
    is_told.then(|| Vector6::from_fn(|i, _| belief.mean[i]))
}

/// A pose whose standard deviations are more than this part of what they are before anything is seen is not told.
const TOLD: f64 = 0.5;

/// What a view says, with variances as they are.
struct Seen {
    /// Of the pose, joints as well known as they are.
    pose: Quadratic,
    /// Of pose and joints.
    whole: Quadratic,
    fit: ViewFit,
}

impl Seen {
    fn new(evidence: ViewEvidence) -> Option<Self> {
        let (information, vector) = evidence.of_pose(KNOWN_RAD)?;
        let pose = Quadratic {
            information: DMatrix::from_fn(6, 6, |i, j| information[(i, j)]),
            vector: DVector::from_fn(6, |i, _| vector[i]),
        };
        let whole = Quadratic {
            information: DMatrix::from_fn(SHIFTS, SHIFTS, |i, j| evidence.information[(i, j)]),
            vector: DVector::from_fn(SHIFTS, |i, _| evidence.vector[i]),
        };
        let [pose, whole] = [pose, whole].map(|evidence| evidence.inflated(INFLATION));
        Some(Self { pose, whole, fit: evidence.fit })
    }

    /// How far it is from what is known, in squared standard deviations of both, for each of six parts.
    fn surprise(&self, known: &Known) -> f64 {
        let Some(after) = Belief::about_zero(&[FAR; 6]).after(&self.pose) else {
            return f64::INFINITY;
        };
        let known = DMatrix::from_fn(6, 6, |i, j| known.covariance[(i, j)]);
        let solved = (after.covariance + known).cholesky().map(|c| c.solve(&after.mean));
        solved.map_or(f64::INFINITY, |solved| after.mean.dot(&solved) / 6.0)
    }
}

/// Share of the posed arm's pixels that show something clearly behind it, of those that show something and are not hidden;
/// nothing where there are too few.
fn seen_through(view: &View<'_>, raster: &Raster, depth_factor: f32) -> f64 {
    let (mut through, mut judged) = (0, 0);
    for at in raster.pixels() {
        let Some(z) = raster.depth_m(at) else { continue };
        let seen = depth_factor * view.depth.depth_m().get(at).copied().unwrap_or(0.0);
        let margin = Margin::Search.at_m(z);
        if seen <= 0.0 || seen < z - margin {
            continue;
        }
        judged += 1;
        through += usize::from(seen > z + margin);
    }
    if judged < LEAST_PIXELS { 0.0 } else { through as f64 / judged as f64 }
}

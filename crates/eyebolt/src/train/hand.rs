//! Views of an end-effector to learn from.

use super::error::TrainError;
use super::images::Images;
use super::shot::{Framing, Shot};
use crate::end_effector::EndEffector;
use crate::pose::EndEffectorView;
use crate::segment::{ARM, END_EFFECTOR};
use eyebolt_geometry::{Camera, EndEffector as EndEffectorFrame, Link, Transform};
use eyebolt_render::{Field, Random};
use eyebolt_robot::JointPositions;
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Whose end-effector, and from where.
pub struct Hand {
    /// The arm, which is known.
    pub images: Images,
    /// Its end-effector.
    pub end_effector: EndEffector,
    /// Its largest extent, metres.
    pub extent_m: f64,
    /// Of all random choices.
    pub seed: u64,
}

/// A view and the truth about it.
pub struct HandView {
    /// What is seen.
    pub view: EndEffectorView,
    /// How the end-effector is turned, and where it is.
    pub view_from_end_effector: Transform<Link, EndEffectorFrame>,
    /// Where its fingers are.
    pub joints: JointPositions,
}

/// Views of validations, drawn once: with true labels, then the same with labels as networks find them.
#[derive(Default)]
pub struct HeldOut(OnceLock<[Vec<HandView>; 2]>);

impl HeldOut {
    /// Views 0 to before `count` of a stream.
    ///
    /// # Errors
    ///
    /// As [`Hand::view`].
    pub fn views(
        &self,
        hand: &Hand,
        stream: u64,
        count: u64,
    ) -> Result<&[Vec<HandView>; 2], TrainError> {
        if let Some(views) = self.0.get() {
            return Ok(views);
        }
        let draw = |true_labels: bool| {
            (0..count)
                .map(|index| hand.view(stream, index, true_labels))
                .collect::<Result<Vec<_>, _>>()
        };
        let views = [draw(true)?, draw(false)?];
        Ok(self.0.get_or_init(|| views))
    }
}

/// Images drawn until one shows enough of it.
const TRIES: u64 = 20;
/// Views of one image that are learned from: each as if the camera were rolled otherwise and another network
/// had found the labels. An image costs many times what a view does.
pub const VIEWS_OF_ONE: u64 = 4;

impl Hand {
    /// `count` views to learn from in step `step` of a stream, in fours of one image each.
    ///
    /// # Errors
    ///
    /// As [`Self::view`].
    pub fn views(&self, stream: u64, step: u64, count: u64) -> Result<Vec<HandView>, TrainError> {
        let images = count.div_ceil(VIEWS_OF_ONE);
        let mut views = Vec::with_capacity(count as usize);
        for image in 0..images {
            let random = Random::new(self.seed).at(stream).at(step * images + image);
            let of_one = VIEWS_OF_ONE.min(count - image * VIEWS_OF_ONE);
            views.extend(self.of_one(random, of_one, false)?);
        }
        Ok(views)
    }

    /// View `index` of a stream of random numbers. With `true_labels` its points are those of the
    /// end-effector and no others, as if the segmentation knew; else as a network finds them.
    ///
    /// # Errors
    ///
    /// The end-effector is in none of many images.
    pub fn view(&self, stream: u64, index: u64, true_labels: bool) -> Result<HandView, TrainError> {
        let random = Random::new(self.seed).at(stream).at(index);
        let views = self.of_one(random, 1, true_labels)?;
        views.into_iter().next().ok_or(TrainError::NothingToSee { tries: TRIES })
    }

    /// Up to `count` views of one image, and at least one.
    fn of_one(
        &self,
        random: Random,
        count: u64,
        true_labels: bool,
    ) -> Result<Vec<HandView>, TrainError> {
        for attempt in 0..TRIES {
            let random = random.at(attempt);
            let shots = self.images.shots(random, 1, Framing::AT_END_EFFECTOR)?;
            let Some(shot) = shots.into_iter().next() else { continue };
            let view = |index: u64| {
                let random = random.at(u64::MAX).at(index);
                match true_labels {
                    true => self.view_of(&shot, &shot.label, 0.0),
                    false => self.view_of(&shot, &found(&shot, random), random.at(9).uniform()),
                }
            };
            let views: Vec<HandView> = (0..count).filter_map(view).collect();
            if !views.is_empty() {
                return Ok(views);
            }
        }
        Err(TrainError::NothingToSee { tries: TRIES })
    }

    /// The view of `shot`, its camera rolled by a part of a turn.
    fn view_of(&self, shot: &Shot, label: &[u8], roll: f64) -> Option<HandView> {
        let roll = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), TAU * roll);
        let rolled = Transform::<Camera, Camera>::from_parts(Vector3::zeros(), roll);
        let turn = roll.cast::<f32>();
        let points = points(shot, label).into_iter();
        let points: Vec<[f32; 3]> = points.map(|p| (turn * Vector3::from(p)).into()).collect();
        let view = EndEffectorView::new(&points, self.extent_m)?;
        let camera_from_end_effector = rolled * shot.camera_from_end_effector;
        let view_from_end_effector = view.camera_from_view.inverse() * camera_from_end_effector;
        Some(HandView { view, view_from_end_effector, joints: shot.joints.clone() })
    }
}

fn points(shot: &Shot, label: &[u8]) -> Vec<[f32; 3]> {
    let seen = shot.image.seen().filter(|at| label[*at] == END_EFFECTOR);
    seen.map(|at| shot.image.point(at)).collect()
}

/// Labels as a network finds them: the border to the arm is somewhere else, patches are lost, and a
/// little of what is around counts as the end-effector.
fn found(shot: &Shot, random: Random) -> Vec<u8> {
    let size = [shot.image.width, shot.image.height];
    let mut style = random.at(0);
    let shift = style.between(0.0, 3.0) as f32;
    let lost = style.between(1.6, 4.0) as f32;
    let [across, down, holes] = [1, 2, 3].map(|place| Field::new(random.at(place), size, 3.0));
    let place = |at: usize| (at % size[0], at / size[0]);
    let moved = |at: usize| {
        let (u, v) = place(at);
        let to = |value: usize, field: &Field, limit: usize| {
            let by = (shift * field.at(u, v)).round() as i64;
            (value as i64 + by).clamp(0, limit as i64 - 1) as usize
        };
        to(v, &down, size[1]) * size[0] + to(u, &across, size[0])
    };
    let label = |at: usize| {
        let (u, v) = place(at);
        let (here, there) = (shot.label[at], shot.label[moved(at)]);
        match there {
            END_EFFECTOR if holes.at(u, v) > lost => ARM,
            _ => {
                if here == END_EFFECTOR || there == END_EFFECTOR {
                    there
                } else {
                    here
                }
            }
        }
    };
    (0..shot.label.len()).map(label).collect()
}

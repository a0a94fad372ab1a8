//! Views of an end-effector to learn from.

use super::error::TrainError;
use super::images::Images;
use super::shot::{Framing, Shot};
use crate::end_effector::EndEffector;
use crate::pose::EndEffectorView;
use crate::segment::{ARM, END_EFFECTOR};
use eyebolt_geometry::{EndEffector as EndEffectorFrame, Link, Transform};
use eyebolt_render::{Field, Random};
use eyebolt_robot::JointPositions;
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

/// Views drawn until one shows enough of it.
const TRIES: u64 = 20;

impl Hand {
    /// View `index` of a stream of random numbers. With `true_labels` its points are those of the
    /// end-effector and no others, as if the segmentation knew; else as a network finds them.
    ///
    /// # Errors
    ///
    /// The end-effector is in none of many images.
    pub fn view(&self, stream: u64, index: u64, true_labels: bool) -> Result<HandView, TrainError> {
        let random = Random::new(self.seed).at(stream).at(index);
        let framing = Framing::AT_END_EFFECTOR;
        for attempt in 0..TRIES {
            let shots = self.images.shots(random.at(attempt), 1, framing)?;
            let Some(shot) = shots.into_iter().next() else { continue };
            let points = if true_labels {
                points(&shot, &shot.label)
            } else {
                points(&shot, &found(&shot, random.at(attempt).at(u64::MAX)))
            };
            if let Some(view) = EndEffectorView::new(&points, self.extent_m) {
                let view_from_end_effector =
                    view.camera_from_view.inverse() * shot.camera_from_end_effector;
                return Ok(HandView { view, view_from_end_effector, joints: shot.joints });
            }
        }
        Err(TrainError::NothingToSee { tries: TRIES })
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

//! What happens when: the arm moves, rests, and is looked at.

use eyebolt_robot::JointPositions;

/// One thing that happens.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Event {
    /// The joints are told.
    Joints,
    /// A frame is taken.
    Frame {
        /// Whether the arm rests.
        at_rest: bool,
    },
}

/// A moment at which something happens, and where the joints are then.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moment {
    /// Nanoseconds.
    pub(super) stamp_ns: i64,
    /// Where the arm is.
    pub(super) joints: JointPositions,
    pub(super) event: Event,
}

const MILLISECOND_NS: i64 = 1_000_000;
/// The first moment: stamps of zero mean that nobody set one.
const START_NS: i64 = 1000 * MILLISECOND_NS;
/// From one joint state to the next, and from frame to frame at rest.
const JOINTS_NS: i64 = 20 * MILLISECOND_NS;
const FRAME_NS: i64 = 33_333_333;
/// A way from one configuration to the next, and how long the arm has rested before it is looked at.
const MOVE_NS: i64 = 2000 * MILLISECOND_NS;
const SETTLE_NS: i64 = 300 * MILLISECOND_NS;

/// When frames without the arm were taken: before everything else.
pub(super) fn background_stamp_ns(index: usize) -> i64 {
    START_NS + index as i64 * FRAME_NS
}

/// When each configuration is reached and rested in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timeline {
    pub(super) frames: usize,
    /// On each way.
    pub(super) moving_frames: usize,
    /// Taken before everything else.
    pub(super) backgrounds: usize,
}

impl Timeline {
    fn rest_ns(&self) -> i64 {
        SETTLE_NS + self.frames as i64 * FRAME_NS + SETTLE_NS
    }

    /// When the arm sets out for a configuration, or begins to rest in the first.
    pub(super) fn begin_ns(&self, configuration: usize) -> i64 {
        let first_ns = background_stamp_ns(self.backgrounds) + 1000 * MILLISECOND_NS;
        match configuration as i64 {
            0 => first_ns,
            later => first_ns + later * self.rest_ns() + (later - 1) * MOVE_NS,
        }
    }

    /// All that happens while the arm goes from `before`, if it was anywhere before, to `joints` and
    /// rests there.
    pub(super) fn moments(
        &self,
        configuration: usize,
        before: Option<&JointPositions>,
        joints: &JointPositions,
    ) -> Vec<Moment> {
        let mut moments = Vec::new();
        let mut begin_ns = self.begin_ns(configuration);
        if let Some(before) = before {
            way(&mut moments, begin_ns, before, joints, self.moving_frames);
            begin_ns += MOVE_NS;
        }
        let mut at = |offset_ns: i64, event: Event| {
            let joints = joints.clone();
            moments.push(Moment { stamp_ns: begin_ns + offset_ns, joints, event });
        };
        (0..self.rest_ns() / JOINTS_NS).for_each(|step| at(step * JOINTS_NS, Event::Joints));
        let frame = |frame: i64| SETTLE_NS + frame * FRAME_NS;
        (0..self.frames as i64).for_each(|i| at(frame(i), Event::Frame { at_rest: true }));
        // Stable: joints first where both happen at once.
        moments.sort_by_key(|moment| moment.stamp_ns);
        moments
    }
}

fn way(
    moments: &mut Vec<Moment>,
    begin_ns: i64,
    from: &JointPositions,
    to: &JointPositions,
    frames: usize,
) {
    let mut at = |offset_ns: i64, event: Event| {
        let joints = between(from, to, offset_ns as f64 / MOVE_NS as f64);
        moments.push(Moment { stamp_ns: begin_ns + offset_ns, joints, event });
    };
    (0..MOVE_NS / JOINTS_NS).for_each(|step| at(step * JOINTS_NS, Event::Joints));
    let apart_ns = MOVE_NS / (frames as i64 + 1);
    (1..=frames as i64).for_each(|i| at(i * apart_ns, Event::Frame { at_rest: false }));
}

/// Joints on the way, at rest at both ends.
fn between(from: &JointPositions, to: &JointPositions, time: f64) -> JointPositions {
    // The polynomial of least jerk (Flash and Hogan, 1985).
    let share = time.powi(3) * (10.0 - 15.0 * time + 6.0 * time * time);
    let mix = |(name, end): (&str, f64)| {
        let start = from.get(name).unwrap_or(end);
        (name.to_owned(), start + share * (end - start))
    };
    to.iter().map(mix).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn joints(values: [f64; 2]) -> JointPositions {
        [("a".to_owned(), values[0]), ("b".to_owned(), values[1])].into_iter().collect()
    }

    fn places() -> impl Strategy<Value = Vec<JointPositions>> {
        proptest::collection::vec(proptest::array::uniform2(-3.0..3.0_f64), 1..5)
            .prop_map(|places| places.into_iter().map(joints).collect())
    }

    /// All that happens, with the configuration that it leads to.
    fn all(timeline: &Timeline, places: &[JointPositions]) -> (Vec<Moment>, Vec<usize>) {
        let each = places.iter().enumerate().flat_map(|(index, joints)| {
            let before = index.checked_sub(1).map(|before| &places[before]);
            timeline.moments(index, before, joints).into_iter().map(move |moment| (moment, index))
        });
        each.unzip()
    }

    fn is_frame(moment: &Moment) -> bool {
        matches!(moment.event, Event::Frame { .. })
    }

    proptest! {
        #[test]
        fn stamps_rise_and_every_frame_is_between_two_joint_states(
            places in places(), frames in 1..20_usize, moving in 0..40_usize, backgrounds in 0..5_usize,
        ) {
            let timeline = Timeline { frames, moving_frames: moving, backgrounds };
            let (moments, _) = all(&timeline, &places);
            prop_assert!(moments[0].stamp_ns > background_stamp_ns(backgrounds));
            prop_assert!(moments.is_sorted_by_key(|moment| moment.stamp_ns));
            for of_kind in [true, false] {
                let stamps: Vec<i64> =
                    moments.iter().filter(|m| is_frame(m) == of_kind).map(|m| m.stamp_ns).collect();
                prop_assert!(stamps.is_sorted_by(|a, b| a < b), "no two of one kind at once");
            }
            let taken = moments.iter().filter(|moment| is_frame(moment)).count();
            prop_assert_eq!(taken, places.len() * frames + (places.len() - 1) * moving);
            for (at, moment) in moments.iter().enumerate().filter(|(_, moment)| is_frame(moment)) {
                let before = moments[..at].iter().rfind(|other| !is_frame(other)).unwrap();
                let after = moments[at..].iter().find(|other| !is_frame(other)).unwrap();
                prop_assert!(moment.stamp_ns - before.stamp_ns <= JOINTS_NS);
                prop_assert!(after.stamp_ns - moment.stamp_ns <= JOINTS_NS);
            }
        }

        /// Nothing moves from well before a frame at rest until well after it.
        #[test]
        fn frames_at_rest_see_an_arm_at_rest(places in places(), moving in 0..9_usize) {
            let timeline = Timeline { frames: 3, moving_frames: moving, backgrounds: 0 };
            let (moments, configurations) = all(&timeline, &places);
            let resting = |(moment, _): &(&Moment, usize)| moment.event == Event::Frame { at_rest: true };
            for (moment, index) in moments.iter().zip(configurations).filter(resting) {
                let near = moments.iter().filter(|other| {
                    (other.stamp_ns - moment.stamp_ns).abs() < SETTLE_NS
                });
                for other in near {
                    prop_assert_eq!(&other.joints, &places[index]);
                }
            }
        }

        /// A way begins where one configuration is and ends where the next is, slowly at both ends.
        #[test]
        fn ends_meet(from in proptest::array::uniform2(-3.0..3.0_f64), to in proptest::array::uniform2(-3.0..3.0_f64)) {
            let (from, to) = (joints(from), joints(to));
            prop_assert_eq!(&between(&from, &to, 0.0), &from);
            let off = |a: &JointPositions, b: &JointPositions| {
                a.iter().zip(b.iter()).map(|((_, a), (_, b))| (a - b).abs()).fold(0.0, f64::max)
            };
            prop_assert!(off(&between(&from, &to, 1.0), &to) < 1e-12);
            let way = off(&from, &to);
            prop_assert!(off(&between(&from, &to, 0.01), &from) <= 1e-5 * way);
            prop_assert!(off(&between(&from, &to, 0.99), &to) <= 1e-5 * way + 1e-12);
            for share in [0.2, 0.35, 0.5] {
                // As fast on one half of the way as on the other.
                let (early, late) = (between(&from, &to, share), between(&to, &from, 1.0 - share));
                prop_assert!(off(&early, &late) < 1e-12);
            }
            // Nobody who looks every 20 ms sees a jump.
            let timeline = Timeline { frames: 1, moving_frames: 0, backgrounds: 0 };
            let (moments, _) = all(&timeline, &[from, to]);
            for pair in moments.windows(2) {
                prop_assert!(off(&pair[0].joints, &pair[1].joints) <= 0.02 * way + 1e-12);
            }
        }
    }
}

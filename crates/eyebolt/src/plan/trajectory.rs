//! When the joints are where.

use super::movable::Positions;
use super::path::between;
use super::speed::{PEAK, Speed};

/// Where the joints are at some moment.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedPoint {
    /// Seconds since the beginning.
    pub at_s: f64,
    /// Radians or metres, in the order of the joints.
    pub positions: Positions,
    /// Radians or metres a second.
    pub velocities: Vec<f64>,
}

/// Moments told of each way, seconds apart at most.
const APART_S: f64 = 1.0;

/// Follows `ways` one after the other, each from where the last one ended, with a rest of `rest_s` at the end of each.
/// Between the points of a way all joints move as the same cubic of time, which is at rest at both ends: whether a
/// controller interpolates by cubics, as it does where it is told velocities, or by straight lines, the arm stays on the way.
pub(super) fn timed(ways: &[Vec<Positions>], speed: &Speed, rest_s: f64) -> Vec<TimedPoint> {
    let mut points: Vec<TimedPoint> = Vec::new();
    let at_rest = |at_s: f64, positions: &Positions| TimedPoint {
        at_s,
        positions: positions.clone(),
        velocities: vec![0.0; positions.len()],
    };
    let mut now_s = 0.0;
    for way in ways {
        if let (Some(first), true) = (way.first(), points.is_empty()) {
            points.push(at_rest(now_s, first));
        }
        for pair in way.windows(2) {
            let takes_s = speed.straight_s(&pair[0], &pair[1]);
            let parts = (takes_s / APART_S).ceil().max(1.0) as usize;
            for part in 1..=parts {
                let along = part as f64 / parts as f64;
                points.push(TimedPoint {
                    at_s: now_s + along * takes_s,
                    // To the last bit where the way ends.
                    positions: match part == parts {
                        true => pair[1].clone(),
                        false => between(&pair[0], &pair[1], along * along * (3.0 - 2.0 * along)),
                    },
                    velocities: pair[0]
                        .iter()
                        .zip(&pair[1])
                        .map(|(from, to)| {
                            4.0 * PEAK * along * (1.0 - along) * (to - from) / takes_s
                        })
                        .collect(),
                });
            }
            now_s += takes_s;
        }
        if let Some(last) = way.last() {
            now_s += rest_s;
            points.push(at_rest(now_s, last));
        }
    }
    points
}

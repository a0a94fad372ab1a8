//! Joint states as a scan meets them.

mod untold;

use crate::bag_recording::track::Track;
use crate::message::{JointStateMessage, WireProblem};
pub(crate) use untold::Untold;
use untold::Why;

/// Positions of the joints of one topic: one track for each set of names, for each publisher tells
/// its own joints.
#[derive(Clone, Debug, Default)]
pub(crate) struct JointTracks {
    tracks: Vec<Track>,
    untold: Untold,
    /// Positions in the order of a track.
    sorted: Vec<f64>,
}

/// Sets of joint names kept of one topic.
const MOST_TRACKS: usize = 16;
/// Joints of the largest robot.
const MOST_JOINTS: usize = 1000;
/// No joint is so far from where it was calibrated, radians or metres: not even a wheel.
const FARTHEST: f64 = 1e6;

impl JointTracks {
    /// All tracks, in the order in which they began.
    pub(crate) fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Joints that messages name without a position that can be used.
    pub(crate) fn untold(&self) -> &Untold {
        &self.untold
    }

    pub(super) fn finish(&mut self) {
        self.tracks.iter_mut().for_each(Track::finish);
    }

    /// Takes in the positions of one message. What it does not tell of one joint costs the others
    /// nothing.
    pub(super) fn add(
        &mut self,
        stamp_ns: i64,
        message: &JointStateMessage<'_>,
    ) -> Result<(), WireProblem> {
        if message.positions.is_empty() {
            return Ok(());
        }
        let same = |track: &Track| track.names().iter().eq(message.names.iter());
        if let Some(number) = self.tracks.iter().position(same) {
            let positions = message.names.iter().enumerate().map(|(index, name)| {
                usable(message.positions.get(index)).map_err(|why| self.untold.add(name, why))
            });
            self.sorted = positions.map(|told| told.unwrap_or(f64::NAN)).collect();
            return self.push(number, stamp_ns);
        }
        let told = self.told(message)?;
        if told.iter().all(|(_, position)| position.is_nan()) {
            return Ok(());
        }
        // Some publishers tell the same joints in another order every time.
        for number in 0..self.tracks.len() {
            if sort(self.tracks.get(number).map_or(&[], Track::names), &told, &mut self.sorted) {
                return self.push(number, stamp_ns);
            }
        }
        if self.tracks.len() >= MOST_TRACKS {
            let problem = format!("more than {MOST_TRACKS} sets of joints");
            return Err(WireProblem::new("name", problem));
        }
        self.tracks.push(Track::new(told.iter().map(|(name, _)| (*name).to_owned()).collect()));
        self.sorted = told.into_iter().map(|(_, position)| position).collect();
        self.push(self.tracks.len() - 1, stamp_ns)
    }

    /// Adds the sorted positions to a track, if there are any.
    fn push(&mut self, number: usize, stamp_ns: i64) -> Result<(), WireProblem> {
        let Some(track) = self.tracks.get_mut(number) else { return Ok(()) };
        if self.sorted.iter().any(|position| !position.is_nan()) {
            track.push(stamp_ns, &self.sorted);
        }
        Ok(())
    }

    /// Every name once, with its position; NaN where it has none that can be used.
    fn told<'a>(
        &mut self,
        message: &JointStateMessage<'a>,
    ) -> Result<Vec<(&'a str, f64)>, WireProblem> {
        if message.names.len() > MOST_JOINTS {
            let problem = format!("{} joints, more than {MOST_JOINTS}", message.names.len());
            return Err(WireProblem::new("name", problem));
        }
        let mut told: Vec<(&str, f64)> = Vec::with_capacity(message.names.len());
        for (index, name) in message.names.iter().copied().enumerate() {
            let position = usable(message.positions.get(index));
            match told.iter_mut().find(|(known, _)| *known == name) {
                Some((_, known)) if Ok(*known) == position => {}
                Some((_, known)) => {
                    *known = f64::NAN;
                    self.untold.add(name, Why::Twice);
                }
                None => told.push((
                    name,
                    position.map_err(|why| self.untold.add(name, why)).unwrap_or(f64::NAN),
                )),
            }
        }
        Ok(told)
    }
}

/// The position, if a joint can be there.
fn usable(position: Option<&f64>) -> Result<f64, Why> {
    match position {
        None => Err(Why::ListEnds),
        Some(position) if position.is_finite() && position.abs() <= FARTHEST => Ok(*position),
        Some(position) => Err(Why::NoPosition(*position)),
    }
}

/// Puts positions into the order of `names`; whether the message has exactly these.
fn sort(names: &[String], told: &[(&str, f64)], sorted: &mut Vec<f64>) -> bool {
    if names.len() != told.len() {
        return false;
    }
    let position =
        |name: &String| told.iter().find(|(other, _)| other == name).map(|(_, position)| *position);
    sorted.clear();
    sorted.extend(names.iter().map_while(position));
    sorted.len() == names.len()
}

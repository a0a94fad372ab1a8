//! Joint states as a scan meets them.

use crate::bag_recording::track::Track;
use crate::message::{JointStateMessage, WireProblem};

/// Positions of the joints of one topic: one track for each set of names, for each publisher tells
/// its own joints.
#[derive(Debug, Default)]
pub(crate) struct JointTracks {
    tracks: Vec<Track>,
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

    pub(super) fn finish(&mut self) {
        self.tracks.iter_mut().for_each(Track::finish);
    }

    /// Takes in the positions of one message.
    pub(super) fn add(
        &mut self,
        stamp_ns: i64,
        message: &JointStateMessage<'_>,
    ) -> Result<(), WireProblem> {
        let (names, positions) = (&message.names, &message.positions);
        if positions.is_empty() {
            return Ok(());
        }
        for (name, position) in names.iter().zip(positions) {
            if !position.is_finite() || position.abs() > FARTHEST {
                let problem = format!("the position of {name} is {position}");
                return Err(WireProblem::new("position", problem));
            }
        }
        let same = |track: &&mut Track| track.names().iter().eq(names.iter());
        if let Some(track) = self.tracks.iter_mut().find(same) {
            track.push(stamp_ns, positions);
            return Ok(());
        }
        // Some publishers tell the same joints in another order every time.
        for track in &mut self.tracks {
            if sort(track.names(), message, &mut self.sorted) {
                track.push(stamp_ns, &self.sorted);
                return Ok(());
            }
        }
        let mut track = self.track(names)?;
        track.push(stamp_ns, positions);
        self.tracks.push(track);
        Ok(())
    }

    /// A track of joints that have none yet.
    fn track(&self, names: &[&str]) -> Result<Track, WireProblem> {
        let refused = |problem: String| Err(WireProblem::new("name", problem));
        if names.len() > MOST_JOINTS {
            return refused(format!("{} joints, more than {MOST_JOINTS}", names.len()));
        }
        for (index, name) in names.iter().enumerate() {
            if names.iter().take(index).any(|earlier| earlier == name) {
                return refused(format!("{name} stands there twice"));
            }
        }
        if self.tracks.len() >= MOST_TRACKS {
            return refused(format!("more than {MOST_TRACKS} sets of joints"));
        }
        Ok(Track::new(names.iter().map(|name| (*name).to_owned()).collect()))
    }
}

/// Puts positions into the order of `names`; whether the message has exactly these.
fn sort(names: &[String], message: &JointStateMessage<'_>, sorted: &mut Vec<f64>) -> bool {
    if names.len() != message.names.len() {
        return false;
    }
    let position = |name: &String| {
        let at = message.names.iter().position(|other| other == name)?;
        message.positions.get(at).copied()
    };
    sorted.clear();
    sorted.extend(names.iter().map_while(position));
    sorted.len() == names.len()
}

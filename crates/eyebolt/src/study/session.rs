//! What a session is, drawn from a seed.

use super::kind::Kind;
use super::tampering::Tampering;
use crate::robots::{BUILT_IN, BuiltIn};
use crate::simulate::{Faults, Lab, Ranges, SecondArm, Viewpoint};
use eyebolt_render::{Random, Sensor};

/// A session: a robot, a camera, a room, and what is the matter.
#[derive(Clone, Debug)]
pub struct Session {
    /// Its number in the study.
    pub number: u64,
    /// What is the matter with it.
    pub kind: Kind,
    /// The robot that stands there.
    pub robot: &'static BuiltIn,
    /// The camera.
    pub sensor: Sensor,
    /// Where the camera stands.
    pub viewpoint: Viewpoint,
    /// How many configurations the arm rests in.
    pub configurations: usize,
    /// Frames of each.
    pub frames: usize,
    /// Frames without the arm.
    pub backgrounds: usize,
    /// Things that stand about.
    pub clutter: usize,
    /// What goes wrong while it is recorded.
    pub faults: Faults,
    /// What goes wrong with the recording afterwards.
    pub tampering: Option<Tampering>,
    /// Of all random choices of the simulation.
    pub seed: u64,
}

/// Which stream of random numbers decides what: what is added later changes nothing else.
#[derive(Clone, Copy)]
enum Choice {
    Kind = 1,
    Robot,
    Sensor,
    Counts,
    Always,
    Matter,
    Seed,
}

impl Session {
    /// Session `number` of the study of `seed`, of kind `only` if one is given.
    ///
    /// Half of the sessions are spoiled, each by one thing. Whatever its kind, all else of a session
    /// is the same.
    pub fn draw(seed: u64, number: u64, only: Option<Kind>) -> Self {
        let random = |choice: Choice| Random::new(seed).at(number).at(choice as u64);
        let kind = only.unwrap_or_else(|| any_kind(&mut random(Choice::Kind)));
        let robot = &BUILT_IN[random(Choice::Robot).index(BUILT_IN.len())];
        let real: Vec<Sensor> =
            Sensor::ALL.into_iter().filter(|sensor| *sensor != Sensor::IDEAL).collect();
        let sensor = real[random(Choice::Sensor).index(real.len())];
        let mut counts = random(Choice::Counts);
        let mut session = Self {
            number,
            kind,
            robot,
            sensor,
            viewpoint: Viewpoint::Within(ranges(robot.about().reach_m, &sensor)),
            configurations: 3 + counts.index(10),
            frames: 1 + counts.index(5),
            clutter: counts.index(9),
            backgrounds: if counts.uniform() < 0.15 { 3 } else { 0 },
            faults: always(&mut random(Choice::Always)),
            tampering: None,
            seed: random(Choice::Seed).next_u64(),
        };
        session.become_its_kind(&mut random(Choice::Matter));
        session
    }

    /// Makes the session one of its kind.
    fn become_its_kind(&mut self, random: &mut Random) {
        self.faults.lab = lab(self.kind, self.robot.about().reach_m, random);
        let faults = &mut self.faults;
        match self.kind {
            Kind::CameraPattern => faults.depth_scale = 1.0 + either_way(random, 0.01, 0.02),
            Kind::Bump => {
                let by_deg = random.between(0.3, 2.0);
                faults.bump = Some([random.between(0.005, 0.020), by_deg.to_radians()]);
            }
            Kind::LinkLength => faults.link_length_m = random.between(0.002, 0.012),
            Kind::LowerBase => faults.base_lower_m = random.between(0.004, 0.060),
            Kind::FocalScale => faults.focal_scale = 1.0 + either_way(random, 0.01, 0.05),
            Kind::PrincipalPoint => {
                let (px, way) = (random.between(2.0, 8.0), random.between(0.0, TAU));
                faults.centre_px = [px * way.cos(), px * way.sin()];
            }
            Kind::Backlash => faults.backlash = random.between(0.3, 2.0).to_radians(),
            Kind::WristOnly => faults.wrist_only = true,
            Kind::DepthScale => faults.depth_scale = 1.0 + either_way(random, 0.03, 0.06),
            Kind::Occlusion => faults.occlusion = 1.0 / 3.0,
            Kind::JointZero => faults.one_joint_offset = random.between(0.5, 3.0).to_radians(),
            _ => self.tampering = Tampering::draw(self.kind, self.robot, random),
        }
    }
}

/// What is in the laboratory of a session of `kind` with an arm of `reach_m`.
fn lab(kind: Kind, reach_m: f64, random: &mut Random) -> Lab {
    let none = Lab::default();
    match kind {
        Kind::Gloss => Lab { gloss: random.between(0.05, 0.5), ..none },
        Kind::FarRoom => Lab { far_room: true, wander_m: random.between(0.003, 0.012), ..none },
        Kind::ExtraParts => {
            // In steps: shapes are kept between sessions.
            let tool_m = (0.05 * (2 + random.index(4)) as f64) * (reach_m / USUAL_REACH_M);
            let (which, either) = (random.index(4), random.uniform() < 0.5);
            Lab {
                tool_m: if which == 0 || (which == 3 && either) { tool_m } else { 0.0 },
                cable: which == 1 || which == 3,
                cover: which == 2 || (which == 3 && !either),
                ..none
            }
        }
        Kind::PassersBy => Lab {
            passers_by: 1 + random.index(4),
            other_rooms: if random.uniform() < 0.5 { random.between(0.1, 0.5) } else { 0.0 },
            ..none
        },
        Kind::SecondArm => {
            let moves = random.uniform() < 0.5;
            Lab { second_arm: if moves { SecondArm::Moving } else { SecondArm::Still }, ..none }
        }
        Kind::CameraPattern => Lab { fixed_pattern: random.between(0.5, 1.5), ..none },
        _ => none,
    }
}

const TAU: f64 = std::f64::consts::TAU;

/// Of good sessions, those that have nothing the matter.
const PLAIN: f64 = 0.4;

fn any_kind(random: &mut Random) -> Kind {
    let spoiled = random.uniform() < 0.5;
    if !spoiled && random.uniform() < PLAIN {
        return Kind::Plain;
    }
    let mut kinds = Kind::all(spoiled);
    kinds.retain(|kind| *kind != Kind::Plain);
    kinds[random.index(kinds.len())]
}

/// Up or down, by `least` to `most`.
fn either_way(random: &mut Random, least: f64, most: f64) -> f64 {
    let by = random.between(least, most);
    if random.uniform() < 0.5 { -by } else { by }
}

/// What every lab has: specimens of cameras are long or short by up to two percent, and zeros of joints
/// are off by tenths of a degree.
fn always(random: &mut Random) -> Faults {
    let scale = (0.007 * random.normal()).clamp(-0.02, 0.02);
    Faults {
        depth_scale: 1.0 + scale,
        joint_offset_sigma: random.between(0.0, 0.2).to_radians(),
        ..Faults::default()
    }
}

/// Reach of the arm that [`Ranges::default`] is made for, metres.
const USUAL_REACH_M: f64 = 0.85;

/// Where a camera stands before an arm of `reach_m`: as much nearer as the arm is smaller, but not so
/// near that `sensor` sees nothing.
fn ranges(reach_m: f64, sensor: &Sensor) -> Ranges {
    let scale = reach_m / USUAL_REACH_M;
    let usual = Ranges::default();
    let [low, high] = usual.distance_m.map(|metres| scale * metres);
    let low = low.max(sensor.range_m[0] + 0.6 * reach_m);
    Ranges {
        workspace_m: usual.workspace_m.map(|metres| scale * metres),
        distance_m: [low, high.max(1.4 * low)],
        ..usual
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_sessions_are_spoiled_and_every_kind_is_there() {
        let drawn: Vec<Session> = (0..2000).map(|n| Session::draw(3, n, None)).collect();
        let spoiled = drawn.iter().filter(|session| session.kind.is_spoiled()).count();
        // Four standard deviations.
        assert!((910..=1090).contains(&spoiled), "{spoiled}");
        for kind in Kind::ALL {
            assert!(drawn.iter().any(|session| session.kind == *kind), "{kind}");
        }
        for robot in BUILT_IN {
            assert!(drawn.iter().any(|session| session.robot == robot), "{}", robot.name);
        }
        assert!(drawn.iter().all(|session| session.sensor != Sensor::IDEAL));
        let scales = drawn.iter().filter(|s| !s.kind.is_spoiled()).map(|s| s.faults.depth_scale);
        assert!(scales.clone().all(|scale| (scale - 1.0).abs() <= 0.020_001));
        assert!(scales.clone().any(|scale| scale > 1.01) && scales.clone().any(|s| s < 0.99));
    }

    /// A spoiled session beside the same one unspoiled tells what the one thing does.
    #[test]
    fn all_else_is_the_same_whatever_the_kind() {
        let plain = Session::draw(5, 17, Some(Kind::Plain));
        for kind in Kind::ALL {
            let session = Session::draw(5, 17, Some(*kind));
            assert_eq!((session.seed, session.robot), (plain.seed, plain.robot));
            assert_eq!(session.viewpoint, plain.viewpoint);
            assert_eq!(
                (session.configurations, session.frames, session.clutter, session.sensor.name),
                (plain.configurations, plain.frames, plain.clutter, plain.sensor.name)
            );
            let changed = session.faults != plain.faults || session.tampering.is_some();
            assert_eq!(changed, *kind != Kind::Plain, "{kind}");
        }
    }
}

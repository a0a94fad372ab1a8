//! A session that is fed what a recording has comes to the recording's answer.

use crate::simulated::{CONFIGURATIONS, messages, record};
use eyebolt::calibrate::Verdict;
use eyebolt::pipeline::{self, Outcome, Request};
use eyebolt_live::{Assessment, Event, Goal, Incoming, Session};
use eyebolt_recording::{
    BagOptions, BagRecording, FrameSource, GrowingRecording, JointNotes, SessionWriter,
};
use eyebolt_robot::{Arm, PackageRoots, Robot};
use std::fs::File;
use std::path::Path;

fn arm_of(urdf: &str) -> Arm {
    let robot = Robot::from_urdf_str(urdf, None, &PackageRoots::default()).unwrap();
    robot.arm(Some("link0"), Some("hand")).unwrap()
}

fn calibrate(source: &dyn FrameSource, arm: &Arm) -> Outcome {
    pipeline::run(&Request::new(source, arm), &()).unwrap()
}

fn open(path: &Path) -> BagRecording {
    BagRecording::open(path, &BagOptions::default()).unwrap()
}

/// What a session came to.
struct Ran {
    taken: usize,
    assessments: Vec<Assessment>,
    met: bool,
    arm: Arm,
}

/// Feeds `heard` to a session that is recorded at `path`, and ends it as if it was killed.
fn run(heard: &[Incoming], path: &Path, goal: &str) -> Ran {
    let mut writer = SessionWriter::new(File::create(path).unwrap()).unwrap();
    let mut growing = GrowingRecording::new(path, BagOptions::default());
    let mut session = Session::new(goal.parse::<Goal>().unwrap(), JointNotes::default());
    let (mut arm, mut met) = (None, false);
    let (mut taken, mut assessments) = (0, Vec::new());
    for message in heard {
        let mut events = session.hear(message);
        writer
            .write(&message.topic, &message.message_type, message.received_ns, &message.data)
            .unwrap();
        while !events.is_empty() {
            let mut more = Vec::new();
            for event in events.drain(..) {
                match event {
                    Event::Description(text) => {
                        session.set_arm(arm_of(&text));
                        arm = Some(arm_of(&text));
                    }
                    Event::Taken { configuration } => {
                        assert_eq!(configuration, taken);
                        taken += 1;
                    }
                    Event::Calibrate => {
                        writer.flush().unwrap();
                        let arm = arm.as_ref().unwrap();
                        let assessment =
                            Assessment::of(&calibrate(&growing.now().unwrap(), arm), arm);
                        assessments.push(assessment.clone());
                        more.extend(session.calibrated(Some(assessment)));
                    }
                    Event::GoalMet => met = true,
                    Event::Known { .. } | Event::Lost { .. } | Event::Unreadable { .. } => {
                        panic!("{event:?}")
                    }
                    _ => {}
                }
            }
            events = more;
        }
        if met {
            break;
        }
    }
    writer.flush().unwrap();
    // Dropped, it would write its index.
    std::mem::forget(writer);
    Ran { taken, assessments, met, arm: arm.unwrap() }
}

#[test]
fn a_session_comes_to_the_answer_of_the_recording() {
    let folder = tempfile::tempdir().unwrap();
    let (recorded, session) =
        (folder.path().join("recorded.mcap"), folder.path().join("session.mcap"));
    record(&recorded, 3);
    let heard = messages(&recorded);
    // A goal that nothing meets: all of it is heard.
    let ran = run(&heard, &session, "0.0001mm,0.0001deg");
    assert_eq!((ran.taken, ran.met), (CONFIGURATIONS, false));

    // As if it was killed: it has no index, and is read to its end all the same.
    let (offline, live) = (open(&recorded), open(&session));
    assert_eq!(live.damage().len(), 1, "that it was cut short is said");
    assert_eq!(live.frame_names(), offline.frame_names());
    let (offline, live) = (calibrate(&offline, &ran.arm), calibrate(&live, &ran.arm));
    assert_eq!(offline.calibration.verdict, Verdict::Trusted);
    let [a, b] = [&offline, &live].map(|outcome| outcome.calibration.camera_from_base.unwrap());
    let (metres, radians) = a.distance_to(&b);
    assert!(metres < 1e-6 && radians < 1e-6, "{metres} {radians}");

    // The last answer of the session was of the same frames, but for those of the last rest that came after.
    let last = ran.assessments.last().unwrap();
    assert_eq!(last.configurations, CONFIGURATIONS);
    let expected = live.calibration.error.unwrap().expected;
    let [mm, _] = last.expected_mm_deg.unwrap();
    assert!((mm - 1e3 * expected.translation_m).abs() < 0.2 * mm);
    // It grows as configurations are taken, from three on.
    let counts: Vec<usize> = ran.assessments.iter().map(|a| a.configurations).collect();
    assert_eq!(counts, (3..=CONFIGURATIONS).collect::<Vec<_>>());
}

#[test]
fn a_session_ends_when_its_goal_is_met() {
    let folder = tempfile::tempdir().unwrap();
    let (recorded, session) =
        (folder.path().join("recorded.mcap"), folder.path().join("session.mcap"));
    record(&recorded, 4);
    let ran = run(&messages(&recorded), &session, "5mm,0.3deg");
    assert!(ran.met && ran.taken <= CONFIGURATIONS, "{}", ran.taken);
    let last = ran.assessments.last().unwrap();
    let [mm, deg] = last.expected_mm_deg.unwrap();
    assert!(last.trusted && mm <= 5.0 && deg <= 0.3);
    for before in &ran.assessments[..ran.assessments.len() - 1] {
        let met = before.expected_mm_deg.is_some_and(|[mm, deg]| mm <= 5.0 && deg <= 0.3);
        assert!(!before.trusted || !met);
    }
}

//! Sessions from beginning to end.

use eyebolt::robots::BuiltIn;
use eyebolt::study::{Ending, Kind, Session, SessionResult, Study, Tampering, run, try_session};
use eyebolt_registration::LinkCache;
use eyebolt_render::{Mode, Sensor};
use std::path::PathBuf;
use std::sync::LazyLock;

/// Made anew for each run of the tests.
static CACHE: LazyLock<LinkCache> = LazyLock::new(|| {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("study-cache");
    let _ = std::fs::remove_dir_all(&folder);
    LinkCache::new(folder)
});

/// A session that is small enough for a test: a perfect camera of few pixels before one robot.
fn small(kind: Kind) -> Session {
    let mode = Mode { width: 320, height: 240, focal_px: 262.5 };
    Session {
        sensor: Sensor { mode, ..Sensor::IDEAL },
        robot: BuiltIn::named("shackle").unwrap(),
        viewpoint: eyebolt::simulate::Viewpoint::Within(eyebolt::simulate::Ranges::default()),
        configurations: 5,
        frames: 1,
        clutter: 2,
        backgrounds: 0,
        ..Session::draw(11, 3, Some(kind))
    }
}

fn tried(session: Session) -> SessionResult {
    try_session(session, &CACHE, &|| 0.0)
}

#[test]
fn a_plain_session_is_found_and_trusted() {
    let result = tried(small(Kind::Plain));
    assert!(result.ending.is_right() && result.ending.is_trusted(), "{:?}", result.ending);
    let Ending::Answered(answered) = &result.ending else { panic!("it has an answer") };
    let (error, expected) = (answered.error.unwrap(), answered.expected.unwrap());
    assert!(error.translation_m < 0.003, "{error:?}");
    let [half, nine, most] = answered.quantiles.unwrap();
    assert!(half.translation_m < nine.translation_m && nine.translation_m < most.translation_m);
    // Half of the errors are below the root mean square, and nearly all below its double.
    assert!(half.translation_m < 1.01 * expected.translation_m, "{half:?} {expected:?}");
    assert!(most.translation_m < 2.2 * expected.translation_m, "{most:?} {expected:?}");
    assert_eq!(answered.error_after_bump, None);
}

#[test]
fn a_bumped_camera_is_found_and_the_answer_is_of_where_it_was_last() {
    let result = tried(small(Kind::Bump));
    let Ending::Answered(answered) = &result.ending else { panic!("{:?}", result.ending) };
    let after = answered.error_after_bump.unwrap();
    assert!(after.translation_m < 0.003, "{after:?}");
    assert_eq!(answered.error, Some(after));
}

/// The joints' names and all that moves are those of the arm described: another variant.
#[test]
fn a_base_that_is_elsewhere_is_found_out() {
    let lower = |base_lower_m: f64| {
        let mut session = small(Kind::LowerBase);
        session.faults.base_lower_m = base_lower_m;
        session
    };
    let result = tried(lower(0.05));
    let Ending::Answered(answered) = &result.ending else { panic!("{:?}", result.ending) };
    let error = answered.error.unwrap();
    assert!((error.translation_m - 0.05).abs() < 0.005, "{error:?}");
    let reasons: Vec<&str> = answered.refusals.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(reasons, ["base_elsewhere"]);
    let shift = answered.still_part.unwrap().shift_m;
    assert!((shift.z + 0.05).abs() < 0.005 && shift.xy().norm() < 0.005, "{shift:?}");
    // One that is higher stands in the table as it is described.
    let result = tried(lower(-0.05));
    let Ending::Answered(answered) = &result.ending else { panic!("{:?}", result.ending) };
    let error = answered.error.unwrap();
    assert!((error.translation_m - 0.05).abs() < 0.005, "{error:?}");
    let reasons: Vec<&str> = answered.refusals.iter().map(|r| r.name.as_str()).collect();
    assert!(
        ["base_elsewhere", "inaccurate"].iter().any(|known| reasons == [*known]),
        "{reasons:?}"
    );
    // Millimetres are hardly to be seen, and inside the 95 % bound of what the answer says of itself.
    let result = tried(lower(0.005));
    let Ending::Answered(answered) = &result.ending else { panic!("{:?}", result.ending) };
    let (error, expected) = (answered.error.unwrap(), answered.expected.unwrap());
    assert!(error.translation_m <= 1.95 * expected.translation_m, "{error:?} {expected:?}");
    let plain = tried(small(Kind::Plain));
    let Ending::Answered(plain) = &plain.ending else { panic!("{:?}", plain.ending) };
    let still = plain.still_part.unwrap();
    assert!(still.seen_through < 1.0 && still.shift_m.norm() < 0.005, "{still:?}");
}

#[test]
fn what_is_wrong_with_a_recording_is_told_at_the_door_or_refused() {
    for tampering in [Tampering::DepthUnit(1000.0), Tampering::DepthUnit(0.001), Tampering::Degrees]
    {
        let session = Session { tampering: Some(tampering.clone()), ..small(Kind::WrongUnit) };
        let result = tried(session);
        assert!(!result.ending.is_trusted(), "{tampering}: {:?}", result.ending);
        assert!(!result.ending.refusals().is_empty());
    }
}

#[test]
fn a_camera_that_sees_no_arm_counts_nowhere() {
    let mut session = small(Kind::Plain);
    session.sensor.range_m = [5.0, 6.0];
    session.configurations = 1;
    assert!(matches!(tried(session).ending, Ending::Unfit(_)));
}

/// Everything of a session but how long it took.
fn told(study: &Study) -> Vec<String> {
    let mut told = Vec::new();
    let summary =
        run(study, &CACHE, &|| 0.0, &(), |result| told.push(format!("{result:?}"))).unwrap();
    told.push(format!("{summary:?}"));
    told
}

#[test]
fn sessions_are_those_of_the_seed_in_order_on_any_number_of_threads() {
    let study = Study { first: 0, sessions: 3, seed: 2, only: Some(Kind::WrongUnit), threads: 1 };
    let expected = told(&study);
    assert_eq!(expected.len(), 4);
    for (number, line) in expected[..3].iter().enumerate() {
        assert!(line.contains(&format!("number: {number},")), "{line}");
    }
    assert!(told(&Study { threads: 3, ..study.clone() }) == expected);
    let last = Study { first: 2, sessions: 1, ..study.clone() };
    assert!(told(&last)[0] == expected[2], "one by itself is the same");
    assert!(told(&Study { seed: 3, ..study }) != expected);
}

#[test]
fn whoever_wants_an_end_gets_one() {
    struct Impatient;
    impl eyebolt::progress::Progress for Impatient {
        fn begin(&self, _: &'static str) -> Result<(), eyebolt::progress::Cancelled> {
            Ok(())
        }
        fn advance(&self, _: usize, _: usize) -> Result<(), eyebolt::progress::Cancelled> {
            Err(eyebolt::progress::Cancelled)
        }
    }
    let study = Study { first: 0, sessions: 500, seed: 2, only: Some(Kind::WrongUnit), threads: 1 };
    let mut count = 0;
    assert!(run(&study, &CACHE, &|| 0.0, &Impatient, |_| count += 1).is_err());
    assert!(count <= 1, "nothing more is done");
}

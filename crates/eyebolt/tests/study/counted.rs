//! What is counted, of sessions whose ends are made up.

use eyebolt::calibrate::Deviation;
use eyebolt::study::{Answered, Ending, Kind, Refusal, Session, SessionResult, Summary};

fn off(mm: f64, deg: f64) -> Deviation {
    Deviation { translation_m: 1e-3 * mm, rotation_rad: deg.to_radians() }
}

fn ended(kind: Kind, ending: Ending) -> SessionResult {
    let session = Session::draw(1, 1, Some(kind));
    SessionResult { session, ending, simulate_s: 2.0, calibrate_s: 1.0 }
}

fn answer(kind: Kind, error: Deviation, refused: bool) -> SessionResult {
    let refusal = Refusal { name: "misplaced".to_owned(), text: "a link is elsewhere".to_owned() };
    let answered = Answered {
        still_part: None,
        error: Some(error),
        error_after_bump: None,
        expected: Some(off(2.0, 0.2)),
        quantiles: Some([off(1.0, 0.1), off(3.0, 0.3), off(4.0, 0.4)]),
        refusals: if refused { vec![refusal] } else { Vec::new() },
    };
    ended(kind, Ending::Answered(answered))
}

#[test]
fn right_and_wrong_trusted_and_refused() {
    let mut summary = Summary::default();
    for result in [
        answer(Kind::Plain, off(0.5, 0.05), false),
        answer(Kind::Plain, off(3.5, 0.35), false),
        answer(Kind::Plain, off(9.9, 0.59), false),
        answer(Kind::Plain, off(1.0, 0.61), false),
        answer(Kind::Plain, off(1.0, 0.1), true),
        answer(Kind::Bump, off(10.1, 0.1), false),
        answer(Kind::Bump, off(1.0, 0.1), true),
        answer(Kind::Bump, off(50.0, 4.0), true),
        ended(Kind::Gloss, Ending::Unfit("hidden".to_owned())),
        ended(Kind::Gloss, Ending::Failed(Refusal { name: "error".into(), text: String::new() })),
    ] {
        summary.add(&result);
    }
    let (good, spoiled) = (summary.all(false), summary.all(true));
    let plain = &summary.kinds[&Kind::Plain];
    assert_eq!((plain.sessions, plain.right, plain.trusted), (5, 4, 4));
    assert_eq!((plain.false_acceptances, plain.false_refusals, plain.right_but_refused), (1, 1, 0));
    assert_eq!((good.sessions, good.unfit, good.false_refusals), (6, 1, 2));
    assert_eq!((spoiled.sessions, spoiled.right, spoiled.trusted), (3, 1, 1));
    assert_eq!((spoiled.false_acceptances, spoiled.false_refusals), (1, 0));
    assert_eq!(spoiled.right_but_refused, 1);
    assert_eq!(good.refusals.get("error"), Some(&1));
    assert_eq!(spoiled.refusals.get("misplaced"), Some(&2));
    assert_eq!((summary.told(), good.simulate_s, spoiled.calibrate_s), (10, 14.0, 3.0));
    // Of the four that are trusted.
    assert_eq!(plain.coverage.answers, 4);
    assert_eq!(plain.coverage.translation, [2, 2, 3]);
    assert_eq!(plain.coverage.rotation, [1, 1, 2]);
    let median = plain.median_error().unwrap();
    assert!((median.translation_m - 3.5e-3).abs() < 1e-12);
}

//! What the page says.

use crate::sample::{GOOD, PAGE, all_reasons, escaped, page, refused, without_pose};
use eyebolt::calibrate::Reason;
use eyebolt::report::{Context, html, overlays};
use eyebolt_registration::{ArmLink, ArmModel};

/// Checks that nothing in `page` would be fetched from anywhere.
#[track_caller]
fn assert_complete(page: &str) {
    for word in ["http://", "https://", "@import", "url(", "<link", "<iframe", "srcset="] {
        assert!(!page.contains(word), "{word}");
    }
    for (attribute, inside) in [("src=", "\"data:image/png;base64,"), ("href=", "\"#")] {
        for rest in page.split(attribute).skip(1) {
            assert!(rest.starts_with(inside), "{attribute}{}", &rest[..40]);
        }
    }
    assert!(page.contains("Content-Security-Policy\" content=\"default-src 'none'"));
}

#[test]
fn it_is_complete_in_itself() {
    assert_complete(&PAGE);
    assert!(PAGE.matches("src=").count() == 5, "a picture of each configuration");
    assert!(PAGE.len() < 10_000_000, "{} bytes", PAGE.len());
}

#[test]
fn it_tells_the_verdict_and_the_answers_numbers() {
    let answer = &GOOD.answer;
    let expected = answer.expected_error.unwrap();
    let mut shown = vec![
        "Trusted".to_owned(),
        format!("{:.1}<small> mm", expected.translation_mm),
        format!("{:.2}°", expected.rotation_deg),
        "4<small> of 5</small>".to_owned(),
        escaped("bags/monday.mcap"),
        format!("eyebolt {}, seed {}", answer.version, answer.seed),
        answer.urdf_hash.clone(),
        "0.12 mm</b> and <b>0.046°".to_owned(),
    ];
    let poses = [answer.base_from_camera.as_ref(), answer.camera_from_base.as_ref()];
    for pose in poses.map(Option::unwrap) {
        shown.extend(pose.matrix.as_flattened().iter().map(|value| format!("{value:.8}")));
        shown.push(pose.translation_m.map(|value| format!("{value:.6}")).join(" "));
        shown.push(pose.rotation_xyzw.map(|value| format!("{value:.9}")).join(" "));
    }
    for frame in &answer.configurations {
        let reason = frame.reason.iter().map(|reason| escaped(reason));
        shown.extend(frame.residual_mm.iter().map(|mm| format!("{mm:.1}")).chain(reason));
    }
    for text in shown {
        assert!(PAGE.contains(&text), "{text}");
    }
    assert!(!PAGE.contains("Refused"));
}

#[test]
fn the_command_carries_the_pose_to_the_last_digit() {
    let (_, rest) = PAGE.split_once("static_transform_publisher ").unwrap();
    let words: Vec<&str> = rest.split_once("</pre>").unwrap().0.split_whitespace().collect();
    let value = |flag: &str| words[words.iter().position(|word| *word == flag).unwrap() + 1];
    let pose = GOOD.answer.base_from_camera.as_ref().unwrap();
    let numbers = pose.translation_m.iter().chain(&pose.rotation_xyzw);
    for (flag, number) in ["--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw"].iter().zip(numbers)
    {
        assert_eq!(value(flag).parse::<f64>().unwrap(), *number, "{flag}");
    }
    assert_eq!(value("--frame-id"), GOOD.answer.frames.base);
    assert_eq!(Some(value("--child-frame-id")), GOOD.answer.frames.camera.as_deref());
}

#[test]
fn the_sources_add_up_and_the_jackknife_is_within_its_bound() {
    let (_, rest) = PAGE.split_once("share of mm²").unwrap();
    let (table, _) = rest.split_once("</table>").unwrap();
    let cells = table.split("<td class=\"number\">").skip(1);
    let cells = cells.map(|cell| cell.split_once('<').unwrap().0.parse::<f64>().unwrap());
    let millimetres: Vec<f64> = cells.step_by(2).collect();
    let [parts @ .., total] = &millimetres[..] else { panic!("{millimetres:?}") };
    let [_scatter, jackknife, _description, _disagreement] = parts else { panic!("{parts:?}") };
    let sum = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
    assert!((sum - total).abs() < 0.15, "{millimetres:?}");
    // (n - 1) / n times the sum of squares about the mean is at most that about the answer.
    let used = 4.0f64;
    let rms = GOOD.answer.leave_one_out.as_ref().unwrap().rms.translation_mm;
    assert!(*jackknife <= (used - 1.0).sqrt() * rms + 0.06, "{jackknife} {rms}");
}

#[test]
fn every_reason_is_told_with_something_to_do() {
    let (answer, outcome) = refused(&GOOD, all_reasons());
    let page = page(&answer, &outcome);
    assert!(page.contains("Refused") && !page.contains("Trusted"));
    for reason in all_reasons() {
        let text = format!("<li><p>{}</p><ul><li>", escaped(&reason.to_string()));
        assert!(page.contains(&text), "{text}");
    }
    assert!(!page.contains("static_transform_publisher"), "nothing to copy by mistake");
    assert!(page.contains("not for use"));
}

#[test]
fn without_a_pose_there_still_is_a_page() {
    let (answer, outcome) = without_pose(&GOOD, vec![Reason::NothingFound]);
    let page = html(&answer, &outcome, &Context::default());
    assert_complete(&page);
    assert!(page.contains("no pose was found") && page.contains("eyebolt info"));
    assert!(!page.contains("<svg class=\"plot\"") && !page.contains("<canvas"));
}

#[test]
fn it_tells_what_became_of_the_frames_without_the_arm() {
    let told = |background| {
        let mut answer = GOOD.answer.clone();
        answer.background = background;
        html(&answer, &GOOD.outcome, &Context::default())
    };
    let (none, used, other) = (told(None), told(Some("used")), told(Some("of_another_scene")));
    assert!(none.contains("by what moves between") != GOOD.answer.masks);
    assert!(used.contains("before the frames without it") != GOOD.answer.masks);
    let note = "show another scene";
    assert!(other.contains(note) && !used.contains(note) && !none.contains(note));
}

#[test]
fn names_from_outside_are_text() {
    const EVIL: &str = "</script><img src=x onerror=alert(1)>\"'&<!--";
    let (mut answer, mut outcome) = (GOOD.answer.clone(), GOOD.outcome.clone());
    let observations = outcome.observations.as_mut().unwrap();
    let links = observations.arm.links().iter();
    let renamed =
        links.map(|link| ArmLink { name: format!("{EVIL}{}", link.name), ..link.clone() });
    observations.arm = ArmModel::new(renamed.collect());
    observations.configurations[0].frames[0] = EVIL.to_owned();
    outcome.calibration.configurations[0].frames[0] = EVIL.to_owned();
    answer.configurations[0].name = EVIL.to_owned();
    answer.configurations[2].reason = Some(EVIL.to_owned());
    answer.frames.camera = Some(EVIL.to_owned());
    answer.frames.base = EVIL.to_owned();
    answer.frames.end_effector = EVIL.to_owned();
    answer.robot = EVIL.to_owned();
    answer.unplaced_joints = vec![EVIL.to_owned()];
    let pictures: Vec<_> = overlays(&outcome, |_| None).collect();
    let context = Context { recording: EVIL, pictures: &pictures, ..Context::default() };
    let page = html(&answer, &outcome, &context);
    // Only what is ours opens a tag.
    assert!(!page.contains(EVIL) && !page.contains("<img src=x") && !page.contains("<!--"));
    assert_eq!(page.matches("</script>").count(), PAGE.matches("</script>").count());
    assert_complete(&page.replace("img src=x", ""));
}

#[test]
fn the_bytes_are_the_same_again_and_on_any_number_of_threads() {
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| page(&GOOD.answer, &GOOD.outcome))
    };
    assert!(bytes(1) == *PAGE);
    assert!(bytes(2) == *PAGE);
}

/// The page without these elements.
fn without(page: &str, element: &str) -> String {
    let (begin, end) = (format!("<{element}"), format!("</{element}>"));
    let mut parts = page.split(&begin);
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once(&end).map_or("", |(_, rest)| rest))
}

#[test]
fn what_nobody_knows_is_no_word_of_programs() {
    let (mut answer, outcome) = without_pose(&GOOD, all_reasons());
    answer.frames.camera = None;
    for row in &mut answer.configurations {
        (row.used, row.reason, row.residual_mm) = (false, None, None);
    }
    for shown in [page(&answer, &outcome), PAGE.clone()] {
        let shown = without(shown.split_once("</head>").unwrap().1, "script");
        let words: Vec<_> = shown.split(|c: char| !c.is_alphabetic()).collect();
        assert!(!words.contains(&"none") && !words.contains(&"None"), "{shown}");
    }
}

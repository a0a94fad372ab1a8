//! The page in a browser.

use crate::chromium::{browser, show};
use crate::sample::{GOOD, PAGE, all_reasons, page, without_pose};
use serde_json::{Value, json};
use std::path::Path;

/// What `probe.js` found in `page` while it did what a person would do.
fn probed(browser: &Path, page: &str, flags: &[&str]) -> Value {
    let (watch, probe) = (include_str!("watch.js"), include_str!("probe.js"));
    let watched = page.replacen("<head>", &format!("<head><script>{watch}</script>"), 1);
    let shown = show(browser, &format!("{watched}<script>{probe}</script>"), flags);
    let found = shown.dom.split_once("<pre id=\"found\">").expect("the probe came to its end").1;
    let text = found.split_once("</pre>").unwrap().0;
    let plain = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    serde_json::from_str(&plain).unwrap()
}

#[test]
fn the_untouched_file_opens_without_a_word_on_the_console() {
    let Some(browser) = browser() else { return };
    let shown = show(&browser, &PAGE, &[]);
    assert!(shown.dom.contains("id=\"view\"") && shown.dom.contains("copy</button>"));
    assert!(!shown.log.contains("CONSOLE"), "{}", shown.log);
}

#[test]
fn the_view_turns_and_all_is_drawn_without_the_network() {
    let Some(browser) = browser() else { return };
    let found = probed(&browser, &PAGE, &[]);
    let share = |name: &str| found[name].as_f64().unwrap();
    assert!(share("drawn") > 0.05, "{found}");
    for act in ["drag", "wheel", "pinch", "key", "colour", "robot", "camera", "configuration"] {
        assert!(share(act) > 0.001, "{act}: {found}");
    }
    // The wheel alone, and a finger up or down, are the page's.
    assert_eq!((&found["wheel_scrolls"], &found["touch"]), (&json!(true), &json!("pan-y")));
    for quiet in ["hover", "reset", "scroll"] {
        assert_eq!(found[quiet], 0, "{quiet}: {found}");
    }
    assert_eq!(found["problems"], json!([]));
    assert_eq!(found["requests"], json!([]));
    assert_eq!(found["pictures"], json!([true, true, true, true, true]));
    assert_eq!(found["configurations"], 5);
    let base = GOOD.answer.frames.base.as_str();
    let camera = GOOD.answer.frames.camera.as_deref().unwrap();
    assert_eq!(found["names"], json!([base, "x", "y", "z", camera, "x", "y", "z"]));
    let links = GOOD.outcome.observations.as_ref().unwrap().arm.links().len();
    let marks = json!({
        "surfaces-by-configuration": 5,
        "surfaces-by-link": links,
        "outlines-by-configuration": 5,
        "outlines-by-link": links,
        "leave-one-out": 2 * 4,
        "deviations": 2 * 3,
        "correlations": 21,
    });
    assert_eq!(found["marks"], marks);
}

#[test]
fn it_fits_on_a_telephone() {
    let Some(browser) = browser() else { return };
    // No window is as narrow, but a frame in one is.
    let page = serde_json::to_string(PAGE.as_str()).unwrap().replace('<', "\\u003c");
    let measure = "const root = telephone.contentDocument.documentElement; \
                   document.title = `${root.clientWidth} ${root.scrollWidth}`;";
    let wrapper = format!(
        "<!DOCTYPE html><iframe id=\"telephone\" width=\"360\" height=\"700\" style=\"border: 0\">\
         </iframe><script>telephone.onload = () => {{ {measure} }}; telephone.srcdoc = {page};\
         </script>"
    );
    let shown = show(&browser, &wrapper, &["--hide-scrollbars"]);
    let widths = shown.dom.split_once("<title>").and_then(|(_, rest)| rest.split_once("</title>"));
    assert_eq!(widths.map(|(widths, _)| widths), Some("360 360"));
}

#[test]
fn without_webgl_the_page_says_so() {
    let Some(browser) = browser() else { return };
    let shown = show(&browser, &PAGE, &["--disable-3d-apis"]);
    assert!(shown.dom.contains("<p id=\"no-view\">"), "the words are shown");
    assert!(shown.dom.contains("tabindex=\"0\" aria-label") && !shown.log.contains("Uncaught"));
}

#[test]
fn a_refusal_without_a_pose_opens_too() {
    let Some(browser) = browser() else { return };
    let (answer, outcome) = without_pose(&GOOD, all_reasons());
    let shown = show(&browser, &page(&answer, &outcome), &[]);
    assert!(shown.dom.contains("Refused") && !shown.log.contains("CONSOLE"), "{}", shown.log);
}

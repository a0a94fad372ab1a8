//! The page in a browser.

use crate::cdp::{Browser, Tab};
use crate::client::until;
use crate::feed::{Fed, heard, is_image, serve, serve_at};
use eyebolt_live::{Asked, Phase, Web};
use std::path::Path;

fn url(web: &Web) -> String {
    format!("http://{}/", web.address())
}

const CONNECTED: &str = "document.getElementById('lamp').textContent === 'connected'";

/// Text of an element of the page.
fn text(tab: &Tab<'_>, id: &str) -> String {
    tab.value(&format!("document.getElementById('{id}').innerText")).as_str().unwrap().to_owned()
}

/// How many pixels of the picture are of the outline, and of the ghost's edge.
const LINES: &str = "(async () => {
  const image = document.getElementById('picture');
  await image.decode();
  const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  const of = ([r, g, b]) => { let count = 0; for (let at = 0; at < data.length; at += 4)
    if (data[at] === r && data[at + 1] === g && data[at + 2] === b) count += 1; return count; };
  return [of([40, 255, 70]), of([170, 195, 255])];
})()";

#[test]
fn a_session_is_shown_from_its_beginning_to_its_end_and_then_the_next() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let heard = heard(folder.path(), 3);
    let web = serve();
    let address = web.address();
    let (tab, second) = (browser.open(&url(&web)), browser.open(&url(&web)));
    for tab in [&tab, &second] {
        tab.until(CONNECTED);
    }
    let mut fed = Fed::new(&web, folder.path());
    heard.iter().for_each(|message| fed.hear(message));
    tab.until("document.getElementById('count').textContent === '6'");
    assert_eq!(tab.value("document.querySelectorAll('#plot-mm circle').length"), 0);
    fed.calibrate();
    let image = heard.iter().rfind(is_image).unwrap();
    for tab in [&tab, &second] {
        tab.until("document.querySelectorAll('#plot-mm circle').length === 2");
        tab.until("!document.getElementById('ghost-line').hidden");
    }
    until("somebody waits", || web.board().wants_sight(image.received_ns + 1_000_000_000));
    web.board().show(image.clone(), fed.session.joints().clone());
    // The outline, and the ghost.
    tab.until(&format!("(await {LINES}).every((count) => count > 200)"));
    assert_eq!(tab.value("document.querySelectorAll('#joints tr').length"), 7);
    assert_eq!(tab.value("document.querySelectorAll('#joints .to').length"), 7);
    assert!(text(&tab, "next-word").contains("the next that would tell most"));
    assert!(text(&tab, "said").contains("configuration 6 taken"));
    save_screenshots(&tab);

    tab.value("document.getElementById('capture').click()");
    until("it was asked", || web.asked() == Some(Asked::Capture));
    // An end is asked for twice.
    tab.value("document.getElementById('end').click()");
    assert_eq!(web.asked(), None);
    tab.value("document.getElementById('end').click()");
    until("it was asked", || web.asked() == Some(Asked::End));

    web.board().publish_report(
        b"<!DOCTYPE html><title>r</title><p id=r>the report<script>r.textContent='ran'</script>"
            .to_vec(),
    );
    let done = Phase::Done {
        trusted: true,
        written_to: "calibration.json".to_owned(),
        expected_mm_deg: Some([1.5, 0.05]),
        report: true,
    };
    web.board().update(|account| account.phase = done);
    tab.until("document.getElementById('word').textContent === 'Trusted'");
    // The report's own script may run in it, and nothing else.
    let report = browser.open(&format!("{}report", url(&web)));
    report.until("document.getElementById('r').textContent === 'ran'");
    drop(fed);
    drop(web);
    for tab in [&tab, &second] {
        tab.until("document.getElementById('lamp').textContent === 'eyebolt has ended'");
        tab.until("document.getElementById('report').href.startsWith('blob:')");
    }
    let kept = tab.value("fetch(document.getElementById('report').href).then((kept) => kept.text(), () => 'refused')");
    // To be saved, and not to be read by scripts of the page.
    assert_eq!(kept, "refused");
    let problems = tab.problems();
    assert!(
        problems
            .iter()
            .all(|problem| problem.contains("ERR_CONNECTION") || problem.contains("blob:")),
        "{problems:?}"
    );

    let next = serve_at(&address.to_string());
    next.board().update(|account| account.say("another session"));
    for tab in [&tab, &second] {
        tab.until(CONNECTED);
        tab.until("document.getElementById('said').innerText.includes('another session')");
        assert_eq!((text(tab, "count"), text(tab, "joints")), ("0".to_owned(), String::new()));
        assert_eq!(tab.value("document.getElementById('picture').hidden"), true);
        assert_eq!(tab.value("document.getElementById('report').hidden"), true);
    }
}

/// Into the folder that `EYEBOLT_SCREENSHOTS` names, for people.
fn save_screenshots(tab: &Tab<'_>) {
    let Some(folder) = std::env::var_os("EYEBOLT_SCREENSHOTS") else { return };
    for (name, size) in [("desktop", [1200, 800]), ("telephone", [390, 800])] {
        for scheme in ["light", "dark"] {
            tab.screen(size, scheme);
            let file = Path::new(&folder).join(format!("{name}-{scheme}.png.base64"));
            std::fs::write(file, tab.screenshot()).unwrap();
        }
    }
}

#[test]
fn other_pages_get_nothing_and_press_nothing() {
    let Some(browser) = Browser::start() else { return };
    let (web, other) = (serve(), serve());
    let own = browser.open(&url(&web));
    own.until(CONNECTED);
    let try_it = format!(
        "(async () => {{
          const of = (path) => '{}' + path;
          const tried = async (work) => {{ try {{ return await work(); }} catch {{ return 'refused'; }} }};
          return [
            await tried(() => fetch(of('state')).then((answer) => answer.text())),
            await tried(() => fetch(of('capture'), {{ method: 'POST', mode: 'no-cors' }}).then((answer) => answer.type)),
            await tried(() => fetch(of('end'), {{ method: 'POST', headers: {{ 'X-Own': '1' }} }}).then(() => 'pressed')),
          ];
        }})()",
        url(&web)
    );
    // What the page itself may do, it can.
    let tried = own.value(&try_it);
    assert!(tried[0].as_str().unwrap().contains("\"tag\"") && tried[2] == "pressed", "{tried}");
    assert_eq!((web.asked(), web.asked()), (Some(Asked::Capture), Some(Asked::End)));
    // From another page of this machine, and from one without an origin; whatever policies these have of their own.
    for page in [url(&other), "about:blank".to_owned()] {
        let elsewhere = browser.open("about:blank");
        elsewhere.call("Page.setBypassCSP", &serde_json::json!({ "enabled": true }));
        elsewhere.call("Page.navigate", &serde_json::json!({ "url": page }));
        elsewhere.until("document.readyState === 'complete'");
        let tried = elsewhere.value(&try_it);
        assert_eq!(tried, serde_json::json!(["refused", "refused", "refused"]), "{page}");
        assert_eq!(web.asked(), None, "{page}");
    }
}

#[test]
fn it_fits_on_a_telephone_and_nothing_is_wrong_on_the_console() {
    let Some(browser) = Browser::start() else { return };
    let web = serve();
    web.board().update(|account| {
        account.say(&"a line without a break".replace(' ', "_").repeat(20));
        account.say(
            "<script>document.title = 'no'</script><img src=x onerror=\"document.title='no'\">",
        );
        account.phase = Phase::Failed { problem: "/a/path/".repeat(30) };
    });
    let tab = browser.open(&url(&web));
    for scheme in ["light", "dark"] {
        tab.screen([360, 700], scheme);
        tab.until(CONNECTED);
        tab.until("document.getElementById('said').innerText.includes('onerror')");
        let widths = tab
            .value("[document.documentElement.clientWidth, document.documentElement.scrollWidth]");
        assert_eq!(widths, serde_json::json!([360, 360]));
    }
    assert_ne!(tab.value("document.title"), "no");
    assert_eq!(tab.problems(), [""; 0]);
}

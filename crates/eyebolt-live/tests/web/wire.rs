//! The page over a wire.

use crate::client::{Answer, answered, ask, connect, exchange, get, until};
use crate::feed::{Fed, heard, is_image, serve, serve_at};
use eyebolt_live::{Asked, Incoming};
use eyebolt_robot::JointPositions;
use proptest::prelude::*;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::LazyLock;

static HEARD: LazyLock<Vec<Incoming>> =
    LazyLock::new(|| heard(tempfile::tempdir().unwrap().path(), 5));

fn picture(png: &[u8]) -> (u32, u32) {
    let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    (reader.info().width, reader.info().height)
}

#[test]
fn two_sessions_at_once_have_a_page_each() {
    let (one, other) = (serve(), serve());
    one.board().update(|account| account.say("this one"));
    let told = [one.address(), other.address()].map(|address| get(address, "/state").json());
    assert_ne!(told[0]["session"], told[1]["session"]);
    assert_eq!(
        (&told[0]["said"][0], &told[1]["said"][0]),
        (&"this one".into(), &serde_json::Value::Null)
    );
}

#[test]
fn whoever_comes_back_after_a_session_sees_the_next() {
    let first = serve();
    let address = first.address();
    first.board().update(|account| account.say("before"));
    let tag = get(address, "/state").json()["tag"].as_str().unwrap().to_owned();
    drop(first);
    assert!(TcpStream::connect(address).is_err());
    let second = serve_at(&address.to_string());
    let told = get(second.address(), &format!("/state?after={tag}")).json();
    assert!(told["tag"] != tag.as_str() && told["said"].as_array().unwrap().is_empty());
}

#[test]
fn the_last_state_and_the_report_are_handed_over_before_the_end() {
    let web = serve();
    let address = web.address();
    let report = vec![b'x'; 8 << 20];
    let length = report.len();
    let mut stream = connect(address);
    let request = |path: &str| format!("GET {path} HTTP/1.1\r\nHost: {address}\r\n\r\n");
    // As a page does: it has the state, waits for news, and asks for the report when there is one.
    stream.write_all(request("/state").as_bytes()).unwrap();
    let first = one_answer(&mut stream);
    stream
        .write_all(request(&format!("/state?after={}", first["tag"].as_str().unwrap())).as_bytes())
        .unwrap();
    let page = std::thread::spawn(move || {
        let last = one_answer(&mut stream);
        (last["said"][0].as_str().map(str::to_owned), get(address, "/report").body.len())
    });
    web.board().publish_report(report);
    web.board().update(|account| account.say("done"));
    drop(web);
    assert_eq!(page.join().unwrap(), (Some("done".to_owned()), length));
}

/// The JSON of one answer, and not a byte more.
fn one_answer(stream: &mut TcpStream) -> serde_json::Value {
    let mut head = Vec::new();
    while !head.ends_with(b"\r\n\r\n") {
        let mut byte = [0];
        stream.read_exact(&mut byte).unwrap();
        head.extend(byte);
    }
    let head = String::from_utf8(head).unwrap().to_lowercase();
    let length = head.split("content-length: ").nth(1).and_then(|rest| rest.split("\r\n").next());
    let mut body = vec![0; length.unwrap().parse().unwrap()];
    stream.read_exact(&mut body).unwrap();
    serde_json::from_slice(&body).unwrap()
}

#[test]
fn buttons_are_for_the_page_alone() {
    let web = serve();
    let address = web.address();
    let capture = |headers: &str| ask(address, "POST", "/capture", headers).status;
    let port = address.port();
    for origin in
        ["http://evil.example", "null", &format!("http://localhost:{port}"), "http://127.0.0.1:1"]
    {
        assert_eq!(capture(&format!("Origin: {origin}\r\n")), 403, "{origin}");
    }
    assert_eq!(capture(""), 403);
    assert_eq!(web.asked(), None);
    assert_eq!(capture(&format!("Origin: http://{address}\r\n")), 204);
    assert_eq!(web.asked(), Some(Asked::Capture));
    // A name that somebody had point here.
    let rebound =
        format!("GET /state HTTP/1.1\r\nHost: evil.example:{port}\r\nConnection: close\r\n\r\n");
    assert_eq!(answered(address, &rebound).status, 403);
}

#[test]
fn pictures_are_made_for_those_who_wait_alone() {
    let web = serve();
    let board = web.board();
    let image = HEARD.iter().find(is_image).unwrap();
    assert!(!board.wants_sight(image.received_ns));
    let address = web.address();
    let page = std::thread::spawn(move || get(address, "/picture"));
    until("somebody waits", || board.wants_sight(image.received_ns));
    board.show(image.clone(), JointPositions::default());
    let Answer { status, body, .. } = page.join().unwrap();
    assert_eq!((status, picture(&body)), (200, (640, 480)));
    assert!(!board.wants_sight(image.received_ns + 1_000_000_000), "nobody waits any more");
}

/// Sends all images to a page that asks as fast as it gets, and then nothing that was not asked for.
#[test]
fn whatever_comes_in_pictures_are_few() {
    let web = serve();
    let board = web.board();
    let address = web.address();
    let page = std::thread::spawn(move || {
        let mut tag = String::new();
        let mut pictures = 0;
        loop {
            let answer = get(address, &format!("/picture?after={tag}"));
            let Some(next) = answer.header("eyebolt-tag").filter(|_| answer.status == 200) else {
                return pictures;
            };
            assert!(next > tag.as_str() || next.len() > tag.len(), "each is newer");
            tag = next.to_owned();
            pictures += 1;
        }
    });
    let image = HEARD.iter().find(is_image).unwrap();
    until("somebody waits", || board.wants_sight(0));
    let mut shown = 0;
    // Ten seconds of 30 Hz, as fast as they can be handed over.
    for turn in 0..300_i64 {
        let received_ns = turn * 33_333_333;
        if board.wants_sight(received_ns) {
            board.show(Incoming { received_ns, ..image.clone() }, JointPositions::default());
            shown += 1;
            if turn < 250 {
                until("it is back", || board.wants_sight(received_ns + 1_000_000_000));
            }
        }
    }
    // Five a second at most.
    assert!((10..=55).contains(&shown), "{shown}");
    // Then nothing comes, and the page is told so.
    assert!(page.join().unwrap() <= shown);
}

#[test]
fn who_does_not_read_holds_up_nobody() {
    let web = serve();
    let address = web.address();
    web.board().publish_report(vec![b'x'; 32 << 20]);
    let request = |path: &str| format!("GET {path} HTTP/1.1\r\nHost: {address}\r\n\r\n");
    let slow: Vec<_> = (0..8)
        .map(|turn| {
            let mut stream = connect(address);
            // Asks for much, again and again, and reads nothing.
            let path = if turn % 2 == 0 { "/report" } else { "/state" };
            stream.write_all(request(path).repeat(20).as_bytes()).unwrap();
            stream
        })
        .collect();
    // The session goes on, and others see the latest of it.
    for turn in 0..20_000 {
        web.board().update(|account| account.say(&format!("line {turn}")));
    }
    let told = get(address, "/state").json();
    assert_eq!(told["said"].as_array().unwrap().last().unwrap(), "line 19999");
    // Who was slow gets whole answers all the same, the last of them new.
    for (turn, mut stream) in slow.into_iter().enumerate().filter(|(turn, _)| turn % 2 == 1) {
        stream.shutdown(std::net::Shutdown::Write).unwrap();
        let mut said = String::new();
        stream.read_to_string(&mut said).unwrap();
        assert!(said.matches("HTTP/1.1 200").count() >= 1, "{turn}");
    }
}

/// Whether the other side has hung up.
fn is_closed(mut stream: &TcpStream) -> bool {
    stream.set_nonblocking(true).unwrap();
    !matches!(stream.read(&mut [0]), Err(error) if error.kind() == ErrorKind::WouldBlock)
}

#[test]
fn who_holds_connections_shuts_nobody_out() {
    let web = serve();
    let held: Vec<_> = (0..300).map(|_| connect(web.address())).collect();
    assert_eq!(get(web.address(), "/").status, 200);
    until("the oldest makes room", || is_closed(&held[0]) && is_closed(&held[200]));
    assert!(!is_closed(&held[299]));
}

/// Requests that are none, or of something else: an upgrade to a websocket and frames of one among them.
fn malformed(address: SocketAddr) -> Vec<Vec<u8>> {
    let head =
        |first: &str, more: &str| format!("{first}\r\nHost: {address}\r\n{more}\r\n").into_bytes();
    let upgrade = head(
        "GET /state HTTP/1.1",
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n",
    );
    let frames =
        [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f, 0x80, 0x00, 0x01, 0xfe];
    vec![
        b"\r\n\r\n".to_vec(),
        b"GET".to_vec(),
        b"GET / HTTP/9.9\r\n\r\n".to_vec(),
        b"GET / HTTP/1.0\r\n\r\n".to_vec(),
        vec![0; 100_000],
        vec![0xff; 100_000],
        vec![b'a'; 1_000_000],
        head(&format!("GET /{} HTTP/1.1", "a".repeat(60_000)), ""),
        head("GET / HTTP/1.1", &"X: y\r\n".repeat(5000)),
        head("GET / HTTP/1.1", &format!("X: {}\r\n", "y".repeat(200_000))),
        head("POST /capture HTTP/1.1", "Content-Length: 99999999999999999999\r\n"),
        head("POST /capture HTTP/1.1", "Content-Length: -1\r\n"),
        head("POST /capture HTTP/1.1", "Content-Length: 5\r\nContent-Length: 6\r\n"),
        head("POST /capture HTTP/1.1", "Transfer-Encoding: chunked\r\n")
            .into_iter()
            .chain(*b"fffffffffffffffff\r\n")
            .collect(),
        head("GET /state?after=%ff%00&after=&after HTTP/1.1", "Connection: close\r\n"),
        head("CONNECT evil.example:80 HTTP/1.1", ""),
        head("GET http://evil.example/ HTTP/1.1", ""),
        b"GET /../../etc/passwd HTTP/1.1\r\nHost: \xff\xfe\r\n\r\n".to_vec(),
        b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n".to_vec(),
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03".to_vec(),
        upgrade.into_iter().chain(frames).collect(),
    ]
}

#[test]
fn requests_that_are_none_harm_nobody() {
    let web = serve();
    for request in malformed(web.address()) {
        exchange(web.address(), &request);
        assert_eq!(
            get(web.address(), "/state").status,
            200,
            "{:?}",
            String::from_utf8_lossy(&request[..request.len().min(60)])
        );
    }
    assert_eq!(web.asked(), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever stands in place of a request, cut off or changed anywhere.
    #[test]
    fn changed_requests_harm_nobody(
        cut in 0..200_usize, at in 0..200_usize, byte in any::<u8>(), rest in proptest::collection::vec(any::<u8>(), 0..300),
    ) {
        static WEB: LazyLock<(SocketAddr, std::sync::Mutex<eyebolt_live::Web>)> = LazyLock::new(|| {
            let web = serve();
            (web.address(), std::sync::Mutex::new(web))
        });
        let address = WEB.0;
        let mut bytes = format!(
            "POST /capture?after=1 HTTP/1.1\r\nHost: {address}\r\nContent-Length: 3\r\nOrigin: http://evil.example\r\n\r\nabc"
        ).into_bytes();
        bytes.truncate(cut);
        if let Some(changed) = bytes.get_mut(at) {
            *changed = byte;
        }
        bytes.extend(rest);
        exchange(address, &bytes);
        prop_assert_eq!(get(address, "/state").status, 200);
        prop_assert_eq!(WEB.1.lock().unwrap().asked(), None);
    }
}

#[test]
fn messages_that_are_no_pictures_make_none() {
    let web = serve();
    let board = web.board();
    let image = HEARD.iter().find(is_image).unwrap();
    let address = web.address();
    let page = std::thread::spawn(move || get(address, "/picture"));
    until("somebody waits", || board.wants_sight(0));
    for length in [0, 3, 40, 100, 10_000] {
        let data = image.data[..length].to_vec();
        board.show(Incoming { data, ..image.clone() }, JointPositions::default());
    }
    board.show(image.clone(), JointPositions::default());
    assert_eq!(page.join().unwrap().status, 200);
}

#[test]
fn a_session_is_told_from_its_first_message_to_its_assessment() {
    let web = serve();
    let folder = tempfile::tempdir().unwrap();
    let mut fed = Fed::new(&web, folder.path());
    let told = || get(web.address(), "/state").json();
    assert_eq!(told()["standing"]["missing"], serde_json::json!([]), "nothing was told yet");
    HEARD.iter().for_each(|message| fed.hear(message));
    let before = told();
    assert_eq!(before["standing"]["missing"], serde_json::json!([]));
    assert_eq!(before["standing"]["configurations"], crate::simulated::CONFIGURATIONS);
    assert_eq!(
        (&before["next"], &before["coverage"]),
        (&serde_json::Value::Null, &serde_json::Value::Null)
    );
    fed.calibrate();
    let after = told();
    let joints = after["standing"]["joints"].as_array().unwrap();
    assert_eq!(joints.len(), 7);
    let names = |list: &serde_json::Value| -> Vec<String> {
        list.as_array()
            .unwrap()
            .iter()
            .map(|one| one["joint"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(names(&after["next"]["joints"]), names(&after["standing"]["joints"]));
    for (joint, next) in joints.iter().zip(after["next"]["joints"].as_array().unwrap()) {
        let [low, high] = [0, 1].map(|end| joint["between"][end].as_f64().unwrap());
        assert!((low..=high).contains(&next["at"].as_f64().unwrap()), "{joint} {next}");
    }
    let [expected, with_it] = [&after["quality"][0], &after["next"]]
        .map(|one| one["expected_mm_deg"][0].as_f64().unwrap());
    assert!(with_it < expected, "it tells something: {with_it} {expected}");
    let links = after["coverage"]["links"].as_array().unwrap();
    assert!(
        links
            .iter()
            .any(|link| link["link"] == "hand"
                && link["seen_in"] == crate::simulated::CONFIGURATIONS)
    );
    for joint in after["coverage"]["joints"].as_array().unwrap() {
        assert_eq!(joint["at_deg"].as_array().unwrap().len(), crate::simulated::CONFIGURATIONS);
    }
}

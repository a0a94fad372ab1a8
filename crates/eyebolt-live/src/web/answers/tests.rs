//! Answers to single requests, without a wire.

use super::*;
use crate::goal::Goal;
use crate::web::account::Account;
use http_body_util::BodyExt;
use std::pin::pin;
use std::sync::mpsc::{Receiver, sync_channel};
use std::task::{Context, Waker};

fn site() -> (Site, Receiver<Asked>) {
    let account = Account::new(&Goal::default(), "session.mcap".to_owned());
    let board = Arc::new(Board::new("a".to_owned(), account));
    let origin = OriginCheck::new(&"127.0.0.1:8642".parse().unwrap());
    let (asked, asks) = sync_channel(1);
    (Site { board, origin, asked }, asks)
}

const HERE: &str = "127.0.0.1:8642";

/// Status, headers and body of the answer.
fn ask(site: &Site, method: &str, uri: &str, origin: Option<&str>) -> (u16, Answer, Vec<u8>) {
    let mut request = Request::builder().method(method).uri(uri).header("host", HERE);
    if let Some(origin) = origin {
        request = request.header("origin", origin);
    }
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build();
    runtime.unwrap().block_on(async {
        let answer = site.answer(&request.body(()).unwrap()).await;
        let (head, body) = answer.into_parts();
        let bytes = body.collect().await.unwrap().to_bytes().to_vec();
        (head.status.as_u16(), Response::from_parts(head, Full::default()), bytes)
    })
}

#[test]
fn each_place_has_its_methods() {
    let (site, _asks) = site();
    let own = Some("http://127.0.0.1:8642");
    for (method, uri, status) in [
        ("GET", "/", 200),
        ("HEAD", "/", 200),
        ("GET", "/?a=b", 200),
        ("POST", "/", 405),
        ("GET", "/state", 200),
        ("GET", "/state?after=b-1", 200),
        ("DELETE", "/state", 405),
        ("GET", "/report", 404),
        ("GET", "/capture", 405),
        ("POST", "/capture", 204),
        ("BREW", "/capture", 405),
        ("GET", "/favicon.ico", 204),
        ("GET", "/nothing", 404),
        ("GET", "/state/", 404),
        ("OPTIONS", "*", 404),
    ] {
        let (found, answer, _) = ask(&site, method, uri, own);
        assert_eq!(found, status, "{method} {uri}");
        assert_eq!(answer.headers().contains_key("allow"), status == 405);
        assert!(
            answer.headers()["content-security-policy"]
                .to_str()
                .unwrap()
                .contains("default-src 'none'")
        );
        assert!(!answer.headers().contains_key("access-control-allow-origin"));
    }
}

#[test]
fn asks_are_handed_on_and_too_many_are_not() {
    let (site, asks) = site();
    assert_eq!(ask(&site, "POST", "/capture", None).0, 403);
    assert_eq!(ask(&site, "POST", "/capture", Some("http://evil.example")).0, 403);
    assert!(asks.try_recv().is_err());
    assert_eq!(ask(&site, "POST", "/end", Some("http://127.0.0.1:8642")).0, 204);
    assert_eq!(ask(&site, "POST", "/capture", Some("http://127.0.0.1:8642")).0, 429);
    assert_eq!(asks.try_recv(), Ok(Asked::End));
}

#[test]
fn the_nonce_of_the_page_is_that_of_its_policy() {
    let (site, _asks) = site();
    let [(_, a, page), (_, b, _)] = [(); 2].map(|()| ask(&site, "GET", "/", None));
    let policy =
        |answer: &Answer| answer.headers()["content-security-policy"].to_str().unwrap().to_owned();
    assert_ne!(policy(&a), policy(&b));
    let (_, rest) = String::from_utf8(page)
        .unwrap()
        .split_once("<script nonce=\"")
        .map(|(a, b)| (a.to_owned(), b.to_owned()))
        .unwrap();
    assert!(
        policy(&a).contains(&format!("script-src 'nonce-{}'", rest.split('"').next().unwrap()))
    );
}

#[test]
fn what_is_known_is_not_told_again() {
    let (site, _asks) = site();
    let told = |body: Vec<u8>| -> serde_json::Value { serde_json::from_slice(&body).unwrap() };
    let first = told(ask(&site, "GET", "/state", None).2);
    assert_eq!((&first["tag"], &first["phase"]["is"]), (&"a-1".into(), &"listening".into()));
    site.board.update(|account| account.say("hello"));
    let second = told(ask(&site, "GET", "/state?after=a-1", None).2);
    assert_eq!((&second["tag"], &second["said"][0]), (&"a-2".into(), &"hello".into()));
    // Another session's number says nothing.
    assert_eq!(told(ask(&site, "GET", "/state?after=b-2", None).2)["tag"], "a-2");
    let mut waits = pin!(site.board.account_after(Some("a-2")));
    let mut context = Context::from_waker(Waker::noop());
    assert!(waits.as_mut().poll(&mut context).is_pending());
    site.board.update(|account| account.say("and now"));
    assert!(waits.poll(&mut context).is_ready());
}

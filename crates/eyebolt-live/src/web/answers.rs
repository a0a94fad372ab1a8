//! What is answered to whom.

use super::board::Board;
use super::origin::OriginCheck;
use super::page;
use http_body_util::Full;
use hyper::body::Bytes;
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::{Method, Request, Response, StatusCode};
use std::sync::Arc;
use std::sync::mpsc::SyncSender;
use std::time::Duration;

/// What is answered to whom.
pub(super) struct Site {
    pub(super) board: Arc<Board>,
    pub(super) origin: OriginCheck,
    /// To the session.
    pub(super) asked: SyncSender<Asked>,
}

/// What somebody asked for on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// To take the configuration now.
    Capture,
    /// To end the session, and calibrate with what is there.
    End,
}

type Answer = Response<Full<Bytes>>;

/// Nobody is kept waiting longer for something new: a page then asks again, and proxies do not give up.
const HOLD: Duration = Duration::from_secs(5);

const HTML: &str = "text/html; charset=utf-8";
const JSON: &str = "application/json";
const PNG: &str = "image/png";
const TEXT: &str = "text/plain; charset=utf-8";
/// The name of what is in an answer, for the next question.
pub(super) const TAG: &str = "eyebolt-tag";

impl Site {
    /// The answer to a request, whose body is not looked at.
    pub(super) async fn answer<B>(&self, request: &Request<B>) -> Answer {
        let (method, uri) = (request.method(), request.uri());
        if let Err(refusal) = self.origin.admit(method, uri, request.headers()) {
            return plain(StatusCode::FORBIDDEN, refusal.text());
        }
        let changes = match uri.path() {
            "/" | "/state" | "/picture" | "/report" | "/favicon.ico" => false,
            "/capture" | "/end" => true,
            _ => return plain(StatusCode::NOT_FOUND, "there is nothing here"),
        };
        let allowed = if changes {
            method == Method::POST
        } else {
            [Method::GET, Method::HEAD].contains(method)
        };
        if !allowed {
            let mut refusal = plain(StatusCode::METHOD_NOT_ALLOWED, "not asked in this way");
            let methods = if changes { "POST" } else { "GET, HEAD" };
            refusal.headers_mut().insert(header::ALLOW, HeaderValue::from_static(methods));
            return refusal;
        }
        let after =
            uri.query().unwrap_or_default().split('&').find_map(|part| part.strip_prefix("after="));
        match uri.path() {
            "/" => self.page(),
            "/state" => self.state(after).await,
            "/picture" => self.picture(after).await,
            "/report" => self.report(),
            "/capture" => self.ask(Asked::Capture),
            "/end" => self.ask(Asked::End),
            _ => plain(StatusCode::NO_CONTENT, ""),
        }
    }

    fn page(&self) -> Answer {
        let nonce = page::nonce();
        let mut answer = respond(StatusCode::OK, HTML, page::page(&nonce));
        set(&mut answer, header::CONTENT_SECURITY_POLICY, &page::policy(&nonce));
        answer
    }

    async fn state(&self, after: Option<&str>) -> Answer {
        match tokio::time::timeout(HOLD, self.board.account_after(after)).await {
            Ok(json) => respond(StatusCode::OK, JSON, json),
            Err(_) => plain(StatusCode::NO_CONTENT, ""),
        }
    }

    async fn picture(&self, after: Option<&str>) -> Answer {
        match tokio::time::timeout(HOLD, self.board.picture_after(after)).await {
            Ok((tag, png)) if !png.is_empty() => {
                let mut answer = respond(StatusCode::OK, PNG, png);
                set(&mut answer, HeaderName::from_static(TAG), &tag);
                answer
            }
            _ => plain(StatusCode::NO_CONTENT, ""),
        }
    }

    fn report(&self) -> Answer {
        let Some(report) = self.board.report() else {
            return plain(StatusCode::NOT_FOUND, "there is no report yet: the session goes on");
        };
        let mut answer = respond(StatusCode::OK, HTML, report);
        // As its own head says, which cannot say who may frame it.
        set(&mut answer, header::CONTENT_SECURITY_POLICY, page::REPORT_POLICY);
        answer
    }

    fn ask(&self, what: Asked) -> Answer {
        match self.asked.try_send(what) {
            Ok(()) => plain(StatusCode::NO_CONTENT, ""),
            // Pressed faster than the session looks.
            Err(_) => plain(
                StatusCode::TOO_MANY_REQUESTS,
                "the session has not looked at the last ones yet",
            ),
        }
    }
}

fn plain(status: StatusCode, text: &'static str) -> Answer {
    respond(status, TEXT, text)
}

fn respond(status: StatusCode, kind: &'static str, body: impl Into<Bytes>) -> Answer {
    let mut answer = Response::new(Full::new(body.into()));
    *answer.status_mut() = status;
    let fixed = [
        (header::CONTENT_TYPE, kind),
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CONTENT_SECURITY_POLICY, "default-src 'none'; frame-ancestors 'none'"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ];
    answer.headers_mut().extend(fixed.map(|(name, value)| (name, HeaderValue::from_static(value))));
    answer
}

fn set(answer: &mut Answer, name: HeaderName, value: &str) {
    // Of letters, digits and signs of ours.
    if let Ok(value) = HeaderValue::from_str(value) {
        answer.headers_mut().insert(name, value);
    }
}

#[cfg(test)]
mod tests;

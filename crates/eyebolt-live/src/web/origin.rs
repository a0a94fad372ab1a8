//! Who may ask: the page itself, whoever types its address, and no other page.
//!
//! A browser sends requests for every page that is open in it. What other pages send names another origin; what they send
//! after they have had a name of theirs point to this machine (DNS rebinding) names that name as the host.

use hyper::header::{HOST, HeaderMap, HeaderName, HeaderValue, ORIGIN};
use hyper::http::uri::Authority;
use hyper::{Method, Uri};
use std::net::{IpAddr, SocketAddr};

/// Tells who may ask: a check of host and origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct OriginCheck {
    /// Nobody but this machine reaches the page.
    loopback: bool,
}

/// Why somebody may not ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// It is not this page's host that is asked.
    Host,
    /// Another page asks.
    Origin,
}

impl Refusal {
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Host => {
                "this page answers to localhost and to addresses in numbers; open it by one of them"
            }
            Self::Origin => "another page may not ask this",
        }
    }
}

/// What a person gets to by a link, wherever that stands.
const PAGES: [&str; 2] = ["/", "/report"];

impl OriginCheck {
    /// Of what is served at `address`.
    pub(super) fn new(address: &SocketAddr) -> Self {
        Self { loopback: address.ip().is_loopback() }
    }

    /// Whether a request may be answered.
    pub(super) fn admit(
        &self,
        method: &Method,
        uri: &Uri,
        headers: &HeaderMap,
    ) -> Result<(), Refusal> {
        let host = only(headers, &HOST).ok_or(Refusal::Host)?.ok_or(Refusal::Host)?;
        // What names another host in its first line is meant for a proxy.
        let asked = uri.authority().is_none_or(|authority| authority.as_str() == host);
        if !(asked && self.is_ours(host)) {
            return Err(Refusal::Host);
        }
        let own = |origin: &str| {
            origin.strip_prefix("http://").is_some_and(|of| of.eq_ignore_ascii_case(host))
        };
        let from_here = match only(headers, &ORIGIN).ok_or(Refusal::Origin)? {
            Some(origin) => own(origin),
            // Browsers tell it with all that changes something.
            None => [Method::GET, Method::HEAD].contains(method),
        };
        if from_here && is_own_site(method, uri, headers) { Ok(()) } else { Err(Refusal::Origin) }
    }

    /// Whether `host` is a name that nobody else can have: an address, or `localhost`.
    fn is_ours(&self, host: &str) -> bool {
        let Ok(authority) = host.parse::<Authority>() else { return false };
        if host.contains('@') {
            return false;
        }
        let name = authority.host();
        let port = host.get(name.len()..).unwrap_or_default();
        if !port.is_empty() && authority.port().is_none() {
            return false;
        }
        let ip = name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>();
        match ip {
            Ok(ip) => !self.loopback || ip.is_loopback(),
            Err(_) => name.eq_ignore_ascii_case("localhost"),
        }
    }
}

/// Whether what browsers tell of who asks, if they do, is that it is the page or a person.
fn is_own_site(method: &Method, uri: &Uri, headers: &HeaderMap) -> bool {
    let told =
        |name: &'static str| headers.get(HeaderName::from_static(name)).map(HeaderValue::as_bytes);
    let by_link = told("sec-fetch-mode") == Some(b"navigate")
        && *method == Method::GET
        && PAGES.contains(&uri.path());
    matches!(told("sec-fetch-site"), None | Some(b"same-origin" | b"none")) || by_link
}

/// The header's only value, `Some(None)` without one; `None` if it stands there twice or is no text.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<Option<&'a str>> {
    let mut values = headers.get_all(name).iter();
    let first = values.next();
    if values.next().is_some() {
        return None;
    }
    first.map(|value| value.to_str().ok()).map_or(Some(None), |text| text.map(Some))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admitted(
        at: &str,
        method: Method,
        uri: &str,
        headers: &[(&'static str, &str)],
    ) -> Result<(), Refusal> {
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            map.append(*name, value.parse().unwrap());
        }
        OriginCheck::new(&at.parse().unwrap()).admit(&method, &uri.parse().unwrap(), &map)
    }

    const HERE: &str = "127.0.0.1:8642";
    const EVERYWHERE: &str = "0.0.0.0:8642";

    #[test]
    fn hosts_are_addresses_or_this_machine() {
        let get = |at, host: &str| admitted(at, Method::GET, "/state", &[("host", host)]);
        for host in [
            "127.0.0.1:8642",
            "localhost:8642",
            "LOCALHOST:9",
            "localhost",
            "[::1]:8642",
            "127.0.0.9",
        ] {
            assert_eq!(get(HERE, host), Ok(()), "{host}");
            assert_eq!(get(EVERYWHERE, host), Ok(()), "{host}");
        }
        for host in ["192.168.1.7:8642", "[fe80::1]:8642"] {
            assert_eq!(get(HERE, host), Err(Refusal::Host), "{host}");
            assert_eq!(get(EVERYWHERE, host), Ok(()), "{host}");
        }
        for host in [
            "evil.example",
            "localhost.evil.example:8642",
            "127.0.0.1.evil.example",
            "a@localhost",
            "",
            "local host",
            "localhost:x",
        ] {
            assert_eq!(get(HERE, host), Err(Refusal::Host), "{host}");
            assert_eq!(get(EVERYWHERE, host), Err(Refusal::Host), "{host}");
        }
        let none = admitted(HERE, Method::GET, "/", &[]);
        let two = admitted(HERE, Method::GET, "/", &[("host", HERE), ("host", "evil.example")]);
        let proxy = admitted(HERE, Method::GET, "http://evil.example/", &[("host", HERE)]);
        assert_eq!([none, two, proxy], [Err(Refusal::Host); 3]);
    }

    #[test]
    fn only_the_page_itself_changes_something() {
        let post = |origin: &str| {
            admitted(HERE, Method::POST, "/capture", &[("host", HERE), ("origin", origin)])
        };
        assert_eq!(post("http://127.0.0.1:8642"), Ok(()));
        // Behind a tunnel, the port is another, and the browser says the same in both.
        let tunnel = [("host", "localhost:9000"), ("origin", "http://localhost:9000")];
        assert_eq!(admitted(HERE, Method::POST, "/capture", &tunnel), Ok(()));
        for origin in [
            "null",
            "",
            "http://evil.example",
            "http://localhost:8642",
            "http://127.0.0.1:3000",
            "https://127.0.0.1:8642",
            "127.0.0.1:8642",
        ] {
            assert_eq!(post(origin), Err(Refusal::Origin), "{origin}");
        }
        assert_eq!(
            admitted(HERE, Method::POST, "/capture", &[("host", HERE)]),
            Err(Refusal::Origin)
        );
        let twice = [("host", HERE), ("origin", "http://127.0.0.1:8642"), ("origin", "null")];
        assert_eq!(admitted(HERE, Method::POST, "/capture", &twice), Err(Refusal::Origin));
    }

    #[test]
    fn pages_of_others_get_nothing_but_links() {
        let get = |uri, more: &[(&'static str, &str)]| {
            let mut headers = vec![("host", HERE)];
            headers.extend_from_slice(more);
            admitted(HERE, Method::GET, uri, &headers)
        };
        for site in ["cross-site", "same-site", "rubbish"] {
            for uri in ["/", "/state", "/picture", "/report"] {
                assert_eq!(
                    get(uri, &[("sec-fetch-site", site)]),
                    Err(Refusal::Origin),
                    "{site} {uri}"
                );
            }
            let link = [("sec-fetch-site", site), ("sec-fetch-mode", "navigate")];
            assert_eq!(get("/", &link), Ok(()));
            assert_eq!(get("/picture", &link), Err(Refusal::Origin));
        }
        for site in ["same-origin", "none"] {
            assert_eq!(get("/picture", &[("sec-fetch-site", site)]), Ok(()));
        }
        assert_eq!(get("/state", &[("origin", "http://evil.example")]), Err(Refusal::Origin));
    }
}

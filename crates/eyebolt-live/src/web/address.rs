//! Where the page is served.

use std::fmt;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::str::FromStr;

/// Where the page is served: an address of this machine and a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WebAddress(pub SocketAddr);

const PORT: u16 = 8642;
const LOOPBACK: IpAddr = IpAddr::V4(Ipv4Addr::LOCALHOST);

impl Default for WebAddress {
    /// 127.0.0.1:8642, which this machine alone reaches.
    fn default() -> Self {
        Self(SocketAddr::new(LOOPBACK, PORT))
    }
}

impl fmt::Display for WebAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for WebAddress {
    type Err = String;

    /// As in `127.0.0.1:8642`, `[::1]:8642`, `localhost:8642`; either part may be left out.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "{text:?} is no address of this machine: write 127.0.0.1:8642, or 0.0.0.0:8642 for whoever reaches it"
            )
        };
        if let Ok(address) = text.parse::<SocketAddr>() {
            return Ok(Self(address));
        }
        if let Ok(ip) = text.parse::<IpAddr>() {
            return Ok(Self(SocketAddr::new(ip, PORT)));
        }
        let port = match text.strip_prefix("localhost") {
            Some("") => return Ok(Self::default()),
            Some(rest) => rest.strip_prefix(':').ok_or_else(wrong)?,
            None => text,
        };
        let digits = !port.is_empty() && port.bytes().all(|byte| byte.is_ascii_digit());
        let port = port.parse::<u16>().ok().filter(|_| digits).ok_or_else(wrong)?;
        Ok(Self(SocketAddr::new(LOOPBACK, port)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_part_may_be_left_out() {
        for (text, address) in [
            ("127.0.0.1:8642", "127.0.0.1:8642"),
            ("localhost", "127.0.0.1:8642"),
            ("localhost:80", "127.0.0.1:80"),
            ("9000", "127.0.0.1:9000"),
            ("0.0.0.0", "0.0.0.0:8642"),
            ("::1", "[::1]:8642"),
            ("[::]:1", "[::]:1"),
        ] {
            let read = text.parse::<WebAddress>().unwrap();
            assert_eq!(read.to_string(), address, "{text}");
            assert_eq!(read.to_string().parse(), Ok(read));
        }
        assert_eq!("localhost".parse(), Ok(WebAddress::default()));
    }

    #[test]
    fn what_is_no_address_is_refused() {
        for text in [
            "",
            ":",
            ":80",
            "localhost:",
            "localhosts",
            "here:80",
            "65536",
            "+80",
            "1.2.3",
            "http://127.0.0.1:80",
        ] {
            assert!(text.parse::<WebAddress>().unwrap_err().contains("127.0.0.1:8642"), "{text}");
        }
    }
}

//! The page of a session over a wire, and in a browser.

mod browser;
mod cdp;
mod client;
mod feed;
mod wire;

#[path = "../../../eyebolt/tests/report/chromium.rs"]
#[expect(dead_code, reason = "shared with tests of the report")]
mod chromium;
#[path = "../live/simulated.rs"]
mod simulated;

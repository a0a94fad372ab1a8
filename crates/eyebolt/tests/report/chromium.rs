//! Chromium without a window.

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// What a browser made of a page.
pub struct Shown {
    /// The document when it had come to rest.
    pub dom: String,
    /// What it logged, with a line that holds `CONSOLE` for each of the page's own.
    pub log: String,
}

/// The browser that `EYEBOLT_CHROMIUM` names or that is in `PATH`; `None` said loudly.
pub fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("EYEBOLT_CHROMIUM").map(PathBuf::from);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let in_path = || {
        let folders = std::env::split_paths(&path);
        let files = folders.flat_map(|folder| NAMES.map(|name| folder.join(name)));
        files.into_iter().find(|file| file.is_file())
    };
    let found = named.or_else(in_path);
    if found.is_none() {
        // Past the test harness, which would keep it for itself.
        let remedy = "install chromium, or set EYEBOLT_CHROMIUM to a browser's program";
        let _ = writeln!(std::io::stderr(), "SKIPPED a test of the page in a browser: {remedy}");
    }
    found
}

/// Opens `page` from a file, with more `flags`.
pub fn show(browser: &Path, page: &str, flags: &[&str]) -> Shown {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("page.html");
    std::fs::write(&file, page).unwrap();
    let mut profile = OsString::from("--user-data-dir=");
    profile.push(folder.path().join("profile"));
    let mut command = Command::new(browser);
    command.args(["--headless", "--no-sandbox", "--no-first-run", "--disable-dev-shm-usage"]);
    command.args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]);
    command.args(["--disable-background-networking", "--disable-component-update"]);
    // Time in the page runs as fast as it works, and ends.
    command.args(["--window-size=1000,800", "--virtual-time-budget=20000", "--dump-dom"]);
    command.args(["--enable-logging=stderr", "--log-level=0"]);
    let output = command.args(flags).arg(profile).arg(&file).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Shown { dom: text(output.stdout), log: text(output.stderr) }
}

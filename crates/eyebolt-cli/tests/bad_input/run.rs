//! Runs of the program that have to end soon, and without much memory.

use crate::desk::{Desk, text};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::LazyLock;
use std::sync::mpsc::{self, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Whoever takes longer hangs.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// Address space, of which memory in use is a part, KiB.
const MEMORY_KIB: u32 = 2_000_000;

/// Shapes of links, shared by all tests.
pub static CACHE: LazyLock<Desk> = LazyLock::new(|| Desk::shared("bad-input-cache"));

/// What a run left behind.
pub struct Ended {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

/// `eyebolt` with these arguments, after the shell has run `before`.
pub fn command(before: &str, arguments: &[&str]) -> Command {
    let script = format!("ulimit -v {MEMORY_KIB} 2>/dev/null; {before} exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_eyebolt")]).args(arguments);
    // Every thread takes address space for its stack, and machines differ in how many there are.
    command.env("RAYON_NUM_THREADS", "2");
    // Other robots of whoever runs the tests are none of our business.
    command.env_remove("ROS_PACKAGE_PATH").env_remove("AMENT_PREFIX_PATH");
    command
}

/// Runs `eyebolt` with these arguments.
pub fn eyebolt(arguments: &[&str]) -> Ended {
    end(start(&mut command("", arguments)))
}

/// Arguments of a calibration of `recording`, written to `output`.
pub fn calibration<'a>(recording: &'a Path, output: &'a Path, more: &[&'a str]) -> Vec<&'a str> {
    let cache = text(CACHE.path());
    [&["calibrate", text(recording), "--output", text(output), "--cache", cache], more].concat()
}

pub fn start(command: &mut Command) -> Child {
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).stdin(Stdio::null()).spawn().unwrap()
}

/// Waits until the program has ended; one that does not is killed, and the test fails.
pub fn end(mut child: Child) -> Ended {
    let (sender, ended) = mpsc::channel();
    let out = read(child.stdout.take().unwrap(), sender.clone());
    let err = read(child.stderr.take().unwrap(), sender);
    for _ in 0..2 {
        if ended.recv_timeout(PATIENCE).is_err() {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("not ended after {PATIENCE:?}; it says {}", err.join().unwrap());
        }
    }
    let code = child.wait().unwrap().code();
    Ended { code, out: out.join().unwrap(), err: err.join().unwrap() }
}

/// Reads `stream` to its end, which is that of the program, and tells so.
fn read(mut stream: impl Read + Send + 'static, ended: Sender<()>) -> JoinHandle<String> {
    thread::spawn(move || {
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        // Nobody listens any more to a program that was killed.
        let _ = ended.send(());
        text
    })
}

/// A file among those of another crate's tests.
pub fn fixture(crate_name: &str, name: &str) -> PathBuf {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    crates.join(crate_name).join("tests/fixtures").join(name)
}

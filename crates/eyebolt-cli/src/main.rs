//! The eyebolt program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let this = std::env::current_exe().ok().map(Into::into);
    eyebolt_cli::program(this.as_slice(), std::env::args_os()).into()
}

//! `eyebolt completions` and `eyebolt man`.

use crate::desk::{Desk, text};
use crate::program::eyebolt;
use std::fs;
use std::io::Write;
use std::process::{Command, Stdio};

/// What `shell` says to a script on its standard input; `None` if there is no such shell here.
fn shell(shell: &str, arguments: &[&str], script: &str) -> Option<String> {
    let mut command = Command::new(shell);
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let Ok(mut running) = command.spawn() else {
        let _ = writeln!(std::io::stderr(), "SKIPPED: there is no {shell} here");
        return None;
    };
    running.stdin.take().unwrap().write_all(script.as_bytes()).unwrap();
    let ended = running.wait_with_output().unwrap();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    Some(String::from_utf8(ended.stdout).unwrap())
}

fn completions(shell: &str) -> String {
    let ended = eyebolt(&["completions", shell]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    ended.out
}

/// What bash offers after `words`.
#[test]
fn bash_completes_commands_and_flags() {
    let offered = |words: &[&str]| {
        let script = format!(
            "{}\nCOMP_WORDS=({}); COMP_CWORD={}; _eyebolt eyebolt {:?} ''; printf '%s\\n' \"${{COMPREPLY[@]}}\"\n",
            completions("bash"),
            words.join(" "),
            words.len() - 1,
            words.last().unwrap()
        );
        let said = shell("bash", &["--norc"], &script)?;
        Some(said.lines().map(str::to_owned).collect::<Vec<_>>())
    };
    let Some(commands) = offered(&["eyebolt", "ca"]) else { return };
    assert_eq!(commands, ["calibrate"]);
    assert_eq!(offered(&["eyebolt", "batch", "--sha"]).unwrap(), ["--shard"]);
}

#[test]
fn zsh_and_fish_can_read_theirs() {
    for (name, arguments) in [("zsh", &["-n"][..]), ("fish", &["--no-execute"])] {
        let script = completions(name);
        for word in ["calibrate", "record-command", "shard"] {
            assert!(script.contains(word), "no {word:?} for {name}");
        }
        shell(name, arguments, &script);
    }
    eyebolt(&["completions", "sh"]).assert_error(2, &["sh", "bash", "zsh", "fish"]);
}

#[test]
fn every_command_has_a_page() {
    let desk = Desk::new();
    let ended = eyebolt(&["man", "-o", text(desk.path())]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    let help = eyebolt(&["--help"]).out;
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let commands = commands.take_while(|line| *line != "Options:").filter(|line| {
        line.starts_with("  ") && !line.starts_with("   ") && !line.starts_with("  help")
    });
    let mut pages = vec!["eyebolt.1".to_owned()];
    pages.extend(
        commands.map(|line| format!("eyebolt-{}.1", line.split_whitespace().next().unwrap())),
    );
    pages.sort();
    assert!(pages.len() > 15, "{pages:?}");
    assert_eq!(desk.names(), pages);
    let calibrate = fs::read_to_string(desk.file("eyebolt-calibrate.1")).unwrap();
    for word in [".TH", "eyebolt\\-calibrate", "\\-\\-max\\-error\\-mm", "SYNOPSIS"] {
        assert!(calibrate.contains(word), "no {word:?} in {calibrate}");
    }
    assert_eq!(eyebolt(&["man", "calibrate"]).out, calibrate);
    eyebolt(&["man", "-o", text(desk.path())]).assert_error(1, &["exists", "--force"]);
    eyebolt(&["man", "nothing"]).assert_error(1, &["nothing", "eyebolt --help"]);
}

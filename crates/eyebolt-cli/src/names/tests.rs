//! Every input has a flag, and no library names one.

use super::*;
use clap::CommandFactory;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_input_has_a_flag() {
    let program = crate::Arguments::command();
    let commands = program.get_subcommands().flat_map(clap::Command::get_arguments);
    let flags: BTreeSet<String> =
        commands.filter_map(|a| a.get_long()).map(|long| format!("--{long}")).collect();
    for input in Input::ALL {
        assert!(flags.contains(&flag(*input)), "{input}: there is no {}", flag(*input));
    }
}

#[test]
fn flags_stand_where_inputs_stood() {
    let said =
        in_flags("give argument `max_motion`, or argument `depth_topic`; link `base` is none");
    assert_eq!(said, "give --max-motion-deg, or --depth-topic; link `base` is none");
}

/// Flags of other programs that the libraries speak of.
const OTHERS: [&str; 12] = [
    "--once",
    "--full-length",
    "--chunksize",
    "--x",
    "--y",
    "--z",
    "--qx",
    "--qy",
    "--qz",
    "--qw",
    "--frame-id",
    "--child-frame-id",
];

/// Python and the page have no flags, so the libraries must not speak of ours.
#[test]
fn libraries_name_no_flags_of_this_program() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = vec![crates];
    let mut seen = 0;
    while let Some(path) = files.pop() {
        if path.is_dir() {
            let skipped = ["eyebolt-cli", "eyebolt-net", "tests", "examples", "target"];
            if !skipped.iter().any(|name| path.ends_with(name)) {
                files.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            }
            continue;
        }
        if path.extension().is_none_or(|ending| ending != "rs") || path.ends_with("tests.rs") {
            continue;
        }
        seen += 1;
        let text = std::fs::read_to_string(&path).unwrap();
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        for word in
            code.flat_map(|line| line.split(|c: char| !(c.is_ascii_lowercase() || c == '-')))
        {
            let is_flag = word.len() > 3 && word.starts_with("--") && !word.starts_with("---");
            assert!(!is_flag || OTHERS.contains(&word), "{}: {word}", path.display());
        }
    }
    assert!(seen > 300, "only {seen} files were looked at");
}

//! README.md and docs/: their commands are the program's, and their samples are what it prints.

use crate::desk::{Desk, text};
use crate::program::{CACHE, Ended, eyebolt, eyebolt_in};
use std::fs;
use std::path::Path;

const README: &str = include_str!("../../../../README.md");

/// README.md and every page of docs/, each with its name.
fn pages() -> Vec<(String, String)> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let mut pages = vec![("README.md".to_owned(), README.to_owned())];
    for entry in fs::read_dir(docs).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "md") {
            let name = path.file_name().unwrap().to_str().unwrap();
            pages.push((format!("docs/{name}"), fs::read_to_string(&path).unwrap()));
        }
    }
    pages
}

/// What is typed in the indented blocks of a page: arguments of the program.
fn commands(page: &str) -> Vec<Vec<String>> {
    let joined = page.replace("\\\n        ", "");
    let code = |line: &&str| line.starts_with("    ");
    let typed =
        joined.lines().filter(code).filter_map(|line| line.trim_start().strip_prefix("eyebolt "));
    let arguments = |line: &str| {
        let line = line.split(" #").next().unwrap_or_default();
        // What may be left out is given; the shell has its part.
        let line = line.replace(['[', ']'], "").replace("$SLURM_ARRAY_TASK_ID", "3");
        line.split_whitespace().map(str::to_owned).collect()
    };
    typed.map(arguments).collect()
}

fn run(desk: &Desk, arguments: &[String], more: &[&str]) -> Ended {
    let given: Vec<&str> =
        arguments.iter().map(String::as_str).chain(more.iter().copied()).collect();
    eyebolt_in(desk.path(), &given)
}

#[test]
fn every_command_is_understood() {
    let mut count = 0;
    for (name, page) in pages() {
        for command in commands(&page) {
            let given: Vec<&str> =
                command.iter().map(String::as_str).chain(["--no-such-flag"]).collect();
            let ended = eyebolt(&given);
            let all_else_is_right = ended.code == Some(2) && ended.err.contains("--no-such-flag");
            assert!(all_else_is_right, "{name}: {command:?}: {}{}", ended.out, ended.err);
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

/// The first fenced block after the line `    eyebolt demo`.
fn sample() -> &'static str {
    let (_, after) = README.split_once("    eyebolt demo\n").unwrap();
    let (_, block) = after.split_once("```text\n").unwrap();
    block.split_once("```").unwrap().0
}

/// Whether two words are the same, but for the last digits of numbers.
fn alike(a: &str, b: &str) -> bool {
    let number = |word: &str| {
        let digits = |c: char| !c.is_ascii_digit() && c != '-';
        word.trim_matches(digits).parse::<f64>().ok()
    };
    a == b || number(a).zip(number(b)).is_some_and(|(a, b)| (a - b).abs() <= 0.05 + 0.1 * a.abs())
}

#[track_caller]
fn assert_alike(written: &str, said: &str) {
    for (written, said) in written.lines().zip(said.lines()) {
        // How long it took is another time another.
        let whole = |line: &str| {
            line.rsplit_once(" in ").map_or(line.to_owned(), |(what, time)| {
                if time.ends_with(" s:") { what.to_owned() } else { line.to_owned() }
            })
        };
        let (a, b) = (whole(written), whole(said));
        let (a, b): (Vec<_>, Vec<_>) =
            (a.split_whitespace().collect(), b.split_whitespace().collect());
        let same = a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| alike(a, b));
        assert!(same, "README.md: {written}\nthe program: {said}");
    }
}

#[test]
fn what_a_newcomer_types_works_and_says_what_is_written() {
    let desk = Desk::new();
    let cache = ["--cache", text(&CACHE)];
    let demo = run(&desk, &["demo".to_owned()], &cache);
    assert_eq!(demo.code, Some(0), "{}{}", demo.out, demo.err);
    assert_alike(sample(), &demo.out);
    assert!(sample().lines().count() > 10);
    fs::copy(desk.file("eyebolt-demo/session.mcap"), desk.file("my_bag")).unwrap();
    for mut command in commands(README) {
        let mut more: &[&str] = &[];
        match command[0].as_str() {
            // Hours of work, models or pictures: see their own tests.
            _ if command.iter().any(|word| word == "--model" || word == "--marker") => continue,
            "info" | "export" | "evaluate" => {}
            "convert" => command[1] = "my_bag".to_owned(),
            "calibrate" => more = &cache,
            "simulate" => {
                more = &cache;
                fs::remove_file(desk.file("session.mcap")).unwrap();
            }
            _ => continue,
        }
        let ended = run(&desk, &command, more);
        assert_eq!(ended.code, Some(0), "{command:?}: {}{}", ended.out, ended.err);
    }
    for made in ["calibration.json", "report.html", "session.mcap"] {
        assert!(desk.file(made).is_file(), "{made}");
    }
}

//! The options that decide what is in the files of a batch.

use super::arguments::Arguments;
use clap::{ArgMatches, Args as _, Command};
use std::collections::BTreeMap;

/// What only says which recordings, where, how fast and how loud.
const ELSEWHERE: [&str; 10] = [
    "recordings",
    "list",
    "output",
    "shard",
    "merge",
    "retry",
    "json",
    "threads",
    "cache",
    "no_cache",
];

/// Options by the name of their flag, those that were not given with their defaults.
pub type Options = BTreeMap<String, String>;

/// The options that `matches` of the whole program has.
pub fn given(matches: &ArgMatches) -> Options {
    let Some(matches) = matches.subcommand_matches("batch") else { return Options::new() };
    let flags = Arguments::augment_args(Command::new("batch"));
    let mut options = Options::new();
    for flag in flags.get_arguments() {
        let (id, long) = (flag.get_id().as_str(), flag.get_long());
        let Some(long) = long.filter(|_| !ELSEWHERE.contains(&id)) else { continue };
        let Some(values) = matches.get_raw(id) else { continue };
        let values: Vec<_> = values.map(|value| value.to_string_lossy()).collect();
        // Of a flag without a value: it was not given.
        if values.iter().any(|value| value != "false") {
            options.insert(format!("--{long}"), values.join(" "));
        }
    }
    options
}

/// The first option that differs, with what it was in `before` and is in `now`.
pub fn difference(before: &Options, now: &Options) -> Option<String> {
    let names = before.keys().chain(now.keys());
    let differs = |name: &&String| before.get(*name) != now.get(*name);
    let name = names.filter(differs).min()?;
    let said = |options: &Options| match options.get(name).map(String::as_str) {
        Some("true") => "given".to_owned(),
        Some(value) => value.to_owned(),
        None => "not given".to_owned(),
    };
    Some(format!("{name} was {}, and is {} now", said(before), said(now)))
}

#[cfg(test)]
mod tests {
    use super::{Options, difference};

    #[test]
    fn options_that_differ_are_named_whoever_has_them() {
        let options = |pairs: &[(&str, &str)]| -> Options {
            pairs.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect()
        };
        let plain = options(&[("--seed", "1")]);
        assert_eq!(difference(&plain, &plain), None);
        let other = options(&[("--seed", "2")]);
        assert_eq!(difference(&plain, &other).unwrap(), "--seed was 1, and is 2 now");
        let more = options(&[("--seed", "1"), ("--report", "true")]);
        assert_eq!(difference(&plain, &more).unwrap(), "--report was not given, and is given now");
        assert_eq!(difference(&more, &plain).unwrap(), "--report was given, and is not given now");
    }
}

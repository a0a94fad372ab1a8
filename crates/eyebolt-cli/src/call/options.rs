//! What a command can be told, and how its words become arguments.

use super::error::CallError;
use crate::arguments::{Arguments, Command};
use clap::{ArgAction, CommandFactory, Parser};
use std::ffi::OsString;

/// An option of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallOption {
    /// Its flag without dashes before it, in snake case.
    pub name: String,
    /// Whether it has a value; otherwise it is said or not.
    pub takes_value: bool,
    /// Whether it may be repeated.
    pub repeats: bool,
    /// Its value if it is not told, as words have it.
    pub default: Option<String>,
}

/// The options of the command called `command`; nothing of one that there is not.
#[must_use]
pub fn options(command: &str) -> Vec<CallOption> {
    let program = Arguments::command();
    let Some(found) = program.find_subcommand(command) else { return Vec::new() };
    let option = |argument: &clap::Arg| {
        Some(CallOption {
            name: argument.get_long()?.replace('-', "_"),
            takes_value: argument.get_action().takes_values(),
            repeats: matches!(argument.get_action(), ArgAction::Append),
            default: argument
                .get_default_values()
                .first()
                .map(|value| value.to_string_lossy().into_owned()),
        })
    };
    found.get_arguments().filter_map(option).collect()
}

/// `words` as arguments of `command`.
pub(super) fn parsed(command: &str, words: Vec<OsString>) -> Result<Command, CallError> {
    let head = ["eyebolt", command].into_iter().map(OsString::from);
    Ok(Arguments::try_parse_from(head.chain(words))?.command)
}

/// What [`parsed`] never comes to.
pub(super) fn other<T>() -> Result<T, CallError> {
    Err(CallError::of_text("a command was taken for another: a bug in eyebolt. Please report it"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_those_of_the_command() {
        let known = options("calibrate");
        let named = |name: &str| known.iter().find(|option| option.name == name).unwrap();
        assert!(named("seed").takes_value && !named("no_masks").takes_value);
        assert!(named("joint").repeats && !named("robot").repeats);
        assert!(options("no such command").is_empty());
    }

    #[test]
    fn values_that_options_cannot_have() {
        let error = |word: &str| {
            let words = vec![word.into(), "recording".into()];
            parsed("calibrate", words).map(drop).unwrap_err()
        };
        let found = error("--max-error-mm=-1");
        assert_eq!(found.field.as_deref(), Some("max_error_mm"));
        assert_eq!(found.remedy.as_deref(), Some("must be a number above 0"));
        let found = error("--method=guess");
        assert_eq!(found.field.as_deref(), Some("method"));
        assert_eq!(found.remedy.as_deref(), Some("Use one of best, nothing, paper"));
        assert!(!found.text.contains("--"), "{}", found.text);
    }
}

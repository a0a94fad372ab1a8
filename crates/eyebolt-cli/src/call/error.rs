//! Why a call came to nothing.

use super::keywords::keywords;
use crate::ending::causes;
use clap::error::{ContextKind, ContextValue};
use eyebolt::record::RecordError;
use eyebolt_recording::RecordingError;
use eyebolt_robot::Input;
use std::fmt;

/// Why a call came to nothing: what a person reads, and its parts as far as they can be told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallError {
    /// All of it.
    pub text: String,
    /// The file, or what else was read.
    pub file: Option<String>,
    /// The option, or the part of the file, that is at fault.
    pub field: Option<String>,
    /// What to do about it.
    pub remedy: Option<String>,
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for CallError {}

impl CallError {
    /// From a text of the form `FILE: FIELD: PROBLEM. REMEDY`, as errors of eyebolt are.
    #[must_use]
    pub fn of_text(text: &str) -> Self {
        let text = keywords(text);
        let (problem, remedy) = without_remedy(&text);
        let segments: Vec<&str> = problem.splitn(3, ": ").collect();
        let (file, field) = match segments.as_slice() {
            [first, ..] if first.starts_with('`') => (None, keyword(first)),
            [file, field, _] if is_name(field) => {
                (Some((*file).to_owned()), Some(keyword(field).unwrap_or((*field).to_owned())))
            }
            [file, _, ..] if !file.contains(' ') => (Some((*file).to_owned()), None),
            _ => (None, None),
        };
        let remedy = remedy.map(str::to_owned);
        Self { file, field, remedy, text }
    }
}

/// The text before its last part, which says what to do: the sentences after the first.
fn without_remedy(text: &str) -> (&str, Option<&str>) {
    let begins = |at: &(usize, &str)| {
        let rest = &text[at.0 + 2..];
        rest.starts_with(|c: char| c.is_uppercase() || c == '`')
    };
    match text.match_indices(". ").find(begins) {
        Some((at, _)) => (&text[..at], Some(&text[at + 2..])),
        None => (text, None),
    }
}

/// The option that `text` begins with.
fn keyword(text: &str) -> Option<String> {
    Some(text.strip_prefix('`')?.split_once('`')?.0.to_owned())
}

/// Whether `text` names a field, and is not the beginning of a sentence.
fn is_name(text: &str) -> bool {
    text.split(' ').count() <= 3
}

impl From<anyhow::Error> for CallError {
    fn from(error: anyhow::Error) -> Self {
        let mut told = Self::of_text(&causes(&error));
        let input = error.chain().find_map(|cause| match cause.downcast_ref::<RecordError>() {
            Some(error) => error.input(),
            None => cause.downcast_ref::<RecordingError>()?.input(),
        });
        if let Some(input) = input {
            told.field = Some(option_of(input));
        }
        if let Some(error) = error.chain().find_map(|cause| cause.downcast_ref::<RecordingError>())
        {
            told.file = Some(error.path().display().to_string());
        }
        told
    }
}

impl From<RecordingError> for CallError {
    fn from(error: RecordingError) -> Self {
        anyhow::Error::new(error).into()
    }
}

fn option_of(input: Input) -> String {
    keywords(&input.to_string()).trim_matches('`').to_owned()
}

impl From<clap::Error> for CallError {
    fn from(error: clap::Error) -> Self {
        let text = error.render().to_string();
        // What follows is for a terminal.
        let text = text.split("\n\nUsage").next().unwrap_or_default();
        let text = text.split("\n\nFor more").next().unwrap_or_default();
        let words: Vec<&str> = text.split_whitespace().collect();
        let text = keywords(words.join(" ").trim_start_matches("error: "));
        let flag = match error.get(ContextKind::InvalidArg) {
            Some(ContextValue::String(flag)) => Some(flag.clone()),
            Some(ContextValue::Strings(flags)) => flags.first().cloned(),
            _ => None,
        };
        let field = flag.and_then(|flag| keyword(&keywords(&flag)));
        // `VALUE for FLAG: what it has to be`, or a list of what it may be.
        let remedy = match (text.find("[possible values: "), text.rsplit_once(": ")) {
            (Some(at), _) => {
                let known = text[at..].trim_start_matches("[possible values: ");
                let known = known.split(']').next().unwrap_or_default();
                Some(format!("Use one of {known}"))
            }
            (None, Some((_, must))) => Some(must.to_owned()),
            (None, None) => None,
        };
        Self { text, file: None, field, remedy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(text: &str) -> [Option<String>; 3] {
        let CallError { file, field, remedy, .. } = CallError::of_text(text);
        [file, field, remedy]
    }

    fn some(parts: [&str; 3]) -> [Option<String>; 3] {
        parts.map(|part| (!part.is_empty()).then(|| part.to_owned()))
    }

    #[test]
    fn errors_have_parts() {
        let text = "a/recording.toml: frames.depth_unit: \"cm\" is not known. Use \"m\"";
        assert_eq!(parts(text), some(["a/recording.toml", "frames.depth_unit", "Use \"m\""]));
        let text = "x.json: --output: this is a folder. Name a file in it";
        assert_eq!(parts(text), some(["x.json", "output", "Name a file in it"]));
        let text = "--robot no_arm: no such file, nor a robot. Name one of them";
        assert_eq!(parts(text), some(["", "robot", "Name one of them"]));
        let text = "out.json: the file exists. Give --force to replace it, or another name";
        assert_eq!(
            parts(text),
            some(["out.json", "", "Give `force` to replace it, or another name"])
        );
        assert_eq!(parts("nothing is known. at all"), some(["", "", ""]));
    }
}

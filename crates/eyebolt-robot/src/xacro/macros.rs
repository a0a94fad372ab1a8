//! Macros and their parameters.

use super::tree::Element;
use std::rc::Rc;

/// A macro as it was defined.
#[derive(Debug)]
pub(super) struct Macro {
    pub(super) parameters: Vec<Parameter>,
    pub(super) body: Rc<Element>,
}

/// A parameter of a macro.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parameter {
    /// With its stars, if it is a block.
    pub(super) name: String,
    /// Whether a property of this name of the caller stands in where it is not given.
    pub(super) forwards: bool,
    /// What stands in otherwise.
    pub(super) default: Option<String>,
}

/// The parameters in the attribute `params`: `a b:=1 c:='x y' d:=^ e:=^|2 *block **blocks`.
pub(super) fn parameters(text: &str) -> Vec<Parameter> {
    let mut parameters = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let end = rest.find(|c: char| c.is_whitespace() || matches!(c, ':' | '='));
        let (name, after) = rest.split_at(end.unwrap_or(rest.len()));
        let after = after.trim_start();
        let value = after.strip_prefix(":=").or_else(|| after.strip_prefix('='));
        let Some(value) = value.filter(|_| !name.is_empty()) else {
            let length = if name.is_empty() { 1 } else { name.len() };
            let (name, after) =
                rest.split_at(rest.char_indices().nth(length).map_or(rest.len(), |(at, _)| at));
            parameters.push(Parameter { name: name.to_owned(), forwards: false, default: None });
            rest = after.trim_start();
            continue;
        };
        let value = value.trim_start();
        let forwarded = value.strip_prefix('^');
        let value = forwarded.map_or(value, |rest| rest.strip_prefix('|').unwrap_or(rest));
        let (default, after) = value.split_at(default_length(value));
        parameters.push(Parameter {
            name: name.to_owned(),
            forwards: forwarded.is_some(),
            default: (!default.is_empty()).then(|| default.to_owned()),
        });
        rest = after.trim_start();
    }
    parameters
}

/// Bytes of the default at the start of `text`: an expression, or words and quoted text without a
/// space between them.
fn default_length(text: &str) -> usize {
    for (open, close) in [("${", '}'), ("$(", ')')] {
        if text.starts_with(open) {
            let ends = text.match_indices(close).map(|(at, _)| at + 1);
            let whole = |end: &usize| {
                text.get(*end..)
                    .is_some_and(|rest| rest.chars().next().is_none_or(char::is_whitespace))
            };
            if let Some(end) = { ends }.find(whole) {
                return end;
            }
        }
    }
    let mut quote = None;
    for (at, letter) in text.char_indices() {
        match quote {
            Some(open) if letter == open => quote = None,
            Some(_) => {}
            None if letter.is_whitespace() => return at,
            None if matches!(letter, '\'' | '"') => quote = Some(letter),
            None => {}
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_of_every_form() {
        let found = parameters(
            "a b:=1 c='x y' d:=^ e:=^|2 f := ${a + 'b c'} g:=$(find p) *h **i j:='' k:=[1,2]",
        );
        let plain = |name: &str| Parameter { name: name.into(), forwards: false, default: None };
        let with = |name: &str, forwards, default: &str| Parameter {
            name: name.into(),
            forwards,
            default: (!default.is_empty()).then(|| default.to_owned()),
        };
        let expected = [
            plain("a"),
            with("b", false, "1"),
            with("c", false, "'x y'"),
            with("d", true, ""),
            with("e", true, "2"),
            with("f", false, "${a + 'b c'}"),
            with("g", false, "$(find p)"),
            plain("*h"),
            plain("**i"),
            with("j", false, "''"),
            with("k", false, "[1,2]"),
        ];
        assert_eq!(found, expected);
        assert!(parameters("  ").is_empty());
        assert_eq!(parameters(":= =").len(), 3);
    }
}

//! Flags by the names that a function's arguments have.

use crate::names;

/// `text` with keywords for inputs and flags: `` `max_error_mm` `` for `--max-error-mm`.
#[must_use]
pub fn keywords(text: &str) -> String {
    let text = names::in_flags(text);
    let mut parts = text.split("--");
    let mut said = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let in_flag = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        let end = part.find(|c| !in_flag(c)).unwrap_or(part.len());
        let (flag, rest) = part.split_at(end);
        match flag.starts_with(|c: char| c.is_ascii_lowercase()) {
            true => said += &format!("`{}`{rest}", flag.replace('-', "_")),
            false => said += &format!("--{part}"),
        }
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_become_keywords() {
        let said = keywords("--max-error-mm <MM>: give --force, or argument `depth_topic`; a -- b");
        assert_eq!(said, "`max_error_mm` <MM>: give `force`, or `depth_topic`; a -- b");
    }
}

//! Lines and words of files that are text, or begin with it.

/// The lines of a file that are not blank, without their ends.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    /// Of `bytes`, the first of which are in the line after line `number`.
    pub(super) fn after(number: usize, bytes: &'a [u8]) -> Self {
        Self { rest: bytes, number }
    }

    /// Number of the last line read, counted from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// What follows the last line read.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|byte| *byte == b'\n');
            let length = end.unwrap_or(self.rest.len());
            let (line, rest) = self.rest.split_at_checked(length)?;
            self.rest = rest.get(1..).unwrap_or(&[]);
            self.number += 1;
            let line = line.trim_ascii();
            if !line.is_empty() {
                return Some(line);
            }
        }
        None
    }
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// What a message shows of a line or word that may be long, or no text.
pub(super) fn excerpt(text: &[u8]) -> String {
    const LONGEST: usize = 40;
    let shown = String::from_utf8_lossy(text.get(..LONGEST).unwrap_or(text)).into_owned();
    if text.len() > LONGEST { shown + "…" } else { shown }
}

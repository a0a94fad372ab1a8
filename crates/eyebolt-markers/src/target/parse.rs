//! Targets as people write them.

use super::described::Target;
use super::error::{LENGTH, TargetError};
use super::layout::Layout;
use crate::dictionary::Dictionary;
use std::fmt;
use std::str::FromStr;

const COUNT: &str = "it is a whole number, 0 or more";

/// From `aruco:4x4_50:0.05`, `apriltag:36h11:0.08:7`, `grid:4x4_250:4x3:0.0256:0.0066` or
/// `charuco:5x5_250:5x7:0.0394:0.0176`: kind, dictionary, sizes in metres, number of the (first) tag.
impl FromStr for Target {
    type Err = TargetError;

    fn from_str(text: &str) -> Result<Self, TargetError> {
        let wrong = || TargetError::Form { text: text.to_owned() };
        let parts: Vec<&str> = text.split(':').collect();
        let (kind, rest) = parts.split_first().ok_or_else(wrong)?;
        let dictionary = |name: &str| {
            Dictionary::named(name).ok_or_else(|| TargetError::Dictionary { name: name.to_owned() })
        };
        let (dictionary, marker_m, layout) = match (*kind, rest) {
            ("aruco" | "apriltag", [name, size, id @ ..]) if id.len() <= 1 => {
                let id = id.first().map(|id| count("the tag's number", id)).transpose()?;
                (dictionary(name)?, length("the tag's size", size)?, Layout::Tag { id })
            }
            ("grid", [name, board, size, gap, first @ ..]) if first.len() <= 1 => {
                let (columns, rows) = columns_and_rows(board)?;
                let (gap_m, first_id) = (length("the gap", gap)?, first_id(first)?);
                let layout = Layout::Grid { columns, rows, gap_m, first_id };
                (dictionary(name)?, length("the tag's size", size)?, layout)
            }
            ("charuco", [name, board, square, size, first @ ..]) if first.len() <= 1 => {
                let (columns, rows) = columns_and_rows(board)?;
                let (square_m, first_id) = (length("the square", square)?, first_id(first)?);
                let layout = Layout::Charuco { columns, rows, square_m, first_id };
                (dictionary(name)?, length("the tag's size", size)?, layout)
            }
            _ => return Err(wrong()),
        };
        Self::new(dictionary, marker_m, layout)
    }
}

fn length(part: &'static str, text: &str) -> Result<f64, TargetError> {
    let wrong = || TargetError::Number { part, text: text.to_owned(), remedy: LENGTH };
    text.parse().map_err(|_| wrong())
}

fn count(part: &'static str, text: &str) -> Result<u32, TargetError> {
    text.parse().map_err(|_| TargetError::Number { part, text: text.to_owned(), remedy: COUNT })
}

fn first_id(rest: &[&str]) -> Result<u32, TargetError> {
    rest.first().map_or(Ok(0), |id| count("the first tag's number", id))
}

fn columns_and_rows(text: &str) -> Result<(u32, u32), TargetError> {
    let numbers = || {
        let (columns, rows) = text.split_once('x')?;
        Some((columns.parse().ok()?, rows.parse().ok()?))
    };
    numbers().ok_or_else(|| TargetError::Number {
        part: "the board",
        text: text.to_owned(),
        remedy: "write columns and rows, as in 4x3",
    })
}

/// As it is parsed.
impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, marker_m) = (self.dictionary().name(), self.marker_m());
        match *self.layout() {
            Layout::Tag { id } => {
                let april = ["36h11", "25h9", "16h5"].contains(&name);
                write!(f, "{}:{name}:{marker_m}", if april { "apriltag" } else { "aruco" })?;
                id.map_or(Ok(()), |id| write!(f, ":{id}"))
            }
            Layout::Grid { columns, rows, gap_m, first_id } => {
                write!(f, "grid:{name}:{columns}x{rows}:{marker_m}:{gap_m}:{first_id}")
            }
            Layout::Charuco { columns, rows, square_m, first_id } => {
                write!(f, "charuco:{name}:{columns}x{rows}:{square_m}:{marker_m}:{first_id}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        for text in [
            "aruco:4x4_50:0.05",
            "aruco:original:0.05:17",
            "apriltag:36h11:0.08:586",
            "grid:4x4_250:4x3:0.0256:0.0066:0",
            "charuco:5x5_250:5x7:0.0282:0.0176:3",
        ] {
            let target: Target = text.parse().unwrap();
            assert_eq!(target.to_string(), text);
        }
        let short: Target = "grid:4x4_250:4x3:0.0256:0.0066".parse().unwrap();
        assert_eq!(short.ids(), 0..12);
    }

    #[test]
    fn errors_say_what_is_wrong_and_how_to_write_it() {
        for (text, wanted) in [
            ("", "write aruco:"),
            ("aruco:4x4_50", "write aruco:"),
            ("aruco:4x4_50:0.05:1:2", "write aruco:"),
            ("qr:4x4_50:0.05", "write aruco:"),
            ("aruco:4x4:0.05", "\"4x4\" is no dictionary; there are 4x4_50"),
            ("aruco:4x4_50:5cm", "the tag's size is \"5cm\"; lengths are in metres"),
            ("aruco:4x4_50:-1", "the tag's size is \"-1\""),
            ("aruco:4x4_50:nan", "the tag's size is \"NaN\""),
            ("aruco:4x4_50:0.05:50", "tags 50 to 50 are needed, and 4x4_50 has 0 to 49"),
            ("grid:4x4_50:4:0.05:0.01", "write columns and rows"),
            ("grid:4x4_50:0x3:0.05:0.01", "boards have 1 to 1000"),
            ("grid:4x4_50:4294967295x4294967295:0.05:0.01", "boards have 1 to 1000"),
            ("grid:4x4_50:8x8:0.05:0.01", "tags 0 to 63 are needed"),
            ("charuco:4x4_50:5x7:0.01:0.02", "squares are larger than the tags"),
            ("charuco:4x4_50:2x7:0.02:0.01", "three columns and three rows"),
        ] {
            let error = text.parse::<Target>().unwrap_err().to_string();
            assert!(error.contains(wanted), "{text}: {error}");
        }
    }
}

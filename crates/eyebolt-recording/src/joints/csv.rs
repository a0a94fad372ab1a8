//! Joints in CSV: columns named by a header, one row for every frame.

use super::choice::{Choice, FRAME, choose, shown};
use super::positions::{MOST_NAMES, in_order, invalid, positions};
use super::table::Table;
use crate::error::RecordingError;
use ::csv::{ErrorKind, Reader, ReaderBuilder, StringRecord, Trim};
use eyebolt_robot::JointPositions;
use std::path::Path;

const HEADER: &str = "Begin the file with a row of the joints' names, separated by commas";

/// Rows of a text, with the path for messages.
struct Rows<'a> {
    path: &'a Path,
    reader: Reader<&'a [u8]>,
}

/// Reads the text of one frame's file; without a header where `names` tells what is what.
pub(super) fn read(
    path: &Path,
    text: &str,
    names: Option<&[String]>,
) -> Result<JointPositions, RecordingError> {
    let mut rows = Rows::new(path, text);
    let first = rows.first()?;
    match (numbers(&first), names) {
        (Some(numbers), Some(names)) => return rows.without_header(numbers, names),
        (Some(_), None) => {
            let remedy = "Begin the file with the joints' names, or list them as \
                          frames.joint_names in recording.toml";
            return Err(invalid(path, "the first row has numbers, not names", remedy));
        }
        (None, _) => {}
    }
    let choice = choose(path, "", &first.iter().collect::<Vec<_>>(), names)?;
    let Some((_, row)) = rows.next()? else {
        return Err(invalid(path, "no row follows the names", "Add the positions"));
    };
    if let Some((place, _)) = rows.next()? {
        let remedy =
            "Keep one, or name one file for all frames, without {} and with a column frame";
        return Err(invalid(path, format!("{place}a second row, in a file of one frame"), remedy));
    }
    positions(path, "", chosen(path, "", &choice, &row)?)
}

/// Reads the text of a file of all frames into `table`.
pub(super) fn read_table(
    text: &str,
    names: Option<&[String]>,
    table: &mut Table<'_>,
) -> Result<(), RecordingError> {
    let path = table.path;
    let mut rows = Rows::new(path, text);
    let first = rows.first()?;
    let header: Vec<_> = first.iter().collect();
    let choice = choose(path, "", &header, names)?;
    let mut frame = header.iter().enumerate().filter(|(_, key)| **key == FRAME);
    let (Some((frame, _)), None) = (frame.next(), frame.next()) else {
        let problem = "the first row does not name one column \"frame\"";
        return Err(invalid(path, problem, "Add it, with the name or number of every row's frame"));
    };
    while let Some((place, row)) = rows.next()? {
        let name = row.get(frame).unwrap_or_default();
        let Some(index) = table.frame(name, &place)? else { continue };
        let joints = positions(path, &place, chosen(path, &place, &choice, &row)?)?;
        table.fill(index, place, joints);
    }
    Ok(())
}

/// The cells that are joints.
fn chosen(
    path: &Path,
    place: &str,
    choice: &Choice,
    row: &StringRecord,
) -> Result<Vec<(String, f64)>, RecordingError> {
    let cell = |(name, column): &(String, usize)| {
        let text = row.get(*column).unwrap_or_default();
        text.parse().map(|position| (name.clone(), position)).map_err(|_| {
            let problem = format!("{place}the position of {} is \"{}\"", shown(name), shown(text));
            let remedy = "Write a number, or list the columns that are joints as \
                          frames.joint_names in recording.toml";
            invalid(path, problem, remedy)
        })
    };
    choice.iter().map(cell).collect()
}

/// The cells as numbers, if all are.
fn numbers(row: &StringRecord) -> Option<Vec<f64>> {
    row.iter().map(|cell| cell.parse().ok()).collect()
}

impl<'a> Rows<'a> {
    fn new(path: &'a Path, text: &'a str) -> Self {
        let mut builder = ReaderBuilder::new();
        let reader = builder.has_headers(false).trim(Trim::All).from_reader(text.as_bytes());
        Self { path, reader }
    }

    fn first(&mut self) -> Result<StringRecord, RecordingError> {
        let Some((_, first)) = self.next()? else {
            return Err(invalid(self.path, "the file is empty", HEADER));
        };
        if first.len() > MOST_NAMES {
            let problem =
                format!("the first row has {} columns, more than {MOST_NAMES}", first.len());
            return Err(invalid(self.path, problem, "Store the joints of one arm"));
        }
        // What spreadsheets write where the comma is in the numbers.
        if first.len() == 1 && first.iter().any(|cell| cell.contains([';', '\t'])) {
            return Err(invalid(self.path, "the first row has no commas", HEADER));
        }
        Ok(first)
    }

    /// The next row and where it is; `None` after the last.
    fn next(&mut self) -> Result<Option<(String, StringRecord)>, RecordingError> {
        let mut row = StringRecord::new();
        let more = self.reader.read_record(&mut row).map_err(|error| {
            let problem = match error.kind() {
                ErrorKind::UnequalLengths { pos, expected_len, len } => format!(
                    "{}found {len} values, but the first row has {expected_len}",
                    place(pos.as_ref())
                ),
                _ => error.to_string(),
            };
            invalid(self.path, problem, "Write one value for every column")
        })?;
        Ok(more.then(|| (place(row.position()), row)))
    }

    /// Numbers alone, in a row or, as NumPy writes them, in a column.
    fn without_header(
        mut self,
        first: Vec<f64>,
        names: &[String],
    ) -> Result<JointPositions, RecordingError> {
        let mut all = first;
        let columns = all.len();
        while let Some((place, row)) = self.next()? {
            let number = numbers(&row).filter(|_| columns == 1);
            all.extend(number.ok_or_else(|| {
                let problem = format!("{place}expected one row of numbers, or one column");
                invalid(self.path, problem, HEADER)
            })?);
        }
        in_order(self.path, names, all)
    }
}

/// Where a row is, for the beginning of a message.
fn place(position: Option<&::csv::Position>) -> String {
    position.map_or_else(String::new, |position| format!("line {}: ", position.line()))
}

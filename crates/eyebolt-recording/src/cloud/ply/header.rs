//! The header of a PLY file: what elements there are, and what they are made of.

use super::scalar::Scalar;
use crate::cloud::float::Float;
use crate::cloud::stored::{LARGEST_HEADER, damaged, invalid};
use crate::cloud::text::{Lines, excerpt};
use crate::error::RecordingError;
use std::path::Path;

const REWRITE: &str = "Write the file again, as PLY version 1.0 or as NPY";

/// How the elements follow the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Records of one kind.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

/// A number of a record, or a list of them.
#[derive(Debug)]
pub(super) struct Property {
    name: String,
    /// Type of the number, or of those in the list.
    pub(super) scalar: Scalar,
    /// Type of the list's length, if it is a list.
    pub(super) length: Option<Scalar>,
    /// Which coordinate of the vertex it is, and its type, if it is one.
    pub(super) axis: Option<(usize, Float)>,
}

/// What the header says.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    /// What comes before the vertices.
    pub(super) before: Vec<Element>,
    pub(super) vertex: Element,
    /// Width and height, if the vertices are in the order of an image.
    pub(super) grid: Option<(u32, u32)>,
    /// Bytes before the data.
    pub(super) length: usize,
    /// Lines before the data.
    pub(super) lines: usize,
}

impl Header {
    /// From the beginning of a file.
    pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, RecordingError> {
        let head = bytes.get(..LARGEST_HEADER).unwrap_or(bytes);
        let mut lines = Lines::after(0, head);
        if lines.next() != Some(b"ply") {
            return Err(invalid(path, "the file does not begin with \"ply\"", REWRITE));
        }
        let mut said = Said::default();
        loop {
            let Some(line) = lines.next() else {
                return Err(damaged(path, "the file ends in its header, before end_header"));
            };
            if line == b"end_header" {
                break;
            }
            said.take(line).map_err(|problem| {
                let problem = format!("line {}: {problem}", lines.number());
                RecordingError::invalid(path, "header", problem, REWRITE)
            })?;
        }
        let length = head.len().saturating_sub(lines.rest().len());
        said.header(length, lines.number())
            .map_err(|problem| RecordingError::invalid(path, "header", problem, REWRITE))
    }
}

/// What the lines so far have said.
#[derive(Debug, Default)]
struct Said {
    encoding: Option<Encoding>,
    elements: Vec<Element>,
    columns: Option<u32>,
    rows: Option<u32>,
}

impl Said {
    fn take(&mut self, line: &[u8]) -> Result<(), String> {
        // Comments are in any encoding of text.
        if line.starts_with(b"comment") {
            return Ok(());
        }
        let text = String::from_utf8_lossy(line);
        let words: Vec<_> = text.split_ascii_whitespace().collect();
        match *words.as_slice() {
            ["format", encoding, "1.0"] if self.encoding.is_none() => {
                self.encoding = Some(match encoding {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    other => return Err(format!("format {} is not known", shown(other))),
                });
            }
            ["obj_info", "num_cols", number] => self.columns = number.parse().ok(),
            ["obj_info", "num_rows", number] => self.rows = number.parse().ok(),
            ["obj_info", ..] => {}
            ["element", name, count] => self.element(name, count)?,
            ["property", "list", length, scalar, name] => {
                let length = Scalar::parse(length).filter(|length| length.is_integer());
                let length =
                    length.ok_or_else(|| format!("no list has {} for its length", text))?;
                self.property(name, scalar, Some(length))?;
            }
            ["property", scalar, name] => self.property(name, scalar, None)?,
            _ => return Err(format!("\"{}\" is not understood", excerpt(line))),
        }
        Ok(())
    }

    fn element(&mut self, name: &str, count: &str) -> Result<(), String> {
        if self.elements.iter().any(|element| element.name == name) {
            return Err(format!("element {} is there twice", shown(name)));
        }
        let count =
            count.parse().map_err(|_| format!("{} is no number of elements", shown(count)))?;
        self.elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
        Ok(())
    }

    fn property(&mut self, name: &str, scalar: &str, length: Option<Scalar>) -> Result<(), String> {
        let Some(element) = self.elements.last_mut() else {
            return Err(format!("property {} is of no element", shown(name)));
        };
        let known = Scalar::parse(scalar);
        let scalar = known.ok_or_else(|| format!("type {} is not known", shown(scalar)))?;
        let name = name.to_owned();
        element.properties.push(Property { name, scalar, length, axis: None });
        Ok(())
    }

    fn header(self, length: usize, lines: usize) -> Result<Header, String> {
        let encoding = self.encoding.ok_or("the line of the format is missing")?;
        let mut before = self.elements;
        let vertex = before.iter().position(|element| element.name == "vertex");
        let vertex = vertex.ok_or("there is no element vertex")?;
        // What comes after the vertices is not read.
        before.truncate(vertex + 1);
        let mut vertex = before.pop().ok_or("there is no element vertex")?;
        for (index, axis) in ["x", "y", "z"].into_iter().enumerate() {
            mark(&mut vertex, index, axis)?;
        }
        let count = Some(vertex.count);
        // Scans that left pixels out have fewer vertices, and list them elsewhere.
        let grid = self.columns.zip(self.rows).filter(|(columns, rows)| {
            *rows > 1 && (*columns as usize).checked_mul(*rows as usize) == count
        });
        Ok(Header { encoding, before, vertex, grid, length, lines })
    }
}

/// Finds the one property that is coordinate `index`, of name `axis`.
fn mark(vertex: &mut Element, index: usize, axis: &str) -> Result<(), String> {
    let mut named = vertex.properties.iter_mut().filter(|property| property.name == axis);
    let property = named.next().ok_or_else(|| format!("vertices have no {axis}"))?;
    if named.next().is_some() {
        return Err(format!("property {axis} is there twice"));
    }
    let float = property.scalar.float().filter(|_| property.length.is_none());
    let float = float.ok_or_else(|| format!("property {axis} is neither float nor double"))?;
    property.axis = Some((index, float));
    Ok(())
}

fn shown(word: &str) -> String {
    format!("\"{}\"", excerpt(word.as_bytes()))
}

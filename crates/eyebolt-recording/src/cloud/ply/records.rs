//! The records of a PLY file, one number after the other, from text or bytes.

use super::header::Element;
use super::scalar::Scalar;
use crate::cloud::float::Float;
use crate::cloud::text::{Lines, excerpt, words};

/// A file read from record to record; what goes wrong is told as text.
pub(super) trait Records {
    /// Comes to the next record.
    fn begin(&mut self) -> Result<(), String>;
    /// Reads a coordinate.
    fn float(&mut self, float: Float) -> Result<f32, String>;
    /// Reads the length of a list.
    fn length(&mut self, scalar: Scalar) -> Result<usize, String>;
    /// Passes over `count` numbers.
    fn skip(&mut self, scalar: Scalar, count: usize) -> Result<(), String>;
    /// Leaves the record.
    fn end(&mut self) -> Result<(), String>;
    /// Where it stands, for the beginning of a message.
    fn place(&self) -> String;
    /// Bytes that are left.
    fn size(&self) -> usize;
    /// Fewest bytes of a record of `element`, which are never none.
    fn least_size(&self, element: &Element) -> usize;
}

const ENDS: &str = "the file ends within it";

/// Records as bytes.
pub(super) struct Binary<'a> {
    rest: &'a [u8],
    big_endian: bool,
}

impl<'a> Binary<'a> {
    pub(super) fn new(rest: &'a [u8], big_endian: bool) -> Self {
        Self { rest, big_endian }
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or(ENDS)?;
        self.rest = rest;
        Ok(taken)
    }
}

impl Records for Binary<'_> {
    fn begin(&mut self) -> Result<(), String> {
        Ok(())
    }

    fn float(&mut self, float: Float) -> Result<f32, String> {
        let big_endian = self.big_endian;
        let bytes = self.take(float.size())?;
        float.read(bytes, big_endian).ok_or_else(|| ENDS.to_owned())
    }

    fn length(&mut self, scalar: Scalar) -> Result<usize, String> {
        let bytes = self.take(scalar.size())?;
        let append = |value: u32, byte: &u8| value << 8 | u32::from(*byte);
        let value = if self.big_endian {
            bytes.iter().fold(0, append)
        } else {
            bytes.iter().rev().fold(0, append)
        };
        let negative = match scalar {
            Scalar::Integer(size @ 1..=4, true) => value >> (8 * size - 1) == 1,
            _ => false,
        };
        if negative {
            Err("the length of a list is negative".to_owned())
        } else {
            Ok(value as usize)
        }
    }

    fn skip(&mut self, scalar: Scalar, count: usize) -> Result<(), String> {
        self.take(scalar.size().checked_mul(count).ok_or(ENDS)?).map(drop)
    }

    fn end(&mut self) -> Result<(), String> {
        Ok(())
    }

    fn place(&self) -> String {
        String::new()
    }

    fn size(&self) -> usize {
        self.rest.len()
    }

    fn least_size(&self, element: &Element) -> usize {
        let sizes = element.properties.iter().map(|p| p.length.unwrap_or(p.scalar).size());
        sizes.sum::<usize>().max(1)
    }
}

/// Records as text, a line for each.
pub(super) struct Ascii<'a> {
    lines: Lines<'a>,
    line: &'a [u8],
}

impl<'a> Ascii<'a> {
    /// Of `bytes`, the first of which are in the line after line `number`.
    pub(super) fn after(number: usize, bytes: &'a [u8]) -> Self {
        Self { lines: Lines::after(number, bytes), line: &[] }
    }

    fn word(&mut self) -> Result<&'a [u8], String> {
        let word = words(self.line).next().ok_or("the line has fewer numbers than properties")?;
        let start = self.line.len().saturating_sub(self.line.trim_ascii_start().len());
        self.line = self.line.get(start.saturating_add(word.len())..).unwrap_or(&[]);
        Ok(word)
    }
}

impl Records for Ascii<'_> {
    fn begin(&mut self) -> Result<(), String> {
        self.line = self.lines.next().ok_or("the file ends before it")?;
        Ok(())
    }

    fn float(&mut self, float: Float) -> Result<f32, String> {
        let word = self.word()?;
        float.parse(word).ok_or_else(|| format!("\"{}\" is not a number", excerpt(word)))
    }

    fn length(&mut self, _: Scalar) -> Result<usize, String> {
        let word = self.word()?;
        let length = str::from_utf8(word).ok().and_then(|text| text.parse().ok());
        length.ok_or_else(|| format!("\"{}\" is no length of a list", excerpt(word)))
    }

    fn skip(&mut self, _: Scalar, count: usize) -> Result<(), String> {
        // However many are claimed, no more than the line has.
        (0..count).try_for_each(|_| self.word().map(drop))
    }

    fn end(&mut self) -> Result<(), String> {
        if self.line.trim_ascii().is_empty() {
            return Ok(());
        }
        Err("the line has more numbers than properties".to_owned())
    }

    fn place(&self) -> String {
        format!("line {}: ", self.lines.number())
    }

    fn size(&self) -> usize {
        // The last line may do without its end.
        self.lines.rest().len().saturating_add(1)
    }

    fn least_size(&self, element: &Element) -> usize {
        element.properties.len().saturating_mul(2).max(1)
    }
}

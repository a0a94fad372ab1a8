//! The header of an NPY file: a Python dictionary of three keys.
//!
//! Read by hand, because it is the place where a file may lie: nothing here recurses, allocates by
//! what the file says, or multiplies unchecked.

/// Most axes that an array of a recording has, with room for the curious.
const MOST_AXES: usize = 8;

/// What the header says.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Header {
    /// Type of the numbers with their byte order, as in `<f4`.
    pub(super) descr: String,
    /// Whether the first axis is the fastest.
    pub(super) fortran: bool,
    /// Length of every axis.
    pub(super) shape: Vec<usize>,
    /// Bytes before the numbers.
    pub(super) length: usize,
}

impl Header {
    /// From the beginning of a file, or what is wrong with it.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, String> {
        let rest = bytes.strip_prefix(b"\x93NUMPY").ok_or("the file is not an NPY file")?;
        let (size, start) = match rest {
            [1, _, a, b, ..] => (usize::from(u16::from_le_bytes([*a, *b])), 10),
            [2 | 3, _, a, b, c, d, ..] => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, 12),
            [1..=3, ..] => return Err("the file ends in its header".to_owned()),
            [version, ..] => return Err(format!("NPY version {version} is not known")),
            [] => return Err("the file ends in its header".to_owned()),
        };
        let length = size.saturating_add(start);
        let text = bytes.get(start..length).ok_or("the file ends in its header")?;
        let text = str::from_utf8(text).map_err(|_| "the header is not text")?;
        let dictionary = Cursor { rest: text }.dictionary();
        let (descr, fortran, shape) = dictionary
            .ok_or("the header is not a plain array's (`descr`, `fortran_order`, `shape`)")?;
        Ok(Self { descr, fortran, shape, length })
    }

    /// How many numbers there are, unless that is more than a computer can hold.
    pub(super) fn count(&self) -> Option<usize> {
        self.shape.iter().try_fold(1_usize, |count, axis| count.checked_mul(*axis))
    }
}

/// What remains of the text.
struct Cursor<'a> {
    rest: &'a str,
}

impl<'a> Cursor<'a> {
    fn dictionary(mut self) -> Option<(String, bool, Vec<usize>)> {
        let (mut descr, mut fortran, mut shape) = (None, None, None);
        self.token("{").then_some(())?;
        while !self.token("}") {
            let key = self.string()?;
            self.token(":").then_some(())?;
            match key {
                "descr" => descr = Some(self.string()?.to_owned()),
                "fortran_order" => fortran = Some(self.boolean()?),
                "shape" => shape = Some(self.tuple()?),
                _ => return None,
            }
            if !self.token(",") && !self.rest.trim_start().starts_with('}') {
                return None;
            }
        }
        self.rest.trim().is_empty().then_some(())?;
        Some((descr?, fortran?, shape?))
    }

    /// Skips `text` after white space; false if something else is there.
    fn token(&mut self, text: &str) -> bool {
        let stripped = self.rest.trim_start().strip_prefix(text);
        self.rest = stripped.unwrap_or(self.rest);
        stripped.is_some()
    }

    fn string(&mut self) -> Option<&'a str> {
        let quote = if self.token("'") { '\'' } else { self.token("\"").then_some('"')? };
        let (string, rest) = self.rest.split_once(quote)?;
        self.rest = rest;
        Some(string)
    }

    fn boolean(&mut self) -> Option<bool> {
        if self.token("True") { Some(true) } else { self.token("False").then_some(false) }
    }

    fn tuple(&mut self) -> Option<Vec<usize>> {
        let mut axes = Vec::new();
        self.token("(").then_some(())?;
        while !self.token(")") {
            let text = self.rest.trim_start();
            let end = text.find(|c: char| !c.is_ascii_digit())?;
            let (digits, rest) = text.split_at_checked(end)?;
            axes.push(digits.parse().ok()?);
            // Python 2 wrote long integers with an L.
            self.rest = rest.strip_prefix('L').unwrap_or(rest);
            if (!self.token(",") && !self.rest.trim_start().starts_with(')'))
                || axes.len() > MOST_AXES
            {
                return None;
            }
        }
        Some(axes)
    }
}

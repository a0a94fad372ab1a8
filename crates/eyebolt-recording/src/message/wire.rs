//! Fields of a message out of its bytes, by the rules of ROS 1 or of ROS 2.

use crate::bag::Encoding;

/// What is wrong with a message: which field, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct WireProblem {
    pub(crate) field: &'static str,
    pub(crate) problem: String,
}

impl WireProblem {
    pub(crate) fn new(field: &'static str, problem: impl Into<String>) -> Self {
        Self { field, problem: problem.into() }
    }
}

/// Reads one field after the other. Nothing is allocated by what the bytes claim.
#[derive(Clone, Debug)]
pub(crate) struct WireReader<'a> {
    bytes: &'a [u8],
    at: usize,
    rule: Rule,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// Little-endian, packed; texts without a zero at their end; headers with a sequence number.
    Ros1,
    /// Common Data Representation: numbers start at multiples of their size, at most `widest`.
    Cdr { big_endian: bool, widest: usize },
}

/// Bytes of the encapsulation before the fields in ROS 2; alignment counts from behind it.
const ENCAPSULATION: usize = 4;

impl<'a> WireReader<'a> {
    /// At the first field of the message `bytes`.
    pub(crate) fn new(encoding: &Encoding, bytes: &'a [u8]) -> Result<Self, WireProblem> {
        match encoding {
            Encoding::Ros1 => Ok(Self { bytes, at: 0, rule: Rule::Ros1 }),
            Encoding::Cdr => {
                let rule = match bytes {
                    [0, kind @ (0 | 1), _, _, ..] => {
                        Rule::Cdr { big_endian: *kind == 0, widest: 8 }
                    }
                    // Version 2 aligns eight-byte numbers to four.
                    [0, kind @ (6 | 7), _, _, ..] => {
                        Rule::Cdr { big_endian: *kind == 6, widest: 4 }
                    }
                    [_, _, _, _, ..] => {
                        let problem = "the first four bytes are of no known representation";
                        return Err(WireProblem::new("encapsulation", problem));
                    }
                    _ => return Err(WireProblem::new("encapsulation", "the message is cut short")),
                };
                let bytes = bytes.get(ENCAPSULATION..).unwrap_or_default();
                Ok(Self { bytes, at: 0, rule })
            }
            Encoding::Other(name) => {
                let problem = format!("messages in \"{name}\" are not read here");
                Err(WireProblem::new("encoding", problem))
            }
        }
    }

    /// Whether the message is of ROS 1.
    pub(crate) fn is_ros1(&self) -> bool {
        self.rule == Rule::Ros1
    }

    /// Bytes not read yet.
    fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    fn take(&mut self, field: &'static str, count: usize) -> Result<&'a [u8], WireProblem> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let Some(taken) = taken else {
            let problem = format!("takes {count} bytes, but {} are left", self.left());
            return Err(WireProblem::new(field, problem));
        };
        self.at += count;
        Ok(taken)
    }

    fn number<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], WireProblem> {
        let mut big_endian = false;
        if let Rule::Cdr { big_endian: big, widest } = self.rule {
            self.at = self.at.next_multiple_of(N.clamp(1, widest));
            big_endian = big;
        }
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(field, N)?);
        if big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    pub(crate) fn u8(&mut self, field: &'static str) -> Result<u8, WireProblem> {
        self.number(field).map(u8::from_le_bytes)
    }

    pub(crate) fn bool(&mut self, field: &'static str) -> Result<bool, WireProblem> {
        self.u8(field).map(|value| value != 0)
    }

    pub(crate) fn u32(&mut self, field: &'static str) -> Result<u32, WireProblem> {
        self.number(field).map(u32::from_le_bytes)
    }

    pub(crate) fn i32(&mut self, field: &'static str) -> Result<i32, WireProblem> {
        self.number(field).map(i32::from_le_bytes)
    }

    pub(crate) fn f64(&mut self, field: &'static str) -> Result<f64, WireProblem> {
        self.number(field).map(f64::from_le_bytes)
    }

    /// `N` numbers without a length before them.
    pub(crate) fn f64_array<const N: usize>(
        &mut self,
        field: &'static str,
    ) -> Result<[f64; N], WireProblem> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.f64(field)?;
        }
        Ok(numbers)
    }

    pub(crate) fn f64_sequence(&mut self, field: &'static str) -> Result<Vec<f64>, WireProblem> {
        let count = self.count(field, size_of::<f64>())?;
        (0..count).map(|_| self.f64(field)).collect()
    }

    /// The length of a sequence whose elements take at least `size` bytes each.
    pub(crate) fn count(&mut self, field: &'static str, size: usize) -> Result<usize, WireProblem> {
        let count = self.u32(field)? as usize;
        if count.saturating_mul(size) > self.left() {
            let problem = format!("claims {count} elements, but {} bytes are left", self.left());
            return Err(WireProblem::new(field, problem));
        }
        Ok(count)
    }

    /// A sequence of bytes.
    pub(crate) fn blob(&mut self, field: &'static str) -> Result<&'a [u8], WireProblem> {
        let count = self.u32(field)? as usize;
        self.take(field, count)
    }

    pub(crate) fn string(&mut self, field: &'static str) -> Result<&'a str, WireProblem> {
        let bytes = self.blob(field)?;
        // ROS 2 counts the zero at the end.
        let text = match self.rule {
            Rule::Ros1 => bytes,
            Rule::Cdr { .. } => bytes.strip_suffix(&[0]).unwrap_or(bytes),
        };
        str::from_utf8(text).map_err(|_| WireProblem::new(field, "the text is not UTF-8"))
    }
}

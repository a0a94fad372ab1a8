//! The header of a record: fields `name=value`, each behind its length.

/// What a record is, its field `op`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    Message,
    BagHeader,
    Chunk,
    Connection,
    /// A part of the index, or what a later version of the format may add.
    Other,
}

/// The fields of a record, which were seen to be whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Header<'a>(&'a [u8]);

impl<'a> Header<'a> {
    /// From the bytes behind the header's length, or what is wrong with them.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, String> {
        let mut rest = bytes;
        while !rest.is_empty() {
            let (field, behind) =
                split_sized(rest).ok_or("a field is longer than the header that it is in")?;
            if !field.contains(&b'=') {
                return Err("a field of its header has no `=`".to_owned());
            }
            rest = behind;
        }
        Ok(Self(bytes))
    }

    pub(super) fn op(self) -> Result<Op, String> {
        let [op] = self.number("op")?;
        Ok(match op {
            0x02 => Op::Message,
            0x03 => Op::BagHeader,
            0x05 => Op::Chunk,
            0x07 => Op::Connection,
            _ => Op::Other,
        })
    }

    pub(super) fn u32(self, name: &str) -> Result<u32, String> {
        self.number(name).map(u32::from_le_bytes)
    }

    pub(super) fn u64(self, name: &str) -> Result<u64, String> {
        self.number(name).map(u64::from_le_bytes)
    }

    /// A time in nanoseconds, stored as seconds and nanoseconds. Cannot overflow.
    pub(super) fn time_ns(self, name: &str) -> Result<i64, String> {
        let [a, b, c, d, e, f, g, h] = self.number(name)?;
        let seconds = i64::from(u32::from_le_bytes([a, b, c, d]));
        Ok(seconds * 1_000_000_000 + i64::from(u32::from_le_bytes([e, f, g, h])))
    }

    pub(super) fn text(self, name: &str) -> Result<&'a str, String> {
        str::from_utf8(self.bytes(name)?).map_err(|_| format!("its field `{name}` is not text"))
    }

    fn number<const N: usize>(self, name: &str) -> Result<[u8; N], String> {
        let bytes = self.bytes(name)?;
        bytes.try_into().map_err(|_| {
            format!("its field `{name}` has {} bytes where {N} are needed", bytes.len())
        })
    }

    /// The last field of the name, as ROS takes it.
    fn bytes(self, name: &str) -> Result<&'a [u8], String> {
        let (mut rest, mut value) = (self.0, None);
        while let Some((field, behind)) = split_sized(rest) {
            let after_name = field.strip_prefix(name.as_bytes());
            value = after_name.and_then(|tail| tail.strip_prefix(b"=")).or(value);
            rest = behind;
        }
        value.ok_or_else(|| format!("it has no field `{name}`"))
    }
}

/// The bytes behind a length, and what follows them; `None` if there are fewer than that.
pub(super) fn split_sized(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    rest.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)
}

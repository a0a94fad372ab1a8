//! Fields of ROS 2 messages (little-endian CDR), read without the code that wrote them.

/// Reads one field after the other.
pub struct Wire<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Wire<'a> {
    /// Behind the encapsulation of a message.
    pub fn new(message: &'a [u8]) -> Self {
        assert_eq!(message[..4], [0, 1, 0, 0]);
        Self { bytes: &message[4..], at: 0 }
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        self.at = self.at.next_multiple_of(N);
        self.at += N;
        self.bytes[self.at - N..self.at].try_into().unwrap()
    }

    pub fn u8(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    pub fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    pub fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    pub fn f64s<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.f64())
    }

    pub fn skip(&mut self, count: usize) {
        for _ in 0..count {
            self.u32();
        }
    }

    pub fn blob(&mut self) -> &'a [u8] {
        let count = self.u32() as usize;
        self.at += count;
        &self.bytes[self.at - count..self.at]
    }

    pub fn string(&mut self) -> String {
        let (_, text) = self.blob().split_last().unwrap();
        String::from_utf8(text.to_vec()).unwrap()
    }

    /// Stamp (nanoseconds) and frame of a header.
    pub fn header(&mut self) -> (i64, String) {
        let (seconds, nanoseconds) = (i64::from(self.u32()), i64::from(self.u32()));
        (seconds * 1_000_000_000 + nanoseconds, self.string())
    }

    /// The message ends here.
    pub fn end(&self) {
        assert_eq!(self.at, self.bytes.len());
    }
}

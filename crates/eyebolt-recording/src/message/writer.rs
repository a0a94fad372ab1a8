//! Fields of a message into bytes, as ROS 2 writes them (little-endian CDR).

/// The little-endian encapsulation of CDR.
const ENCAPSULATION: [u8; 4] = [0, 1, 0, 0];

/// Writes one field after the other.
#[derive(Clone, Debug)]
pub(crate) struct WireWriter {
    bytes: Vec<u8>,
}

impl WireWriter {
    pub(crate) fn new() -> Self {
        Self { bytes: ENCAPSULATION.to_vec() }
    }

    /// The message.
    pub(crate) fn finish(self) -> Vec<u8> {
        self.bytes
    }

    fn number<const N: usize>(&mut self, bytes: [u8; N]) {
        // The encapsulation is of four bytes, and alignment counts from behind it.
        let length = self.bytes.len() - ENCAPSULATION.len();
        let padded = ENCAPSULATION.len() + length.next_multiple_of(N.max(1));
        self.bytes.resize(padded, 0);
        self.bytes.extend(bytes);
    }

    pub(crate) fn u8(&mut self, value: u8) {
        self.number([value]);
    }

    pub(crate) fn bool(&mut self, value: bool) {
        self.u8(u8::from(value));
    }

    pub(crate) fn u32(&mut self, value: u32) {
        self.number(value.to_le_bytes());
    }

    pub(crate) fn i32(&mut self, value: i32) {
        self.number(value.to_le_bytes());
    }

    pub(crate) fn f32(&mut self, value: f32) {
        self.number(value.to_le_bytes());
    }

    pub(crate) fn f64(&mut self, value: f64) {
        self.number(value.to_le_bytes());
    }

    /// Numbers without their count.
    pub(crate) fn f64_array(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.f64(*value));
    }

    /// Numbers behind their count.
    pub(crate) fn f64_sequence(&mut self, values: &[f64]) {
        self.count(values.len());
        self.f64_array(values);
    }

    /// The length of a sequence. No message of ours has more than 2^32 elements.
    pub(crate) fn count(&mut self, count: usize) {
        self.u32(u32::try_from(count).unwrap_or(u32::MAX));
    }

    /// A sequence of bytes.
    pub(crate) fn blob(&mut self, bytes: &[u8]) {
        self.count(bytes.len());
        self.bytes.extend(bytes);
    }

    pub(crate) fn string(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }
}

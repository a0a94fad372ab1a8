//! Run-length and variable-length coding of depth.
//!
//! A. D. Wilson, "Fast Lossless Depth Image Compression", ISS 2017. Runs of zeros and of values
//! take turns; values are differences to the last one, folded to be positive, in groups of three
//! bits behind a bit that says whether another group follows; groups fill words from the top.

use super::wire::WireProblem;

/// Largest picture, pixels: twice that of any depth camera, because a few bytes can claim so many.
const MOST_PIXELS: u64 = 1 << 25;

/// Bytes of width and height before the words.
const SIZE_BYTES: usize = 8;

/// Width, height and values of a picture as `compressed_depth_image_transport` stores it.
pub(super) fn decode(bytes: &[u8]) -> Result<(u32, u32, Vec<u16>), WireProblem> {
    let short = || WireProblem::new("data", "the RVL picture ends before its last pixel");
    let [w0, w1, w2, w3, h0, h1, h2, h3] = *bytes.first_chunk::<SIZE_BYTES>().ok_or_else(short)?;
    let (width, height) =
        (u32::from_le_bytes([w0, w1, w2, w3]), u32::from_le_bytes([h0, h1, h2, h3]));
    let count = u64::from(width) * u64::from(height);
    let words = bytes.get(SIZE_BYTES..).unwrap_or_default().as_chunks::<4>().0;
    if count == 0 || count > MOST_PIXELS {
        return Err(WireProblem::new("data", format!("{width} x {height} pixels")));
    }
    let count = count as usize;
    let mut nibbles = Nibbles { words, word: 0, left: 0 };
    let mut values = Vec::new();
    let mut previous = 0_i32;
    while values.len() < count {
        let zeros = nibbles.number().ok_or_else(short)? as usize;
        let filled = nibbles.number().ok_or_else(short)? as usize;
        let room = count - values.len();
        if zeros.saturating_add(filled) > room || zeros + filled == 0 {
            return Err(WireProblem::new(
                "data",
                "the runs of the RVL picture do not fit its size",
            ));
        }
        values.resize(values.len() + zeros, 0);
        for _ in 0..filled {
            let folded = nibbles.number().ok_or_else(short)?;
            let difference = (folded >> 1) as i32 ^ -((folded & 1) as i32);
            previous = previous.wrapping_add(difference);
            // As the encoder's, which knows 16 bits only.
            values.push(previous as u16);
        }
    }
    Ok((width, height, values))
}

struct Nibbles<'a> {
    words: &'a [[u8; 4]],
    word: u32,
    left: u32,
}

impl Nibbles<'_> {
    fn nibble(&mut self) -> Option<u32> {
        if self.left == 0 {
            let (first, rest) = self.words.split_first()?;
            (self.word, self.left, self.words) = (u32::from_le_bytes(*first), 8, rest);
        }
        let nibble = self.word >> 28;
        self.word <<= 4;
        self.left -= 1;
        Some(nibble)
    }

    /// A number in groups of three bits, the lowest first.
    fn number(&mut self) -> Option<u32> {
        let mut value = 0;
        for shift in (0..u32::BITS).step_by(3) {
            let nibble = self.nibble()?;
            value |= (nibble & 7) << shift;
            if nibble & 8 == 0 {
                return Some(value);
            }
        }
        // More groups than 32 bits have: no encoder wrote this.
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The encoder of the article.
    fn encode(width: u32, height: u32, values: &[u16]) -> Vec<u8> {
        let mut nibbles = Vec::new();
        let mut put = |mut value: u32| loop {
            let more = value >> 3 != 0;
            nibbles.push(value & 7 | if more { 8 } else { 0 });
            value >>= 3;
            if !more {
                break;
            }
        };
        let (mut at, mut previous) = (0, 0_i32);
        while at < values.len() {
            let zeros = values[at..].iter().take_while(|v| **v == 0).count();
            at += zeros;
            let filled = values[at..].iter().take_while(|v| **v != 0).count();
            put(zeros as u32);
            put(filled as u32);
            for value in &values[at..at + filled] {
                let difference = i32::from(*value) - previous;
                put(((difference << 1) ^ (difference >> 31)) as u32);
                previous = i32::from(*value);
            }
            at += filled;
        }
        let mut bytes = width.to_le_bytes().to_vec();
        bytes.extend(height.to_le_bytes());
        for group in nibbles.chunks(8) {
            let word = (0..8).fold(0, |word, i| word << 4 | group.get(i).copied().unwrap_or(0));
            bytes.extend(u32::to_le_bytes(word));
        }
        bytes
    }

    proptest! {
        #[test]
        fn what_was_encoded_is_decoded(
            values in proptest::collection::vec(prop_oneof![Just(0_u16), 1..300_u16, any::<u16>()], 1..200),
        ) {
            let width = values.len() as u32;
            let bytes = encode(width, 1, &values);
            prop_assert_eq!(decode(&bytes), Ok((width, 1, values)));
        }

        #[test]
        fn any_bytes_are_survived(bytes in proptest::collection::vec(any::<u8>(), 0..64)) {
            let _ = decode(&bytes);
        }

        #[test]
        fn every_cut_is_an_error(values in proptest::collection::vec(1..2000_u16, 1..50)) {
            let bytes = encode(values.len() as u32, 1, &values);
            prop_assert!(decode(&bytes[..bytes.len() - 4]).is_err());
        }
    }
}

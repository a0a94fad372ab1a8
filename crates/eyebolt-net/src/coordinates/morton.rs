//! Morton codes: three coordinates of 20 bits, their bits interleaved, x first.

/// Bits of a coordinate.
pub const BITS: u32 = 20;

/// The code of a cell whose coordinates are below `1 << BITS`.
pub fn encode([x, y, z]: [u32; 3]) -> u64 {
    (spread(x) << 2) | (spread(y) << 1) | spread(z)
}

/// The cell of a code.
pub fn decode(code: u64) -> [u32; 3] {
    [gather(code >> 2), gather(code >> 1), gather(code)]
}

/// Two zeros before every bit.
fn spread(value: u32) -> u64 {
    let mut bits = u64::from(value);
    bits = (bits | (bits << 32)) & 0x001f_0000_0000_ffff;
    bits = (bits | (bits << 16)) & 0x001f_0000_ff00_00ff;
    bits = (bits | (bits << 8)) & 0x100f_00f0_0f00_f00f;
    bits = (bits | (bits << 4)) & 0x10c3_0c30_c30c_30c3;
    (bits | (bits << 2)) & 0x1249_2492_4924_9249
}

/// Every third bit.
fn gather(code: u64) -> u32 {
    let mut bits = code & 0x1249_2492_4924_9249;
    bits = (bits | (bits >> 2)) & 0x10c3_0c30_c30c_30c3;
    bits = (bits | (bits >> 4)) & 0x100f_00f0_0f00_f00f;
    bits = (bits | (bits >> 8)) & 0x001f_0000_ff00_00ff;
    bits = (bits | (bits >> 16)) & 0x001f_0000_0000_ffff;
    ((bits | (bits >> 32)) & 0x001f_ffff) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn decoding_inverts_encoding(cell in [0_u32..1 << BITS, 0..1 << BITS, 0..1 << BITS]) {
            prop_assert_eq!(decode(encode(cell)), cell);
        }

        #[test]
        fn halving_a_cell_drops_three_bits(cell in [0_u32..1 << BITS, 0..1 << BITS, 0..1 << BITS]) {
            prop_assert_eq!(encode(cell.map(|value| value / 2)), encode(cell) >> 3);
        }
    }

    #[test]
    fn z_is_the_fastest() {
        assert_eq!([encode([0, 0, 1]), encode([0, 1, 0]), encode([1, 0, 0])], [1, 2, 4]);
    }
}

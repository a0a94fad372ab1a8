//! Decompression of LZF, as in Marc Lehmann's liblzf.
//!
//! A stream of literal runs (a byte below 32, then one byte more than it says) and of references
//! back into what has been decompressed (three bits of length, 13 of distance; a length of all
//! ones is continued in a byte of its own).

/// Most bytes that one compressed byte stands for: references of three bytes make 264.
const LARGEST_EXPANSION: usize = 88;

/// What `packed` decompresses to, which must be `length` bytes; or what is wrong with it.
pub(super) fn decompress(packed: &[u8], length: usize) -> Result<Vec<u8>, String> {
    if length / LARGEST_EXPANSION > packed.len() {
        return Err(format!("{} compressed bytes cannot hold {length}", packed.len()));
    }
    let mut out = Vec::with_capacity(length);
    let mut rest = packed;
    while let Some((control, after)) = rest.split_first() {
        rest = step(*control, after, &mut out)?;
        if out.len() > length {
            return Err(format!("the compressed points hold more than their {length} bytes"));
        }
    }
    if out.len() < length {
        return Err(format!("the compressed points hold {} of {length} bytes", out.len()));
    }
    Ok(out)
}

/// Appends what the run or reference of `control` stands for; returns what follows it in `rest`.
fn step<'a>(control: u8, rest: &'a [u8], out: &mut Vec<u8>) -> Result<&'a [u8], &'static str> {
    const ENDS: &str = "the compressed points end within a run";
    let control = usize::from(control);
    if control < 32 {
        let (literal, rest) = rest.split_at_checked(control + 1).ok_or(ENDS)?;
        out.extend_from_slice(literal);
        return Ok(rest);
    }
    let (more, rest) = match control >> 5 {
        7 => rest.split_first().ok_or(ENDS)?,
        _ => (&0, rest),
    };
    let (low, rest) = rest.split_first().ok_or(ENDS)?;
    let length = (control >> 5) + usize::from(*more) + 2;
    let distance = ((control & 31) << 8) + usize::from(*low) + 1;
    let start = out.len().checked_sub(distance).ok_or("a reference leads before the first byte")?;
    for at in start..start + length {
        // Byte by byte: a reference may reach into what it makes itself.
        let byte = out.get(at).copied().unwrap_or_default();
        out.push(byte);
    }
    Ok(rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A greedy encoder: the longest of the nearest matches, literals otherwise.
    fn compress(data: &[u8]) -> Vec<u8> {
        let mut packed = Vec::new();
        let mut literal: Vec<u8> = Vec::new();
        let flush = |literal: &mut Vec<u8>, packed: &mut Vec<u8>| {
            for run in literal.chunks(32) {
                packed.push(u8::try_from(run.len() - 1).unwrap());
                packed.extend(run);
            }
            literal.clear();
        };
        let mut at = 0;
        while at < data.len() {
            let matching = |distance: usize| {
                let ahead = data[at..].iter().zip(&data[at - distance..]);
                ahead.take(264).take_while(|(a, b)| a == b).count()
            };
            let best = (1..=at.min(8192)).map(|d| (matching(d), d)).max_by_key(|(n, _)| *n);
            match best {
                Some((length, distance)) if length >= 3 => {
                    flush(&mut literal, &mut packed);
                    let (code, back) = (length - 2, distance - 1);
                    packed.push(u8::try_from(code.min(7) << 5 | back >> 8).unwrap());
                    if code >= 7 {
                        packed.push(u8::try_from(code - 7).unwrap());
                    }
                    packed.push(u8::try_from(back & 255).unwrap());
                    at += length;
                }
                _ => {
                    literal.push(data[at]);
                    at += 1;
                }
            }
        }
        flush(&mut literal, &mut packed);
        packed
    }

    proptest! {
        #[test]
        fn what_was_compressed_comes_back(
            pieces in proptest::collection::vec(("[ab]{0,9}", 1_usize..60), 0..12),
        ) {
            let data = pieces.iter().map(|(text, n)| text.repeat(*n)).collect::<String>();
            let packed = compress(data.as_bytes());
            prop_assert_eq!(decompress(&packed, data.len()), Ok(data.clone().into_bytes()));
            prop_assert!(decompress(&packed, data.len() + 1).is_err());
            if let Some(fewer) = data.len().checked_sub(1) {
                prop_assert!(decompress(&packed, fewer).is_err());
                let cut = &packed[..packed.len() - 1];
                prop_assert!(decompress(cut, data.len()).is_err());
            }
        }

        #[test]
        fn far_references_come_back(far in 1_usize..8192, seed in any::<u32>()) {
            let mut state = seed | 1;
            let mut data: Vec<u8> = Vec::new();
            for _ in 0..far.max(9) {
                state ^= state << 13;
                state ^= state >> 17;
                state ^= state << 5;
                data.push(state.to_le_bytes()[1]);
            }
            data.extend_from_within(..9);
            // Literals alone, then one reference that the encoder above seldom finds.
            let (literals, _) = data.split_at(data.len() - 9);
            let mut packed: Vec<u8> = Vec::new();
            for run in literals.chunks(32) {
                packed.push(u8::try_from(run.len() - 1).unwrap());
                packed.extend(run);
            }
            let back = literals.len() - 1;
            packed.extend([7 << 5 | u8::try_from(back >> 8).unwrap(), 0, (back & 255) as u8]);
            prop_assert_eq!(decompress(&packed, data.len()), Ok(data.clone()));
        }

        #[test]
        fn any_bytes_are_safe(packed in proptest::collection::vec(any::<u8>(), 0..64), length in 0_usize..5000) {
            if let Ok(data) = decompress(&packed, length) {
                prop_assert_eq!(data.len(), length);
            }
        }
    }

    #[test]
    fn lies_are_told() {
        let says = |packed: &[u8], length: usize, part: &str| {
            let problem = decompress(packed, length).unwrap_err();
            assert!(problem.contains(part), "{problem}");
        };
        says(&[0, 7], usize::MAX, "cannot hold");
        says(&[0, 7, 32, 1], 4, "before the first byte");
        says(&[32, 0], 3, "before the first byte");
        says(&[5, 1], 6, "end within a run");
        says(&[0, 7, 7 << 5], 9, "end within a run");
        says(&[0, 7, 7 << 5, 255], 9, "end within a run");
        says(&[0, 7], 2, "1 of 2 bytes");
        assert_eq!(decompress(&[0, 7, 7 << 5, 255, 0], 265), Ok(vec![7; 265]));
    }
}

//! Scores as an event file of TensorBoard.

use super::run::Report;

/// The bytes of an event file with the numbers of `reports`: loss, learning rate and scores by step.
///
/// Records of TensorFlow (length, its checksum, bytes, their checksum), each an `Event` of protocol
/// buffers with a `Summary` of simple values. Times are not told: the same run gives the same bytes.
pub fn events(reports: &[Report]) -> Vec<u8> {
    let mut file = Vec::new();
    record(&mut file, &field(3, b"brain.Event:2"));
    for report in reports {
        let fixed = [("train/loss", report.loss), ("train/rate", report.rate)];
        let fixed = fixed.map(|(name, value)| (name.to_owned(), value));
        let scores =
            report.scores.iter().map(|(name, value)| (format!("validation/{name}"), *value));
        let mut summary = Vec::new();
        for (name, value) in fixed.into_iter().chain(scores) {
            let mut one = field(1, name.as_bytes());
            // `simple_value`, 32 bits.
            one.push(2 << 3 | 5);
            one.extend((value as f32).to_le_bytes());
            summary.extend(field(1, &one));
        }
        let mut event = vec![2 << 3];
        varint(&mut event, report.step);
        event.extend(field(5, &summary));
        record(&mut file, &event);
    }
    file
}

fn record(file: &mut Vec<u8>, bytes: &[u8]) {
    let length = (bytes.len() as u64).to_le_bytes();
    file.extend(length);
    file.extend(masked(crc32c(&length)).to_le_bytes());
    file.extend(bytes);
    file.extend(masked(crc32c(bytes)).to_le_bytes());
}

/// A field of bytes with its number and length.
fn field(number: u8, bytes: &[u8]) -> Vec<u8> {
    let mut out = vec![number << 3 | 2];
    varint(&mut out, bytes.len() as u64);
    out.extend(bytes);
    out
}

fn varint(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

/// Castagnoli's polynomial, reflected.
fn crc32c(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0x82f6_3b78 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}

fn masked(crc: u32) -> u32 {
    crc.rotate_right(15).wrapping_add(0xa282_ead8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_castagnolis() {
        // RFC 3720, appendix B.4, and the usual check value.
        assert_eq!(crc32c(b"123456789"), 0xe306_9283);
        assert_eq!(crc32c(&[0; 32]), 0x8a91_36aa);
    }

    #[test]
    fn the_file_is_what_tensorboard_reads() {
        let scores = [("arm_iou".to_owned(), 0.5)].into();
        let report = Report {
            step: 300,
            steps: 400,
            loss: 0.25,
            rate: 0.001,
            scores,
            is_best: true,
            waited_share: 0.0,
        };
        let file = events(&[report]);
        // A header of 12 bytes, `brain.Event:2` with its field's head, 4 of checksum.
        assert_eq!(file[..8], 15_u64.to_le_bytes());
        assert_eq!(file[12..27], *b"\x1a\x0dbrain.Event:2");
        let event = &file[31 + 12..file.len() - 4];
        // Step 300 as a varint, then the summary.
        assert_eq!(event[..3], [0x10, 0xac, 0x02]);
        assert_eq!(event[3], 0x2a);
        let text = String::from_utf8_lossy(event);
        assert!(text.contains("train/loss") && text.contains("validation/arm_iou"));
        assert!(event.windows(4).any(|bytes| bytes == 0.5_f32.to_le_bytes()));
    }
}

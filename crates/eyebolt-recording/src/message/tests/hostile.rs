//! Cut and changed messages are errors or values, never a panic.

use super::super::{CloudMessage, Header, PointField, types};

use super::rosbags::fixtures;
use super::support::read;
use crate::bag::Encoding;
use proptest::prelude::*;

#[test]
fn every_prefix_is_survived() {
    for fixture in fixtures() {
        let whole = read(&fixture.message_type, &fixture.encoding, &fixture.bytes);
        assert_eq!(whole, Ok(()), "{}", fixture.name);
        for length in 0..fixture.bytes.len() {
            let bytes = &fixture.bytes[..length];
            let read = read(&fixture.message_type, &fixture.encoding, bytes);
            // Of these the reader needs the last field.
            let needs_all = matches!(
                fixture.message_type.as_str(),
                types::CLOUD | types::COMPRESSED_IMAGE | types::TRANSFORMS | types::STRING
            );
            assert!(read.is_err() || !needs_all, "{} of {length} bytes", fixture.name);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn every_changed_byte_is_survived(
        which in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        value in any::<u8>(),
        also in any::<prop::sample::Index>(),
    ) {
        thread_local!(static FIXTURES: Vec<super::rosbags::Fixture> = fixtures());
        FIXTURES.with(|fixtures| {
            let fixture = &fixtures[which.index(fixtures.len())];
            let mut bytes = fixture.bytes.clone();
            *at.get_mut(&mut bytes) = value;
            // The largest counts and sizes.
            *also.get_mut(&mut bytes) = u8::MAX;
            let _ = read(&fixture.message_type, &fixture.encoding, &bytes);
        });
    }

    #[test]
    fn any_bytes_are_survived(
        kind in 0_u8..12,
        message_type in prop::sample::select(vec![
            types::IMAGE, types::COMPRESSED_IMAGE, types::CLOUD, types::CAMERA_INFO,
            types::JOINT_STATE, types::TRANSFORMS, types::STRING,
        ]),
        bytes in prop::collection::vec(prop_oneof![Just(0), Just(1), Just(4), any::<u8>()], 0..200),
    ) {
        let mut message = vec![0, kind, 0, 0];
        message.extend(&bytes);
        let _ = read(message_type, &Encoding::Cdr, &message);
        let _ = read(message_type, &Encoding::Ros1, &bytes);
    }
}

#[test]
fn what_is_claimed_is_not_allocated() {
    // A sequence of 2^32 - 1 elements, and none of them there.
    for message_type in [types::TRANSFORMS, types::STRING] {
        let problem = read(message_type, &Encoding::Ros1, &[u8::MAX; 4]).unwrap_err().problem;
        assert!(problem.contains("4294967295"), "{problem}");
    }
    // Pictures of 65535 x 65535 and 8192 x 4097 pixels in a few bytes.
    for (width, height) in [(65_535_u32, 65_535_u32), (8192, 4097)] {
        let mut picture = vec![0; 12];
        picture.extend(width.to_le_bytes());
        picture.extend(height.to_le_bytes());
        picture.extend([u8::MAX; 8]);
        let message = super::super::CompressedImageMessage {
            header: super::super::Header { stamp_ns: 1, frame_id: "" },
            format: "16UC1; compressedDepth rvl",
            data: &picture,
        };
        let problem = message.depth().unwrap_err().problem;
        assert_eq!(problem, format!("{width} x {height} pixels"));
    }
}

#[test]
fn points_may_not_all_be_made_of_the_same_bytes() {
    // x, y and z of every point are its only four bytes, so that points take three times as much as
    // the message.
    let field = |name| PointField { name, offset: 0, datatype: 7, count: 1 };
    let cloud = CloudMessage {
        header: Header { stamp_ns: 1, frame_id: "" },
        height: 1,
        width: (1 << 24) + 1,
        fields: ["x", "y", "z"].map(field).to_vec(),
        big_endian: false,
        point_step: 4,
        row_step: 4 << 24,
        data: &[],
        is_dense: true,
    };
    assert_eq!(cloud.points().unwrap_err().problem, "16777217 x 1 points");
}

//! What we write is read as it was, and what `rosbags` wrote is written as it is.

use super::super::{
    CameraInfoMessage, CloudMessage, CompressedImageMessage, Diagnostic, DiagnosticLevel, Header,
    ImageMessage, JointStateMessage, PointField, StaticTransform, WireReader, diagnostic_message,
    transforms, write_transforms,
};
use super::rosbags::fixtures;
use crate::bag::Encoding;
use crate::message::types;
use proptest::prelude::*;

fn reader(bytes: &[u8]) -> WireReader<'_> {
    WireReader::new(&Encoding::Cdr, bytes).unwrap()
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>().prop_filter("comparable", |v| !v.is_nan()), Just(0.0)]
}

fn numbers<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    prop::collection::vec(number(), N).prop_map(|values| values.try_into().unwrap())
}

fn stamp() -> impl Strategy<Value = i64> {
    i64::from(i32::MIN) * 1_000_000_000..i64::from(i32::MAX) * 1_000_000_000
}

proptest! {
    #[test]
    fn pictures(
        stamp_ns in stamp(), frame_id in ".{0,9}", height in any::<u32>(), width in any::<u32>(),
        encoding in ".{0,9}", big_endian in any::<bool>(), step in any::<u32>(),
        data in prop::collection::vec(any::<u8>(), 0..40),
    ) {
        let header = Header { stamp_ns, frame_id: &frame_id };
        let image = ImageMessage { header, height, width, encoding: &encoding, big_endian, step, data: &data };
        let bytes = image.write();
        prop_assert_eq!(ImageMessage::read(&mut reader(&bytes)), Ok(image));
        let compressed = CompressedImageMessage { header, format: &encoding, data: &data };
        let bytes = compressed.write();
        prop_assert_eq!(CompressedImageMessage::read(&mut reader(&bytes)), Ok(compressed));
    }

    #[test]
    fn joints(
        stamp_ns in stamp(), frame_id in ".{0,9}",
        joints in prop::collection::vec((".{0,9}", number()), 0..9), told in any::<bool>(),
    ) {
        let positions = joints.iter().map(|(_, position)| *position).filter(|_| told).collect();
        let names = joints.iter().map(|(name, _)| name.as_str()).collect();
        let message = JointStateMessage { header: Header { stamp_ns, frame_id: &frame_id }, names, positions };
        let bytes = message.write();
        prop_assert_eq!(JointStateMessage::read(&mut reader(&bytes)), Ok(message));
    }

    #[test]
    fn cameras(
        size in any::<(u32, u32)>(), model in "[a-z_]{0,20}", d in prop::collection::vec(number(), 0..9),
        k in numbers::<9>(), r in numbers::<9>(), p in numbers::<12>(),
        binning in any::<[u32; 2]>(), roi in any::<[u32; 4]>(), do_rectify in any::<bool>(),
    ) {
        let header = Header { stamp_ns: 7, frame_id: "optical" };
        let (height, width) = size;
        let camera = CameraInfoMessage { header, height, width, distortion_model: &model, d, k, r, p, binning, roi, do_rectify };
        let bytes = camera.write();
        prop_assert_eq!(CameraInfoMessage::read(&mut reader(&bytes)), Ok(camera));
    }

    #[test]
    fn clouds(
        size in any::<(u32, u32)>(), steps in any::<(u32, u32)>(), flags in any::<(bool, bool)>(),
        fields in prop::collection::vec((".{0,5}", any::<u32>(), any::<u8>(), any::<u32>()), 0..5),
        data in prop::collection::vec(any::<u8>(), 0..40),
    ) {
        let field = |(name, offset, datatype, count): &'_ (String, u32, u8, u32)| {
            (name.clone(), *offset, *datatype, *count)
        };
        let owned: Vec<_> = fields.iter().map(field).collect();
        let fields = owned.iter().map(|(name, offset, datatype, count)| PointField {
            name, offset: *offset, datatype: *datatype, count: *count,
        }).collect();
        let cloud = CloudMessage {
            header: Header { stamp_ns: 7, frame_id: "optical" }, height: size.0, width: size.1, fields,
            big_endian: flags.0, point_step: steps.0, row_step: steps.1, data: &data, is_dense: flags.1,
        };
        let bytes = cloud.write();
        prop_assert_eq!(CloudMessage::read(&mut reader(&bytes)), Ok(cloud));
    }

    #[test]
    fn frames(
        listed in prop::collection::vec(("[a-z]{0,9}", "[a-z]{0,9}", numbers::<3>(), numbers::<4>()), 0..5),
        stamp_ns in stamp(),
    ) {
        let listed: Vec<_> = listed.into_iter().map(|(parent, child, translation_m, rotation_xyzw)| {
            StaticTransform { parent, child, translation_m, rotation_xyzw }
        }).collect();
        let bytes = write_transforms(&listed, stamp_ns);
        prop_assert_eq!(transforms(&mut reader(&bytes)), Ok(listed));
    }

    #[test]
    fn diagnostics(
        stamp_ns in stamp(), name in ".{0,9}", message in ".{0,9}", hardware_id in ".{0,9}",
        values in prop::collection::vec((".{0,9}", ".{0,9}"), 0..9),
    ) {
        let values: Vec<_> = values.iter().map(|(key, value)| (key.as_str(), value.clone())).collect();
        let level = DiagnosticLevel::Error;
        let told = Diagnostic { level, name: &name, message: &message, hardware_id: &hardware_id, values: &values };
        let bytes = diagnostic_message(stamp_ns, &told);
        let mut reader = reader(&bytes);
        prop_assert_eq!(Header::read(&mut reader), Ok(Header { stamp_ns, frame_id: "" }));
        prop_assert_eq!(reader.u32("status"), Ok(1));
        prop_assert_eq!(reader.u8("level"), Ok(2));
        for text in [&name, &message, &hardware_id] {
            prop_assert_eq!(reader.string("status"), Ok(text.as_str()));
        }
        prop_assert_eq!(reader.u32("values"), Ok(values.len() as u32));
        for (key, value) in &values {
            prop_assert_eq!(reader.string("key"), Ok(*key));
            prop_assert_eq!(reader.string("value"), Ok(value.as_str()));
        }
    }
}

/// `rosbags` writes the messages that we write too, so the bytes must be the same.
#[test]
fn the_bytes_are_those_of_rosbags() {
    let mut compared = 0;
    for fixture in fixtures().iter().filter(|fixture| fixture.name.ends_with("little")) {
        let bytes = fixture.bytes.as_slice();
        let mut reader = reader(bytes);
        let written = match fixture.message_type.as_str() {
            types::IMAGE => ImageMessage::read(&mut reader).unwrap().write(),
            types::COMPRESSED_IMAGE => CompressedImageMessage::read(&mut reader).unwrap().write(),
            types::CLOUD => CloudMessage::read(&mut reader).unwrap().write(),
            // Of the others we leave something out.
            _ => continue,
        };
        // Padding is whatever the writer has there.
        assert_eq!(written, bytes, "{}", fixture.name);
        compared += 1;
    }
    assert!(compared > 15);
}

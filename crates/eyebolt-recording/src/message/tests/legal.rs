//! Strange messages that mean something, and what is refused with its name.

use super::super::{
    CompressedImageMessage, Header, ImageMessage, JointStateMessage, WireReader, text,
};
use crate::bag::Encoding;

/// A joint state in version 2 of CDR, which aligns eight-byte numbers to four.
fn version_2(big_endian: bool) -> Vec<u8> {
    let mut bytes = vec![0, if big_endian { 6 } else { 7 }, 0, 0];
    let mut put = |number: &[u8]| {
        let mut number = number.to_vec();
        if !big_endian {
            number.reverse();
        }
        bytes.extend(number);
    };
    // Stamp, an empty frame, one joint called "a", one position.
    for number in [5_u32, 6, 1] {
        put(&number.to_be_bytes());
    }
    put(&[0]);
    (0..3).for_each(|_| put(&[0]));
    put(&1_u32.to_be_bytes());
    put(&2_u32.to_be_bytes());
    put(b"a");
    put(&[0]);
    (0..2).for_each(|_| put(&[0]));
    put(&1_u32.to_be_bytes());
    put(&0.75_f64.to_be_bytes());
    bytes
}

#[test]
fn version_2_of_cdr_aligns_to_four() {
    for big_endian in [false, true] {
        let bytes = version_2(big_endian);
        let mut reader = WireReader::new(&Encoding::Cdr, &bytes).unwrap();
        let joints = JointStateMessage::read(&mut reader).unwrap();
        assert_eq!(joints.header, Header { stamp_ns: 5_000_000_006, frame_id: "" });
        assert_eq!((joints.names, joints.positions), (vec!["a"], vec![0.75]));
    }
}

#[test]
fn texts_may_lack_the_zero_at_their_end() {
    let mut reader =
        WireReader::new(&Encoding::Cdr, &[0, 1, 0, 0, 2, 0, 0, 0, b'h', b'i']).unwrap();
    assert_eq!(text(&mut reader), Ok("hi"));
    let mut empty = WireReader::new(&Encoding::Cdr, &[0, 1, 0, 0, 0, 0, 0, 0]).unwrap();
    assert_eq!(text(&mut empty), Ok(""));
}

#[test]
fn other_representations_are_named() {
    let json = Encoding::Other("json".to_owned());
    assert_eq!(
        WireReader::new(&json, b"{}").unwrap_err().problem,
        "messages in \"json\" are not read here"
    );
    for kind in [2, 3, 8, 10, 255] {
        let problem = WireReader::new(&Encoding::Cdr, &[0, kind, 0, 0]).unwrap_err();
        assert_eq!(problem.field, "encapsulation");
    }
    assert!(WireReader::new(&Encoding::Cdr, &[0, 1, 0]).is_err());
}

#[test]
fn positions_need_not_be_as_many_as_names() {
    let message = JointStateMessage {
        header: Header { stamp_ns: 0, frame_id: "" },
        names: vec!["a", "b"],
        positions: vec![1.0],
    };
    let bytes = message.write();
    let mut reader = WireReader::new(&Encoding::Cdr, &bytes).unwrap();
    assert_eq!(JointStateMessage::read(&mut reader).unwrap(), message);
}

fn image<'a>(
    encoding: &'a str,
    width: u32,
    height: u32,
    step: u32,
    data: &'a [u8],
) -> ImageMessage<'a> {
    let header = Header { stamp_ns: 0, frame_id: "" };
    ImageMessage { header, height, width, encoding, big_endian: false, step, data }
}

#[test]
fn pictures_must_fit_their_data() {
    let field = |image: ImageMessage<'_>| {
        assert_eq!(image.check().is_err(), image.depth_m().is_err());
        image.depth_m().map_err(|problem| problem.field)
    };
    let data = [1_u8; 12];
    assert!(field(image("16UC1", 3, 2, 6, &data)).is_ok());
    assert!(field(image("16UC1", 2, 2, 8, &data)).is_ok(), "the last row may lack its padding");
    assert_eq!(field(image("16UC1", 3, 2, 5, &data)), Err("step"));
    assert_eq!(field(image("16UC1", 3, 3, 6, &data)), Err("data"));
    assert_eq!(field(image("16UC1", 0, 2, 6, &data)), Err("width"));
    assert_eq!(field(image("16UC1", u32::MAX, u32::MAX, u32::MAX, &data)), Err("width"));
    assert_eq!(image("64FC1", 1, 1, 8, &data).depth_m().unwrap_err().field, "encoding");
}

#[test]
fn nothing_seen_is_told_from_something() {
    let none = [0.0, -1.0, f32::NAN, f32::INFINITY].map(f32::to_le_bytes).concat();
    assert_eq!(image("32FC1", 4, 1, 16, &none).has_depth(), Ok(false));
    assert_eq!(image("16UC1", 4, 1, 8, &[0, 0, 255, 255, 0, 0, 0, 0]).has_depth(), Ok(false));
    assert_eq!(image("16UC1", 4, 1, 8, &[0, 0, 255, 255, 0, 0, 0, 1]).has_depth(), Ok(true));
}

#[test]
fn colours_of_every_order_are_the_same() {
    let red = Ok(Some(vec![[200, 100, 50]]));
    for (encoding, data) in [
        ("rgb8", &[200, 100, 50][..]),
        ("bgr8", &[50, 100, 200]),
        ("rgba8", &[200, 100, 50, 255]),
        ("bgra8", &[50, 100, 200, 255]),
    ] {
        assert_eq!(image(encoding, 1, 1, data.len() as u32, data).rgb(), red, "{encoding}");
    }
    assert_eq!(image("mono8", 1, 1, 1, &[7]).rgb(), Ok(Some(vec![[7; 3]])));
    assert_eq!(image("yuv422", 1, 1, 2, &[7, 7]).rgb(), Ok(None));
}

#[test]
fn compressed_pictures_of_colour_are_no_depth() {
    let header = Header { stamp_ns: 0, frame_id: "" };
    let picture = |format: &'static str| CompressedImageMessage { header, format, data: &[0; 40] };
    assert!(!picture("bgr8; jpeg compressed bgr8").is_depth());
    for (format, field) in [("rgb8; compressedDepth rvl", "data"), ("jpeg", "format")] {
        assert_eq!(picture(format).depth().unwrap_err().field, field);
    }
}

//! Messages of another implementation, field by field.

use super::super::{
    CameraInfoMessage, CloudMessage, CompressedImageMessage, Header, ImageMessage,
    JointStateMessage, WireReader, text, transforms, types,
};
use crate::bag::Encoding;
use serde_json::Value;
use std::path::Path;

/// A message and what is in it.
pub(super) struct Fixture {
    pub(super) name: String,
    pub(super) message_type: String,
    pub(super) encoding: Encoding,
    pub(super) bytes: Vec<u8>,
    told: Value,
}

pub(super) fn fixtures() -> Vec<Fixture> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/messages.json");
    let listed: Vec<Value> = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let text = |item: &Value, key: &str| item[key].as_str().unwrap().to_owned();
    let fixture = |item: &Value| Fixture {
        name: text(item, "name"),
        message_type: text(item, "type"),
        encoding: if item["ros1"] == true { Encoding::Ros1 } else { Encoding::Cdr },
        bytes: bytes(&text(item, "hex")),
        told: item["told"].clone(),
    };
    listed.iter().map(fixture).collect()
}

fn bytes(hex: &str) -> Vec<u8> {
    let pairs = hex.as_bytes().chunks(2).map(|pair| str::from_utf8(pair).unwrap());
    pairs.map(|pair| u8::from_str_radix(pair, 16).unwrap()).collect()
}

impl Fixture {
    fn check(&self) {
        let mut reader = WireReader::new(&self.encoding, &self.bytes).unwrap();
        let reader = &mut reader;
        match self.message_type.as_str() {
            types::IMAGE => self.image(&ImageMessage::read(reader).unwrap()),
            types::COMPRESSED_IMAGE => {
                self.compressed(&CompressedImageMessage::read(reader).unwrap())
            }
            types::CLOUD => self.cloud(&CloudMessage::read(reader).unwrap()),
            types::CAMERA_INFO => self.camera(&CameraInfoMessage::read(reader).unwrap()),
            types::JOINT_STATE => {
                let joints = JointStateMessage::read(reader).unwrap();
                self.header(&joints.header);
                assert_eq!(self.told["names"], Value::from(joints.names.clone()), "{}", self.name);
                self.same("positions", &joints.positions, 0.0);
            }
            types::TRANSFORMS => {
                let listed = self.told["transforms"].as_array().unwrap();
                let read = transforms(reader).unwrap();
                assert_eq!(read.len(), listed.len(), "{}", self.name);
                for (told, read) in listed.iter().zip(read) {
                    assert_eq!(
                        (&told["parent"], &told["child"]),
                        (&read.parent.into(), &read.child.into())
                    );
                    assert_eq!(told["translation_m"], Value::from(read.translation_m.to_vec()));
                    assert_eq!(told["rotation_xyzw"], Value::from(read.rotation_xyzw.to_vec()));
                }
            }
            types::STRING => assert_eq!(self.told["text"], text(reader).unwrap(), "{}", self.name),
            other => panic!("{other} is not expected"),
        }
    }

    fn header(&self, header: &Header<'_>) {
        assert_eq!(self.told["frame_id"], header.frame_id, "{}", self.name);
        assert_eq!(self.told["stamp_ns"], header.stamp_ns, "{}", self.name);
    }

    fn size(&self, width: u32, height: u32) {
        assert_eq!((&self.told["width"], &self.told["height"]), (&width.into(), &height.into()));
    }

    /// Numbers, of which null was not a number.
    #[track_caller]
    fn same(&self, key: &str, read: &[f64], tolerance: f64) {
        let told: Vec<f64> = self.told[key]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|v| v.as_array().cloned().unwrap_or_else(|| vec![v.clone()]))
            .map(|value| value.as_f64().unwrap_or(f64::NAN))
            .collect();
        assert_eq!(told.len(), read.len(), "{}: {key}", self.name);
        for (told, read) in told.iter().zip(read) {
            let same = (told - read).abs() <= tolerance || (told.is_nan() && read.is_nan());
            assert!(same, "{}: {key}: {told} was read as {read}", self.name);
        }
    }

    fn image(&self, image: &ImageMessage<'_>) {
        self.header(&image.header);
        self.size(image.width, image.height);
        assert_eq!(self.told["encoding"], image.encoding);
        assert_eq!(
            (&self.told["step"], &self.told["big_endian"]),
            (&image.step.into(), &image.big_endian.into())
        );
        let (depth_m, millimetres) = image.depth_m().unwrap();
        self.depth(&depth_m, millimetres);
        assert_eq!((image.has_depth(), image.check()), (Ok(true), Ok(())));
    }

    fn depth(&self, depth_m: &[f32], millimetres: bool) {
        assert_eq!(self.told["millimetres"], millimetres, "{}", self.name);
        let depth_m: Vec<_> = depth_m.iter().map(|depth| f64::from(*depth)).collect();
        self.same("depth_m", &depth_m, 1e-6);
    }

    fn compressed(&self, image: &CompressedImageMessage<'_>) {
        self.header(&image.header);
        assert_eq!(self.told["format"], image.format);
        assert!(image.is_depth());
        let depth = image.depth().unwrap();
        self.size(depth.width, depth.height);
        self.depth(&depth.depth_m, depth.in_millimetres);
    }

    fn cloud(&self, cloud: &CloudMessage<'_>) {
        self.header(&cloud.header);
        self.size(cloud.width, cloud.height);
        let points: Vec<_> = cloud.points().unwrap().into_iter().flatten().map(f64::from).collect();
        self.same("points", &points, 0.0);
        assert_eq!(cloud.has_point(), Ok(true));
    }

    fn camera(&self, camera: &CameraInfoMessage<'_>) {
        self.header(&camera.header);
        self.size(camera.width, camera.height);
        assert_eq!(self.told["distortion_model"], camera.distortion_model);
        let lists: [(_, &[f64]); 4] =
            [("d", &camera.d), ("k", &camera.k), ("r", &camera.r), ("p", &camera.p)];
        lists.into_iter().for_each(|(key, read)| self.same(key, read, 0.0));
    }
}

#[test]
fn every_field_is_what_rosbags_wrote() {
    let fixtures = fixtures();
    assert!(fixtures.len() > 80);
    fixtures.iter().for_each(Fixture::check);
}

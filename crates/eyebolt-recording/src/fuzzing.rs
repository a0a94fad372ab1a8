//! The readers of bytes from outside one by one, for the targets in `fuzz/`.
//!
//! Whatever they are given, they return: errors are as good as results. Where there is a law, it is
//! asserted.

use crate::bag::{Bag, Encoding, Locator};
use crate::camera_info::{CameraInfo, PictureForm};
use crate::cloud::read_cloud;
use crate::color::read_color;
use crate::depth::read_depth;
use crate::depth_unit::DepthUnit;
use crate::joints::{Joints, read_joints};
use crate::manifest::{CloudFrame, Manifest};
use crate::mask::read_mask;
use crate::message::{
    CameraInfoMessage, CloudMessage, CompressedImageMessage, ImageMessage, JointStateMessage,
    WireProblem, WireReader, color, text, transforms,
};
use crate::npy::{Dtype, Npy};
use crate::png_image::PngImage;
use crate::truth::Truth;
use std::path::Path;

/// An NPY file as depth, as points and as positions of joints.
pub fn npy(path: &Path) {
    let accepted = [Dtype::Float32, Dtype::Float64, Dtype::Uint16];
    let Ok(npy) = Npy::read(path, "array", &accepted) else { return };
    let count: usize = npy.shape().iter().product();
    assert_eq!(npy.values::<f32>().len(), count);
    if let [height, width] = *npy.shape()
        && let (Ok(width), Ok(height)) = (width.try_into(), height.try_into())
    {
        let _ = read_depth(path, "npy", DepthUnit::METRES, (width, height, "itself"));
        let _ = read_depth(path, "npy", DepthUnit::MILLIMETRES, (width, height, "itself"));
    }
    cloud(path, "npy");
    let names: Vec<_> = (0..count.min(8)).map(|index| format!("joint_{index}")).collect();
    let _ = read_joints(path, "npy", Some(&names));
}

/// A cloud in a file whose name would end in `extension`: `npy`, `pcd` or `ply`.
pub fn cloud(path: &Path, extension: &str) {
    let _ = read_cloud(path, extension, DepthUnit::METRES, CloudFrame::Optical);
    let _ = read_cloud(path, extension, DepthUnit::MILLIMETRES, CloudFrame::Body);
}

/// A PNG file as depth, as a mask and as a picture.
pub fn png(path: &Path) {
    let Ok(image) = PngImage::read(path, "picture", None, false) else { return };
    let size = (image.width, image.height, "itself");
    let _ = read_depth(path, "png", DepthUnit::MILLIMETRES, size);
    let _ = read_mask(path, size);
    let _ = read_color(path, Some(size));
}

/// Text as the YAML of a camera.
pub fn camera_info(text: &str) {
    let _ = CameraInfo::parse(Path::new("camera_info.yaml"), text);
}

/// A file whose name ends in `extension`, `csv` or `json`, as the joints of one frame and as those
/// of several.
pub fn joints(path: &Path, extension: &str) {
    let name = path.file_name().unwrap_or_default().display();
    let text = format!(
        "camera.info = 'camera_info.yaml'\n\
         frames = {{ depth = 'depth_{{}}.npy', depth_unit = 'm', joints = '{name}' }}"
    );
    let manifest = Manifest::parse(&path.with_file_name("recording.toml"), &text);
    let mut manifest = manifest.expect("the description is a right one");
    let frames = ["0", "1", "start"].map(str::to_owned);
    let names = ["joint_1", "joint_2"].map(str::to_owned).to_vec();
    for joint_names in [None, Some(names)] {
        let _ = read_joints(path, extension, joint_names.as_deref());
        manifest.joint_names = joint_names;
        let _ = Joints::open(&manifest, &frames);
    }
}

/// Text as the truth of a simulation: what was read and written is read again.
pub fn truth(text: &str) {
    let path = Path::new("truth.json");
    let Ok(truth) = Truth::parse(path, text) else { return };
    let again = Truth::parse(path, &truth.to_json()).expect("it was written by the same version");
    assert_eq!((again.seed, &again.faults), (truth.seed, &truth.faults));
    let (distance_m, _) = again.camera_from_base.distance_to(&truth.camera_from_base);
    assert!(distance_m == 0.0);
}

/// Most messages of a bag that are read again.
const MOST_READ: usize = 64;

/// A file as a bag: every message that a scan tells of is found again where it says.
pub fn bag(path: &Path, scratch: &Path) {
    let Ok(bag) = Bag::open(path, scratch) else { return };
    let mut told: Vec<(Locator, Vec<u8>)> = Vec::new();
    let scanned = bag.scan(
        &mut |locator, message| {
            if told.len() < MOST_READ {
                told.push((locator, message.data.to_vec()));
            }
            Ok(())
        },
        // Damaged parts are passed over.
        &mut |_| Ok(()),
    );
    let _ = scanned;
    // The tables of a hostile database need not have one row for each number, and no reader of
    // ours reads them.
    let exact = bag.kind() != crate::BagKind::Sqlite;
    for (locator, data) in &told {
        let read = bag.read(*locator);
        if exact {
            assert_eq!(&read.expect("it was there in the scan"), data);
        }
    }
    if exact && let Ok(bytes) = std::fs::read(path) {
        in_memory(bytes, scratch, &told);
    }
}

/// The bytes of a file in memory are the same bag.
fn in_memory(bytes: Vec<u8>, scratch: &Path, told: &[(Locator, Vec<u8>)]) {
    let bag = Bag::from_reader(Path::new("memory"), std::io::Cursor::new(bytes), scratch);
    let bag = bag.expect("it opened as a file");
    for (locator, data) in told {
        assert_eq!(&bag.read(*locator).expect("it was there in the file"), data);
    }
}

/// Bytes as a message of every type, as ROS 1 and as ROS 2 write it.
pub fn messages(bytes: &[u8]) {
    for encoding in [Encoding::Ros1, Encoding::Cdr] {
        let reader = || WireReader::new(&encoding, bytes);
        let _ = reader().and_then(|mut reader| text(&mut reader).map(str::len));
        let _ = reader().and_then(|mut reader| transforms(&mut reader));
        same_again(bytes, &encoding, |reader| Ok(CameraInfoMessage::read(reader)?.write()));
        same_again(bytes, &encoding, |reader| Ok(JointStateMessage::read(reader)?.write()));
        same_again(bytes, &encoding, |reader| {
            let image = ImageMessage::read(reader)?;
            let _ = (image.check(), image.has_depth());
            let _ = (image.depth_m(), image.rgb(), image.mask());
            Ok(image.write())
        });
        same_again(bytes, &encoding, |reader| {
            let cloud = CloudMessage::read(reader)?;
            let _ = (cloud.has_point(), cloud.points());
            Ok(cloud.write())
        });
        same_again(bytes, &encoding, |reader| {
            let image = CompressedImageMessage::read(reader)?;
            let _ = (image.depth(), image.size());
            // Larger ones are refused by their size, before they are decoded.
            if image.size().is_some_and(|(width, height)| width.saturating_mul(height) < 1 << 20) {
                let _ = color(image.data);
            }
            Ok(image.write())
        });
        if let Ok(mut reader) = reader()
            && let Ok(info) = CameraInfoMessage::read(&mut reader)
        {
            for (rectified, size) in [(false, None), (true, Some((64, 48)))] {
                let picture = PictureForm { rectified, size };
                let _ = CameraInfo::from_message(Path::new("bag"), &info, picture);
            }
        }
    }
}

/// A message that was read and written is written the same when it is read again.
fn same_again(
    bytes: &[u8],
    encoding: &Encoding,
    rewrite: impl Fn(&mut WireReader<'_>) -> Result<Vec<u8>, WireProblem>,
) {
    let rewritten = WireReader::new(encoding, bytes).and_then(|mut reader| rewrite(&mut reader));
    let Ok(once) = rewritten else { return };
    let again = WireReader::new(&Encoding::Cdr, &once).and_then(|mut reader| rewrite(&mut reader));
    assert_eq!(again.as_ref(), Ok(&once));
}

//! What the writer makes of calls, told by another reader of MCAP.

use crate::sample::{
    Backgrounds, MS, Memory, START_NS, URDF, assert_says, camera, image, info, joints, millimetres,
    write,
};
use eyebolt_geometry::DepthImage;
use eyebolt_recording::{ColorImage, RecordingWriter, WriteError};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::io::{Cursor, Result, Seek, SeekFrom, Write};
use std::rc::Rc;

/// The file that `fill` makes.
fn written(fill: impl FnOnce(&mut Memory<'_>) -> std::result::Result<(), WriteError>) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let camera = camera((4, 3));
    let mut writer = RecordingWriter::new(&mut file, &info(&camera, false)).unwrap();
    fill(&mut writer).unwrap();
    writer.finish().unwrap();
    file.into_inner()
}

/// Topic, type, time and length of every message, read by the library `mcap`.
fn messages(file: &[u8]) -> Vec<(String, String, u64, usize)> {
    let stream = mcap::MessageStream::new(file).unwrap().map(|message| {
        let message = message.unwrap();
        let schema = message.channel.schema.as_ref().unwrap().name.clone();
        (message.channel.topic.clone(), schema, message.log_time, message.data.len())
    });
    stream.collect()
}

/// The metadata records of each name, in their order.
fn metadata(file: &[u8]) -> BTreeMap<String, Vec<BTreeMap<String, String>>> {
    let mut found: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for record in mcap::read::LinearReader::new(file).unwrap() {
        if let mcap::records::Record::Metadata(metadata) = record.unwrap() {
            found.entry(metadata.name).or_default().push(metadata.metadata);
        }
    }
    found
}

#[test]
fn messages_are_in_the_order_of_the_calls() {
    let file = written(|writer| {
        writer.joints(START_NS, &joints(1.0))?;
        writer.joints(START_NS + MS, &joints(1.0))?;
        writer.depth(START_NS + 2 * MS, &millimetres(0))?;
        writer.background(START_NS + 3 * MS, &millimetres(1))
    });
    let time = |since_ms: i64| u64::try_from(START_NS + since_ms * MS).unwrap();
    let told: Vec<_> =
        messages(&file).into_iter().map(|(topic, kind, t, _)| (topic, kind, t)).collect();
    let expected = [
        // For whoever plays it, at the first moment.
        ("/robot_description", "std_msgs/msg/String", time(0)),
        ("/joint_states", "sensor_msgs/msg/JointState", time(0)),
        ("/joint_states", "sensor_msgs/msg/JointState", time(1)),
        ("/camera/depth/camera_info", "sensor_msgs/msg/CameraInfo", time(2)),
        ("/camera/depth/image_raw", "sensor_msgs/msg/Image", time(2)),
        ("/camera/depth/background/image_raw", "sensor_msgs/msg/Image", time(3)),
    ];
    assert_eq!(told, expected.map(|(a, b, c)| (a.to_owned(), b.to_owned(), c)));
}

#[test]
fn metadata_name_the_background_where_there_is_one() {
    let key = "background_topic";
    let last = |backgrounds| {
        let records = metadata(&written(|writer| write(writer, backgrounds)));
        records["eyebolt"].last().unwrap().clone()
    };
    for backgrounds in [Backgrounds::Before, Backgrounds::After] {
        assert_eq!(last(backgrounds)[key], "/camera/depth/background/image_raw");
    }
    let none = last(Backgrounds::None);
    assert!(!none.contains_key(key));
    let expected =
        [("base", "base_link"), ("end_effector", "hand"), ("schema", "eyebolt.recording/1")];
    assert_eq!(none, expected.map(|(k, v)| (k.to_owned(), v.to_owned())).into());
    // Of an empty recording as well.
    assert_eq!(metadata(&written(|_| Ok(())))["eyebolt"], [none]);
}

#[test]
fn the_same_calls_write_the_same_bytes() {
    let once = || written(|writer| write(writer, Backgrounds::After));
    assert!(once() == once());
    let texts = messages(&once()).into_iter().find(|(topic, ..)| topic == "/robot_description");
    // Four bytes of encapsulation, the length, the text and its end.
    assert_eq!(texts.unwrap().3, 4 + 4 + URDF.len() + 1);
}

/// An output that tells how much it was given.
struct Counted(Rc<Cell<u64>>, u64);

impl Write for Counted {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.1 += bytes.len() as u64;
        self.0.set(self.0.get().max(self.1));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Seek for Counted {
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        self.1 = match to {
            SeekFrom::Start(at) => at,
            SeekFrom::End(by) => self.0.get().saturating_add_signed(by),
            SeekFrom::Current(by) => self.1.saturating_add_signed(by),
        };
        Ok(self.1)
    }
}

#[test]
fn what_is_not_in_the_file_yet_is_a_chunk_however_long_the_recording() {
    let (width, height) = (200, 100);
    let camera = camera((width, height));
    let count = Rc::new(Cell::new(0));
    let output = Counted(Rc::clone(&count), 0);
    let mut writer = RecordingWriter::new(output, &info(&camera, false)).unwrap();
    let (mut state, mut given) = (1_u32, 0);
    for frame in 1..=400 {
        // Noise, which no compression makes much smaller (Numerical Recipes' quick generator).
        let depth_m = (0..width * height).map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f32::from_bits(0x3f00_0000 | (state >> 8))
        });
        let image = DepthImage::new(width, height, depth_m.collect()).unwrap();
        writer.depth(frame * MS, &image).unwrap();
        given += 4 * u64::from(width * height);
        assert!(count.get() + (6 << 20) > given * 8 / 10, "{} of {given} bytes", count.get());
    }
    writer.finish().unwrap();
    assert!(given > 30 << 20);
}

#[test]
fn what_fits_no_recording_is_refused() {
    let refused = |fill: &dyn Fn(&mut Memory<'_>) -> std::result::Result<(), WriteError>| {
        let mut file = Cursor::new(Vec::new());
        let camera = camera((4, 3));
        let mut writer = RecordingWriter::new(&mut file, &info(&camera, false)).unwrap();
        fill(&mut writer)
    };
    let large = DepthImage::new(3, 4, vec![1.0; 12]).unwrap();
    let said = "the image is 3 x 4, but the camera 4 x 3";
    assert_says(
        refused(&|writer| writer.depth(START_NS, &large)),
        &["depth at 1700000000.000 s", said],
    );
    assert_says(refused(&|writer| writer.background(MS, &large)), &["background at 0.001 s", said]);
    let color = ColorImage { width: 4, height: 3, rgb: vec![[0; 3]; 11] };
    assert_says(refused(&|writer| writer.color(MS, &color)), &["color at 0.001 s", "4 x 3"]);
    for stamp_ns in [0, -MS, i64::MIN, i64::MAX, (1_i64 << 31) * 1_000_000_000] {
        let said = ["joints", "more than 0 and less than 2^31 seconds"];
        assert_says(refused(&|writer| writer.joints(stamp_ns, &joints(0.0))), &said);
        let said = ["camera info", "more than 0"];
        assert_says(refused(&|writer| writer.depth(stamp_ns, &image(&[1.0; 12]))), &said);
    }
}

//! Messages and MCAP files as ROS 2 writes them: the layout is told again here, because a test that
//! wrote them with the code under test could not tell when that is wrong.

use std::collections::BTreeMap;
use std::path::Path;

/// Fields of a message in the little-endian Common Data Representation.
pub struct Cdr(Vec<u8>);

impl Cdr {
    pub fn new() -> Self {
        Self(vec![0, 1, 0, 0])
    }

    /// As the fields of most messages begin.
    pub fn with_header(stamp_ns: i64, frame: &str) -> Self {
        let second = 1_000_000_000;
        Self::new()
            .i32(i32::try_from(stamp_ns.div_euclid(second)).unwrap())
            .u32(u32::try_from(stamp_ns.rem_euclid(second)).unwrap())
            .text(frame)
    }

    fn put<const N: usize>(mut self, bytes: [u8; N]) -> Self {
        while !(self.0.len() - 4).is_multiple_of(N) {
            self.0.push(0);
        }
        self.0.extend(bytes);
        self
    }

    pub fn u8(self, value: u8) -> Self {
        self.put([value])
    }

    pub fn u32(self, value: u32) -> Self {
        self.put(value.to_le_bytes())
    }

    pub fn i32(self, value: i32) -> Self {
        self.put(value.to_le_bytes())
    }

    pub fn f64s(self, values: &[f64]) -> Self {
        values.iter().fold(self, |cdr, value| cdr.put(value.to_le_bytes()))
    }

    pub fn count(self, count: usize) -> Self {
        self.u32(u32::try_from(count).unwrap())
    }

    pub fn bytes(self, bytes: &[u8]) -> Self {
        let mut cdr = self.count(bytes.len());
        cdr.0.extend(bytes);
        cdr
    }

    pub fn text(self, text: &str) -> Self {
        self.bytes(&[text.as_bytes(), &[0]].concat())
    }

    pub fn done(self) -> Vec<u8> {
        self.0
    }
}

pub fn image(stamp_ns: i64, frame: &str, encoding: &str, size: (u32, u32), data: &[u8]) -> Vec<u8> {
    let (width, height) = size;
    let step = u32::try_from(data.len()).unwrap() / height;
    let cdr = Cdr::with_header(stamp_ns, frame).u32(height).u32(width).text(encoding);
    cdr.u8(0).u32(step).bytes(data).done()
}

/// An image in `32FC1`.
pub fn depth(stamp_ns: i64, frame: &str, size: (u32, u32), depth: &[f32]) -> Vec<u8> {
    let data: Vec<u8> = depth.iter().flat_map(|z| z.to_le_bytes()).collect();
    image(stamp_ns, frame, "32FC1", size, &data)
}

pub fn compressed(stamp_ns: i64, frame: &str, format: &str, data: &[u8]) -> Vec<u8> {
    Cdr::with_header(stamp_ns, frame).text(format).bytes(data).done()
}

/// A cloud of three float32 a point.
pub fn cloud(stamp_ns: i64, frame: &str, size: (u32, u32), points: &[[f32; 3]]) -> Vec<u8> {
    let (width, height) = size;
    let mut cdr = Cdr::with_header(stamp_ns, frame).u32(height).u32(width).count(3);
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        cdr = cdr.text(name).u32(4 * i as u32).u8(7).u32(1);
    }
    let data: Vec<u8> = points.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    cdr.u8(0).u32(12).u32(12 * width).bytes(&data).u8(0).done()
}

pub fn camera_info(stamp_ns: i64, frame: &str, size: (u32, u32), focal: f64) -> Vec<u8> {
    let (width, height) = size;
    let (cx, cy) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
    let k = [focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0];
    // Of the rectified picture: another focal length, so that a test can tell which is taken.
    let p = [0.5 * focal, 0.0, cx, 0.0, 0.0, 0.5 * focal, cy, 0.0, 0.0, 0.0, 1.0, 0.0];
    let r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let cdr = Cdr::with_header(stamp_ns, frame).u32(height).u32(width).text("plumb_bob");
    let cdr = cdr.count(5).f64s(&[0.0; 5]).f64s(&k).f64s(&r).f64s(&p);
    (0..6).fold(cdr, |cdr, _| cdr.u32(0)).u8(0).done()
}

pub fn joint_state(stamp_ns: i64, joints: &[(&str, f64)]) -> Vec<u8> {
    let mut cdr = Cdr::with_header(stamp_ns, "").count(joints.len());
    for (name, _) in joints {
        cdr = cdr.text(name);
    }
    let positions: Vec<f64> = joints.iter().map(|(_, position)| *position).collect();
    cdr.count(joints.len()).f64s(&positions).count(0).count(0).done()
}

pub fn static_transform(parent: &str, child: &str) -> Vec<u8> {
    let cdr = Cdr::new().count(1);
    let cdr = cdr.i32(1).u32(2).text(parent).text(child);
    cdr.f64s(&[1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0]).done()
}

pub fn text(text: &str) -> Vec<u8> {
    Cdr::new().text(text).done()
}

/// A message of a bag.
#[derive(Clone, Debug)]
pub struct Message {
    pub topic: String,
    pub message_type: &'static str,
    pub log_time_ns: i64,
    pub data: Vec<u8>,
}

/// Writes the messages in their order, and what eyebolt would know of them.
pub fn write_mcap(path: &Path, messages: &[Message], metadata: &BTreeMap<String, String>) {
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let options = mcap::WriteOptions::new().compression(None).chunk_size(Some(4096));
    let mut writer = options.create(file).unwrap();
    let mut channels = BTreeMap::new();
    for (sequence, message) in (0..).zip(messages) {
        let channel_id = *channels.entry(message.topic.clone()).or_insert_with(|| {
            let name = message.message_type.replace('/', "/msg/");
            let schema = writer.add_schema(&name, "ros2msg", b"# nothing").unwrap();
            writer.add_channel(schema, &message.topic, "cdr", &BTreeMap::new()).unwrap()
        });
        let log_time = u64::try_from(message.log_time_ns).unwrap();
        let header =
            mcap::records::MessageHeader { channel_id, sequence, log_time, publish_time: log_time };
        writer.write_to_known_channel(&header, &message.data).unwrap();
    }
    if !metadata.is_empty() {
        let record =
            mcap::records::Metadata { name: "eyebolt".to_owned(), metadata: metadata.clone() };
        writer.write_metadata(&record).unwrap();
    }
    writer.finish().unwrap();
}

//! Small bags of ROS 2 in MCAP, byte by byte, so that everything in them can lie.

/// Frames a second.
const RATE: u64 = 30;
const WIDTH: u32 = 8;
const HEIGHT: u32 = 6;

/// Numbers of the topics that every bag here has; more follow.
const DEPTH: u16 = 1;
const INFO: u16 = 2;
const JOINTS: u16 = 3;

/// The file as far as it is written.
pub struct Mcap(pub Vec<u8>);

pub fn string(text: &str) -> Vec<u8> {
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

pub fn record(opcode: u8, body: &[u8]) -> Vec<u8> {
    [&[opcode][..], &(body.len() as u64).to_le_bytes(), body].concat()
}

/// Schema and channel of the topic of this number.
pub fn channel(id: u16, topic: &str, kind: &str) -> Vec<u8> {
    let id = id.to_le_bytes().to_vec();
    let kind = format!("sensor_msgs/msg/{kind}");
    let schema = [id.clone(), string(&kind), string("ros2msg"), vec![0; 4]].concat();
    let channel = [id.clone(), id, string(topic), string("cdr"), vec![0; 4]].concat();
    [record(3, &schema), record(4, &channel)].concat()
}

pub fn message(channel: u16, time_ns: u64, data: &[u8]) -> Vec<u8> {
    let mut body = channel.to_le_bytes().to_vec();
    body.extend(0_u32.to_le_bytes());
    body.extend(time_ns.to_le_bytes());
    body.extend(time_ns.to_le_bytes());
    body.extend(data);
    record(5, &body)
}

/// A chunk that claims to unpack to `size` bytes.
pub fn chunk(compression: &str, size: u64, data: &[u8]) -> Vec<u8> {
    let mut body = [0_u64.to_le_bytes(), 0_u64.to_le_bytes(), size.to_le_bytes()].concat();
    // No checksum.
    body.extend(0_u32.to_le_bytes());
    body.extend(string(compression));
    body.extend((data.len() as u64).to_le_bytes());
    body.extend(data);
    record(6, &body)
}

impl Mcap {
    /// A file that begins well.
    pub fn new() -> Self {
        let header = record(1, &[string("ros2"), string("")].concat());
        Self([&b"\x89MCAP0\r\n"[..], &header].concat())
    }

    pub fn with(mut self, records: &[u8]) -> Self {
        self.0.extend(records);
        self
    }

    /// The file, ended as it should be.
    pub fn finish(self) -> Vec<u8> {
        self.with(&record(15, &[0; 4])).with(&record(2, &[0; 20])).with(b"\x89MCAP0\r\n").0
    }
}

/// The topics of [`seconds`].
pub fn channels() -> Vec<u8> {
    [
        channel(DEPTH, "/camera/depth/image_raw", "Image"),
        channel(INFO, "/camera/depth/camera_info", "CameraInfo"),
        channel(JOINTS, "/joint_states", "JointState"),
    ]
    .concat()
}

/// So many seconds of an arm at rest.
pub fn seconds(count: u64) -> Vec<u8> {
    let mut records = Vec::new();
    for frame in 0..count * RATE {
        let time_ns = time_ns(frame);
        records.extend(message(JOINTS, time_ns, &joint_state(time_ns)));
        records.extend(message(INFO, time_ns, &camera_info(time_ns)));
        records.extend(message(DEPTH, time_ns, &depth(time_ns)));
    }
    records
}

pub fn time_ns(frame: u64) -> u64 {
    1_700_000_000_000_000_000 + frame * 1_000_000_000 / RATE
}

/// CDR, little-endian, beginning with a header without a frame.
fn stamped(time_ns: u64) -> Vec<u8> {
    let mut cdr = vec![0, 1, 0, 0];
    cdr.extend(((time_ns / 1_000_000_000) as u32).to_le_bytes());
    cdr.extend(((time_ns % 1_000_000_000) as u32).to_le_bytes());
    text(&mut cdr, "");
    cdr
}

/// Zeros up to where a number of so many bytes may stand; the first four bytes do not count.
fn align(cdr: &mut Vec<u8>, size: usize) {
    let length = 4 + (cdr.len() - 4).next_multiple_of(size);
    cdr.resize(length, 0);
}

fn number(cdr: &mut Vec<u8>, value: u32) {
    align(cdr, 4);
    cdr.extend(value.to_le_bytes());
}

fn text(cdr: &mut Vec<u8>, text: &str) {
    number(cdr, text.len() as u32 + 1);
    cdr.extend(text.as_bytes());
    cdr.push(0);
}

/// An image of 800 mm.
pub fn depth(time_ns: u64) -> Vec<u8> {
    let mut cdr = stamped(time_ns);
    number(&mut cdr, HEIGHT);
    number(&mut cdr, WIDTH);
    text(&mut cdr, "16UC1");
    // Little-endian.
    cdr.push(0);
    number(&mut cdr, 2 * WIDTH);
    number(&mut cdr, 2 * WIDTH * HEIGHT);
    cdr.extend(800_u16.to_le_bytes().repeat((WIDTH * HEIGHT) as usize));
    cdr
}

fn joint_state(time_ns: u64) -> Vec<u8> {
    let mut cdr = stamped(time_ns);
    number(&mut cdr, 1);
    text(&mut cdr, "turn");
    number(&mut cdr, 1);
    align(&mut cdr, 8);
    cdr.extend(0.5_f64.to_le_bytes());
    // Neither velocities nor efforts.
    cdr.extend([0; 8]);
    cdr
}

fn camera_info(time_ns: u64) -> Vec<u8> {
    let mut cdr = stamped(time_ns);
    number(&mut cdr, HEIGHT);
    number(&mut cdr, WIDTH);
    text(&mut cdr, "plumb_bob");
    number(&mut cdr, 0);
    align(&mut cdr, 8);
    let mut k_r_p = [0.0_f64; 30];
    (k_r_p[0], k_r_p[2], k_r_p[4], k_r_p[5], k_r_p[8]) = (6.0, 3.5, 6.0, 2.5, 1.0);
    cdr.extend(k_r_p.iter().flat_map(|number| number.to_le_bytes()));
    // Binning and the region of interest.
    cdr.extend([0; 25]);
    cdr
}

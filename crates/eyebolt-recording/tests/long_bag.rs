//! Memory does not grow with the length of a bag.
#![cfg(target_os = "linux")]

use eyebolt_recording::{BagOptions, Recording};
use std::fs::File;
use std::io::{BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

/// Bytes of the bag.
const LENGTH: u64 = 4 << 30;
const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;
const PIXELS_BYTES: u32 = 2 * WIDTH * HEIGHT;
const FRAME_NS: u64 = 33_000_000;

/// A bag of [`LENGTH`] with the pixels left out: the file system makes zeros of them, and no disk is
/// needed.
struct Sparse {
    writer: BufWriter<File>,
    at: u64,
}

impl Sparse {
    fn bytes(&mut self, bytes: &[u8]) {
        self.writer.write_all(bytes).unwrap();
        self.at += bytes.len() as u64;
    }

    fn record(&mut self, opcode: u8, body: &[u8], zeros: u64) {
        self.bytes(&[opcode]);
        self.bytes(&(body.len() as u64 + zeros).to_le_bytes());
        self.bytes(body);
        self.at += zeros;
        if zeros > 0 {
            self.writer.seek(SeekFrom::Start(self.at)).unwrap();
        }
    }

    fn message(&mut self, channel: u16, time: u64, data: &[u8], zeros: u64) {
        let mut body = channel.to_le_bytes().to_vec();
        body.extend(0_u32.to_le_bytes());
        body.extend(time.to_le_bytes());
        body.extend(time.to_le_bytes());
        body.extend(data);
        self.record(5, &body, zeros);
    }
}

fn text(text: &str) -> Vec<u8> {
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

/// A message that starts with a header without a frame.
fn stamped(time: u64) -> Vec<u8> {
    let mut cdr = vec![0, 1, 0, 0];
    cdr.extend(((time / 1_000_000_000) as u32).to_le_bytes());
    cdr.extend(((time % 1_000_000_000) as u32).to_le_bytes());
    cdr.extend(1_u32.to_le_bytes());
    cdr.extend([0; 4]);
    cdr
}

fn depth(time: u64) -> Vec<u8> {
    let mut cdr = stamped(time);
    cdr.extend(HEIGHT.to_le_bytes());
    cdr.extend(WIDTH.to_le_bytes());
    cdr.extend(6_u32.to_le_bytes());
    cdr.extend(b"16UC1\0");
    // Little-endian, and to the next multiple of four.
    cdr.extend([0, 0]);
    cdr.extend((2 * WIDTH).to_le_bytes());
    cdr.extend(PIXELS_BYTES.to_le_bytes());
    // A frame without any depth would be left out.
    cdr.extend([1, 1]);
    cdr
}

fn joints(time: u64, position: f64) -> Vec<u8> {
    let mut cdr = stamped(time);
    cdr.extend(1_u32.to_le_bytes());
    cdr.extend(2_u32.to_le_bytes());
    cdr.extend(b"j\0\0\0");
    cdr.extend(1_u32.to_le_bytes());
    let length = 4 + (cdr.len() - 4).next_multiple_of(8);
    cdr.resize(length, 0);
    cdr.extend(position.to_le_bytes());
    cdr.extend([0; 8]);
    cdr
}

fn camera_info(time: u64) -> Vec<u8> {
    let mut cdr = stamped(time);
    cdr.extend(HEIGHT.to_le_bytes());
    cdr.extend(WIDTH.to_le_bytes());
    cdr.extend(1_u32.to_le_bytes());
    // No lens model and no coefficients.
    cdr.extend([0; 8]);
    let length = 4 + (cdr.len() - 4).next_multiple_of(8);
    cdr.resize(length, 0);
    let mut numbers = [0.0_f64; 30];
    (numbers[0], numbers[2], numbers[4]) = (590.0, 319.5, 590.0);
    (numbers[5], numbers[8]) = (239.5, 1.0);
    cdr.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    cdr.extend([0; 25]);
    cdr
}

/// Writes the bag; the number of its frames. A second in each configuration, half a second between.
fn write(path: &Path) -> u64 {
    let mut bag = Sparse { writer: BufWriter::new(File::create(path).unwrap()), at: 0 };
    bag.bytes(b"\x89MCAP0\r\n");
    bag.record(1, &[text("ros2"), text("")].concat(), 0);
    let types = ["Image", "CameraInfo", "JointState"].map(|t| format!("sensor_msgs/msg/{t}"));
    let topics = ["/cam/depth", "/cam/camera_info", "/joint_states"];
    for (id, (topic, kind)) in (1_u16..).zip(topics.iter().zip(&types)) {
        let id = id.to_le_bytes().to_vec();
        let schema = [id.clone(), text(kind), text("ros2msg"), vec![0; 4]].concat();
        bag.record(3, &schema, 0);
        bag.record(4, &[id.clone(), id, text(topic), text("cdr"), vec![0; 4]].concat(), 0);
    }
    let mut frames = 0;
    while bag.at < LENGTH {
        let time = 1_000_000_000 + frames * FRAME_NS;
        let (configuration, within) = (frames / 45, frames % 45);
        let way = (configuration as f64 + within.saturating_sub(30) as f64 / 15.0).sin();
        for third in 0..3 {
            bag.message(
                3,
                time + third * FRAME_NS / 3,
                &joints(time + third * FRAME_NS / 3, way),
                0,
            );
        }
        bag.message(2, time, &camera_info(time), 0);
        bag.message(1, time, &depth(time), u64::from(PIXELS_BYTES) - 2);
        frames += 1;
    }
    bag.record(15, &[0; 4], 0);
    bag.writer.flush().unwrap();
    frames
}

fn peak_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches("kB").trim().parse::<u64>().unwrap() >> 10
}

#[test]
fn four_gigabytes_in_300_megabytes_of_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.mcap");
    let frames = write(&path);
    let recording = Recording::open(&path, &BagOptions::default()).unwrap();
    let bag = recording.bag().unwrap();
    let kept = recording.frame_names().len() as u64;
    assert_eq!(kept + bag.dropped_frames().len() as u64, frames);
    assert!(kept > frames / 2 && kept < frames, "{kept} of {frames} at rest");
    assert!(peak_mib() <= 300, "{} MiB", peak_mib());
}

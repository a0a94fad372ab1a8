//! How fast a long bag is scanned, against the `mcap` library just reading it, as one line of JSON.
//!
//! ```sh
//! cargo run --release -p eyebolt-recording --example scan_bench -- make BAG.mcap [GIB]
//! cargo run --release -p eyebolt-recording --example scan_bench -- BAG.mcap [RUNS]
//! ```
//!
//! `make` writes a bag of depth images (640 x 480, 30 a second) and joint states (100 a second) of
//! so many GiB before compression, a configuration every ten seconds. Both readers decompress every
//! chunk and check its checksum; medians of the runs, which take turns.
#![allow(clippy::print_stdout)]

use eyebolt_recording::{BagOptions, Recording};
use mcap::records::MessageHeader;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Read};
use std::path::Path;
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |at: usize| arguments.get(at).map(String::as_str);
    match argument(0) {
        Some("make") => {
            let path = argument(1).ok_or("give a BAG.mcap to make")?;
            make(Path::new(path), argument(2).map_or(Ok(4.0), str::parse)?)
        }
        Some(path) => bench(Path::new(path), argument(1).map_or(Ok(3), str::parse)?),
        None => Err("give a BAG.mcap".into()),
    }
}

fn bench(path: &Path, runs: usize) -> Result<(), Failure> {
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let mut frames = 0;
    for _ in 0..runs.max(1) {
        let start = Instant::now();
        let messages = read_with_library(path)?;
        theirs.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let recording = Recording::open(path, &BagOptions::default())?;
        ours.push(start.elapsed().as_secs_f64());
        frames = recording.frame_names().len();
        assert!(messages as usize >= frames);
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let (ours, theirs) = (median(ours), median(theirs));
    let gib = std::fs::metadata(path)?.len() as f64 / f64::from(1 << 30);
    println!(
        "{{\"file_gib\": {gib:.2}, \"frames\": {frames}, \"scan_s\": {ours:.2}, \
         \"mcap_library_s\": {theirs:.2}, \"speed_ratio\": {:.2}, \"peak_rss_mib\": {}}}",
        theirs / ours,
        peak_rss_mib().unwrap_or(0)
    );
    Ok(())
}

/// Reads every message and does nothing with it.
fn read_with_library(path: &Path) -> Result<u64, Failure> {
    let options = LinearReaderOptions::default().with_validate_chunk_crcs(true);
    let mut reader = LinearReader::new_with_options(options);
    let mut file = File::open(path)?;
    let mut messages = 0;
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(wanted) => {
                let read = file.read(reader.insert(wanted))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { data, opcode } => {
                let record = mcap::parse_record(opcode, data)?;
                messages += u64::from(matches!(record, mcap::records::Record::Message { .. }));
            }
        }
    }
    Ok(messages)
}

/// Most memory that this process ever held.
fn peak_rss_mib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()? >> 10)
}

const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;
const FRAME_BYTES: usize = 2 * (WIDTH * HEIGHT) as usize;
const TICK_NS: u64 = 10_000_000;

fn make(path: &Path, gib: f64) -> Result<(), Failure> {
    let options = mcap::WriteOptions::new().chunk_size(Some(4 << 20)).profile("ros2");
    let mut writer = options.create(BufWriter::new(File::create(path)?))?;
    let mut channel = |topic: &str, kind: &str| -> Result<u16, Failure> {
        let schema = writer.add_schema(kind, "ros2msg", b"")?;
        Ok(writer.add_channel(schema, topic, "cdr", &BTreeMap::new())?)
    };
    let depth = channel("/camera/depth/image_raw", "sensor_msgs/msg/Image")?;
    let info = channel("/camera/depth/camera_info", "sensor_msgs/msg/CameraInfo")?;
    let joints = channel("/joint_states", "sensor_msgs/msg/JointState")?;
    let frames = (gib * f64::from(1 << 30)) as usize / FRAME_BYTES;
    let start = 1_700_000_000_000_000_000;
    for tick in 0..(frames as u64 * 10).div_ceil(3) {
        let stamp = start + tick * TICK_NS;
        let mut write = |channel_id, data: Vec<u8>| {
            let header =
                MessageHeader { channel_id, sequence: 0, log_time: stamp, publish_time: stamp };
            writer.write_to_known_channel(&header, &data)
        };
        write(joints, joint_state(stamp, tick))?;
        if tick % 3 == 0 {
            write(info, camera_info(stamp))?;
            write(depth, depth_image(stamp, tick))?;
        }
    }
    writer.finish()?;
    Ok(())
}

/// A message in CDR: the encapsulation, then fields at multiples of their size.
struct Cdr(Vec<u8>);

impl Cdr {
    fn new(stamp: u64, frame_id: &str) -> Self {
        let mut cdr = Self(vec![0, 1, 0, 0]);
        cdr.u32((stamp / 1_000_000_000) as u32);
        cdr.u32((stamp % 1_000_000_000) as u32);
        cdr.text(frame_id);
        cdr
    }

    fn align(&mut self, size: usize) {
        let length = 4 + (self.0.len() - 4).next_multiple_of(size);
        self.0.resize(length, 0);
    }

    fn u32(&mut self, value: u32) {
        self.align(4);
        self.0.extend(value.to_le_bytes());
    }

    fn f64(&mut self, value: f64) {
        self.align(8);
        self.0.extend(value.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.u32(text.len() as u32 + 1);
        self.0.extend(text.bytes().chain([0]));
    }
}

/// A configuration for nine seconds, then a second on the way to the next.
fn joint_state(stamp: u64, tick: u64) -> Vec<u8> {
    let (configuration, within) = (tick / 1000, tick % 1000);
    let way = configuration as f64 + (within.saturating_sub(900) as f64) / 100.0;
    let mut cdr = Cdr::new(stamp, "");
    cdr.u32(7);
    (1..=7).for_each(|joint| cdr.text(&format!("joint_{joint}")));
    cdr.u32(7);
    (1..=7).for_each(|joint| cdr.f64((way * f64::from(joint)).sin()));
    cdr.u32(0);
    cdr.u32(0);
    cdr.0
}

fn camera_info(stamp: u64) -> Vec<u8> {
    let mut cdr = Cdr::new(stamp, "depth_optical");
    cdr.u32(HEIGHT);
    cdr.u32(WIDTH);
    cdr.text("plumb_bob");
    cdr.u32(0);
    let k = [590.0, 0.0, 319.5, 0.0, 590.0, 239.5, 0.0, 0.0, 1.0];
    let p = [590.0, 0.0, 319.5, 0.0, 0.0, 590.0, 239.5, 0.0, 0.0, 0.0, 1.0, 0.0];
    k.into_iter().chain([1.0; 9]).chain(p).for_each(|number| cdr.f64(number));
    (0..6).for_each(|_| cdr.u32(0));
    cdr.0.push(0);
    cdr.0
}

/// A slope with noise of some millimetres, which compresses about as real depth does.
fn depth_image(stamp: u64, tick: u64) -> Vec<u8> {
    let mut cdr = Cdr::new(stamp, "depth_optical");
    cdr.u32(HEIGHT);
    cdr.u32(WIDTH);
    cdr.text("16UC1");
    cdr.0.push(0);
    cdr.u32(2 * WIDTH);
    cdr.u32(FRAME_BYTES as u32);
    let mut state = tick as u32 | 1;
    for pixel in 0..WIDTH * HEIGHT {
        // Xorshift of G. Marsaglia, 2003.
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        let depth = 800 + pixel / WIDTH + state % 5;
        cdr.0.extend((depth as u16).to_le_bytes());
    }
    cdr.0
}

//! `visualization_msgs/MarkerArray`, as ROS 2 has it from Humble on.

use super::header::Header;
use super::writer::WireWriter;

/// What a marker shows.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkerShape {
    /// An arrow from one point to another, metres, in the marker's frame.
    Arrow {
        /// Where it starts and ends.
        ends_m: [[f64; 3]; 2],
        /// How thick its shaft is, metres.
        thickness_m: f64,
    },
    /// Words that face whoever looks on.
    Text {
        /// What they say.
        text: String,
        /// Where their middle is, metres.
        at_m: [f64; 3],
        /// How high a capital letter is, metres.
        height_m: f64,
    },
    /// Lines between pairs of points.
    Segments {
        /// Where each starts and ends, metres.
        ends_m: Vec<[[f32; 3]; 2]>,
        /// How thick they are, metres.
        thickness_m: f64,
    },
    /// A surface.
    Triangles {
        /// The corners of each triangle, counter-clockwise as seen from outside, metres.
        corners_m: Vec<[[f32; 3]; 3]>,
    },
}

/// Where and when markers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MarkerFrame<'a> {
    /// The frame that their coordinates are in.
    pub(crate) frame_id: &'a str,
    /// When they are there; 0: whatever transform is the latest.
    pub(crate) stamp_ns: i64,
    /// Whether they move with the frame afterwards.
    pub(crate) follows: bool,
}

/// Something drawn in RViz, until another of the same number takes its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Which it is among the markers of its sender.
    pub id: i32,
    /// What it shows.
    pub shape: MarkerShape,
    /// Red, green, blue, opacity: 0 to 1.
    pub rgba: [f32; 4],
}

const ARROW: i32 = 0;
const SEGMENTS: i32 = 5;
const TEXT: i32 = 9;
const TRIANGLES: i32 = 11;

/// A message of `markers` in CDR, in the frame `frame_id`, of the sender `namespace`. They hold at any time.
pub fn markers_message(frame_id: &str, namespace: &str, markers: &[Marker]) -> Vec<u8> {
    let frame = MarkerFrame { frame_id, stamp_ns: 0, follows: false };
    placed_markers_message(namespace, markers.iter().map(|marker| (frame, marker)))
}

/// As [`markers_message`], each marker in a frame of its own.
pub(crate) fn placed_markers_message<'a>(
    namespace: &str,
    markers: impl ExactSizeIterator<Item = (MarkerFrame<'a>, &'a Marker)>,
) -> Vec<u8> {
    let mut writer = WireWriter::new();
    writer.count(markers.len());
    for (frame, marker) in markers {
        Header { stamp_ns: frame.stamp_ns, frame_id: frame.frame_id }.write(&mut writer);
        writer.string(namespace);
        writer.i32(marker.id);
        write_shape(&mut writer, marker, frame.follows);
    }
    writer.finish()
}

/// Kind, position and scale of a shape, and what it says.
fn described(shape: &MarkerShape) -> (i32, [f64; 3], [f64; 3], &str) {
    match shape {
        MarkerShape::Arrow { thickness_m, .. } => {
            (ARROW, [0.0; 3], [*thickness_m, 2.0 * thickness_m, 0.0], "")
        }
        MarkerShape::Text { text, at_m, height_m } => (TEXT, *at_m, [0.0, 0.0, *height_m], text),
        MarkerShape::Segments { thickness_m, .. } => {
            (SEGMENTS, [0.0; 3], [*thickness_m, 0.0, 0.0], "")
        }
        MarkerShape::Triangles { .. } => (TRIANGLES, [0.0; 3], [1.0; 3], ""),
    }
}

fn write_points(writer: &mut WireWriter, shape: &MarkerShape) {
    let all = |writer: &mut WireWriter, points: &[[f32; 3]]| {
        writer.count(points.len());
        points.iter().flatten().for_each(|value| writer.f64(f64::from(*value)));
    };
    match shape {
        MarkerShape::Arrow { ends_m, .. } => {
            writer.count(ends_m.len());
            ends_m.iter().for_each(|point| writer.f64_array(point));
        }
        MarkerShape::Text { .. } => writer.count(0),
        MarkerShape::Segments { ends_m, .. } => all(writer, ends_m.as_flattened()),
        MarkerShape::Triangles { corners_m } => all(writer, corners_m.as_flattened()),
    }
}

fn write_shape(writer: &mut WireWriter, marker: &Marker, follows: bool) {
    let (kind, at_m, scale, text) = described(&marker.shape);
    writer.i32(kind);
    const ADD: i32 = 0;
    writer.i32(ADD);
    writer.f64_array(&at_m);
    writer.f64_array(&[0.0, 0.0, 0.0, 1.0]);
    writer.f64_array(&scale);
    marker.rgba.iter().for_each(|part| writer.f32(*part));
    // It lives for ever.
    writer.i32(0);
    writer.u32(0);
    writer.bool(follows);
    write_points(writer, &marker.shape);
    // No colours of points, and no texture: a name, a picture with a header and its points.
    writer.count(0);
    writer.string("");
    Header { stamp_ns: 0, frame_id: "" }.write(writer);
    writer.string("");
    writer.count(0);
    writer.count(0);
    writer.string(text);
    // No mesh: where it is, and what it is.
    writer.string("");
    writer.string("");
    writer.count(0);
    writer.bool(false);
}

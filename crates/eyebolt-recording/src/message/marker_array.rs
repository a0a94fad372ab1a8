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
const TEXT: i32 = 9;

/// A message of `markers` in CDR, in the frame `frame_id`, of the sender `namespace`. They hold at any time.
pub fn markers_message(frame_id: &str, namespace: &str, markers: &[Marker]) -> Vec<u8> {
    let mut writer = WireWriter::new();
    writer.count(markers.len());
    for marker in markers {
        // Time zero: whatever transform is the latest.
        Header { stamp_ns: 0, frame_id }.write(&mut writer);
        writer.string(namespace);
        writer.i32(marker.id);
        write_shape(&mut writer, marker);
    }
    writer.finish()
}

fn write_shape(writer: &mut WireWriter, marker: &Marker) {
    let (kind, at_m, scale, points, text): (_, _, _, &[[f64; 3]], _) = match &marker.shape {
        MarkerShape::Arrow { ends_m, thickness_m } => {
            let scale = [*thickness_m, 2.0 * thickness_m, 0.0];
            (ARROW, [0.0; 3], scale, ends_m, "")
        }
        MarkerShape::Text { text, at_m, height_m } => {
            (TEXT, *at_m, [0.0, 0.0, *height_m], &[], text.as_str())
        }
    };
    writer.i32(kind);
    const ADD: i32 = 0;
    writer.i32(ADD);
    writer.f64_array(&at_m);
    writer.f64_array(&[0.0, 0.0, 0.0, 1.0]);
    writer.f64_array(&scale);
    marker.rgba.iter().for_each(|part| writer.f32(*part));
    // It lives for ever, and does not follow its frame.
    writer.i32(0);
    writer.u32(0);
    writer.bool(false);
    writer.count(points.len());
    points.iter().for_each(|point| writer.f64_array(point));
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

//! Files for viewers: what a viewer makes of them is what was seen, and what was found.

use crate::sample::{GOOD, without_pose};
use crate::wire::Wire;
use eyebolt::calibrate::Reason;
use eyebolt::report::{Viewer, overlays};
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::LazyLock;

const STAMPS_NS: [i64; 5] = [
    1_700_000_000_000_000_000,
    1_700_000_003_500_000_000,
    1_700_000_004_000_000_000,
    1_700_000_010_000_000_000,
    1_700_000_011_000_000_001,
];

/// Topic, type, time and bytes.
struct Message {
    topic: String,
    kind: String,
    time_ns: i64,
    data: Vec<u8>,
}

fn written(stamps_ns: Option<&[i64]>) -> Vec<u8> {
    let pictures: Vec<_> = overlays(&GOOD.outcome, |_| None).collect();
    let viewer = Viewer::new(&GOOD.answer, &GOOD.outcome).unwrap();
    let mut file = Cursor::new(Vec::new());
    viewer.write(&mut file, stamps_ns, &pictures).unwrap();
    file.into_inner()
}

fn messages(file: &[u8]) -> Vec<Message> {
    let stream = mcap::MessageStream::new(file).unwrap();
    let read = stream.map(|message| {
        let message = message.unwrap();
        Message {
            topic: message.channel.topic.clone(),
            kind: message.channel.schema.as_ref().unwrap().name.clone(),
            time_ns: message.log_time.try_into().unwrap(),
            data: message.data.to_vec(),
        }
    });
    read.collect()
}

static MESSAGES: LazyLock<Vec<Message>> = LazyLock::new(|| messages(&written(Some(&STAMPS_NS))));

fn on(topic: &str) -> impl Iterator<Item = &'static Message> {
    MESSAGES.iter().filter(move |message| message.topic == topic)
}

/// Stamp, parent, child and `parent_from_child` of each transform of a message.
fn transforms(message: &Message) -> Vec<(i64, String, String, Isometry3<f64>)> {
    let mut wire = Wire::new(&message.data);
    let count = wire.u32();
    let mut read = || {
        let ((stamp_ns, parent), child) = (wire.header(), wire.string());
        let ([x, y, z], [i, j, k, w]) = (wire.f64s(), wire.f64s());
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
        (stamp_ns, parent, child, Isometry3::from_parts(Translation3::new(x, y, z), turn))
    };
    let read = (0..count).map(|_| read()).collect();
    wire.end();
    read
}

/// Where every frame is in the base at `time_ns`: what was told last before.
fn placed(time_ns: i64) -> BTreeMap<String, Isometry3<f64>> {
    let told = MESSAGES.iter().filter(|message| message.kind == "tf2_msgs/msg/TFMessage");
    let told = told.flat_map(transforms).filter(|(stamp_ns, ..)| *stamp_ns <= time_ns);
    let mut placed: BTreeMap<_, _> = told.map(|(_, _, child, pose)| (child, pose)).collect();
    placed.insert(GOOD.answer.frames.base.clone(), Isometry3::identity());
    placed
}

/// Stamp, frame, kind, whether it follows its frame, and points.
type Marker = (i64, String, u32, bool, Vec<Point3<f64>>);

/// Each marker of a message.
fn markers(message: &Message) -> Vec<Marker> {
    let mut wire = Wire::new(&message.data);
    let count = wire.u32();
    let mut read = || {
        let (stamp_ns, frame) = wire.header();
        wire.string();
        let (_, kind, action) = (wire.u32(), wire.u32(), wire.u32());
        assert_eq!(action, 0);
        let _pose_and_scale: [f64; 10] = wire.f64s();
        wire.skip(4 + 2);
        let follows = wire.u8() == 1;
        let points = (0..wire.u32()).map(|_| Point3::from(wire.f64s::<3>())).collect();
        assert_eq!((wire.u32(), wire.string().as_str(), wire.header().0), (0, "", 0));
        assert_eq!((wire.string().as_str(), wire.u32(), wire.u32()), ("", 0, 0));
        let text = wire.string();
        assert_eq!(text.is_empty(), kind != 9, "{text:?}");
        assert_eq!((wire.string(), wire.string(), wire.u32(), wire.u8()), Default::default());
        (stamp_ns, frame, kind, follows, points)
    };
    let read = (0..count).map(|_| read()).collect();
    wire.end();
    read
}

/// Point, red, green, blue and residual of every point of a message.
fn points(message: &Message) -> Vec<(Point3<f32>, [u8; 3], f32)> {
    let mut wire = Wire::new(&message.data);
    let (stamp_ns, frame) = wire.header();
    assert_eq!((stamp_ns, Some(frame)), (message.time_ns, GOOD.answer.frames.camera.clone()));
    let (height, width) = (wire.u32(), wire.u32());
    let fields: Vec<(String, u32)> = (0..wire.u32())
        .map(|_| {
            let (name, offset) = (wire.string(), wire.u32());
            assert_eq!((wire.u8(), wire.u32()), (7, 1), "one float32");
            (name, offset)
        })
        .collect();
    let names = ["x", "y", "z", "rgb", "residual_mm"].map(str::to_owned);
    assert_eq!(fields, names.into_iter().zip([0, 4, 8, 12, 16]).collect::<Vec<_>>());
    assert_eq!((wire.u8(), wire.u32(), wire.u32(), height), (0, 20, 20 * width, 1));
    let data = wire.blob();
    assert_eq!(data.len(), 20 * width as usize);
    let read = data.chunks(20).map(|bytes| {
        let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        (Point3::new(float(0), float(4), float(8)), [bytes[14], bytes[13], bytes[12]], float(16))
    });
    read.collect()
}

#[test]
fn times_are_those_of_the_configurations_and_rise() {
    let times: Vec<i64> = on("/eyebolt/points").map(|message| message.time_ns).collect();
    assert_eq!(times, STAMPS_NS);
    assert!(MESSAGES.windows(2).all(|pair| pair[0].time_ns <= pair[1].time_ns));
    // Each posture holds until the next: viewers interpolate.
    for pair in STAMPS_NS.windows(2) {
        let (before, then) = (placed(pair[0]), placed(pair[1] - 1_000_000));
        assert!(before == then && before != placed(pair[1]));
        let told = on("/tf").any(|message| message.time_ns == pair[1] - 1_000_000);
        assert!(told);
    }
    // Times that no file can hold, or that do not rise, are none.
    for bad in [&[5, 4, 6, 7, 8][..], &[0, 1, 2, 3, 4], &[1, 2, 3, 4], &[1, 2, 3, 4, i64::MAX]] {
        assert!(written(Some(bad)) == written(None));
    }
}

#[test]
fn every_frame_has_one_parent_and_is_known_to_whom_it_is_named() {
    let base = &GOOD.answer.frames.base;
    let mut parents = BTreeMap::new();
    for (_, parent, child, _) in
        MESSAGES.iter().filter(|m| m.kind == "tf2_msgs/msg/TFMessage").flat_map(transforms)
    {
        assert_eq!(parents.entry(child).or_insert(parent.clone()), &parent);
        assert_eq!(&parent, base);
    }
    assert!(!parents.contains_key(base));
    let links = GOOD.outcome.observations.as_ref().unwrap().arm.links();
    let all = links.iter().filter(|link| link.name != *base).count();
    assert_eq!(parents.len(), all + 1, "the links and the camera");
    let shown = MESSAGES.iter().filter(|m| m.kind == "visualization_msgs/msg/MarkerArray");
    for (_, frame, ..) in shown.flat_map(markers) {
        assert!(frame == *base || parents.contains_key(&frame), "{frame}");
    }
}

#[test]
fn residuals_are_distances_from_the_posed_arm_and_colours_tell_them() {
    let observations = GOOD.outcome.observations.as_ref().unwrap();
    let camera = GOOD.answer.frames.camera.as_ref().unwrap();
    for (message, posture) in on("/eyebolt/points").zip(GOOD.outcome.postures()) {
        let base_from_camera = placed(message.time_ns)[camera].cast::<f32>();
        let (mut coloured, mut grey) = (0, 0);
        for (point, [red, green, blue], residual_mm) in points(message) {
            let in_base = base_from_camera * point;
            let nearest = posture.nearest(&observations.arm, &in_base).unwrap();
            let expected_mm = -1e3 * nearest.distance_m;
            let told = if expected_mm.abs() < 59.9 { expected_mm } else { f32::NAN };
            let far = residual_mm.is_nan() || residual_mm.abs() >= 59.9;
            let alike = (residual_mm - told).abs() < 0.05 || (told.is_nan() && far);
            assert!(alike, "{residual_mm} {expected_mm}");
            if [red, green, blue] == [112, 116, 124] {
                grey += 1;
                continue;
            }
            coloured += 1;
            // White at zero; the farther, the redder, and the nearer, the bluer.
            let strength = (residual_mm / 25.0).clamp(-1.0, 1.0);
            assert!(
                (f32::from(green)
                    - (255.0 - 225.0 * strength.max(0.0) + 195.0 * strength.min(0.0)))
                .abs()
                    < 2.0
            );
            assert_eq!(
                red.cmp(&blue) as i8,
                if strength.abs() < 0.005 { red.cmp(&blue) as i8 } else { strength.signum() as i8 }
            );
        }
        assert!(coloured > 1000 && grey > 1000, "{coloured} {grey}");
    }
}

#[test]
fn the_robot_and_its_outline_lie_on_the_posed_arm() {
    let observations = GOOD.outcome.observations.as_ref().unwrap();
    let robot: Vec<_> = on("/eyebolt/robot").flat_map(markers).collect();
    assert_eq!(robot.len(), observations.arm.links().len());
    for (index, posture) in GOOD.outcome.postures().iter().enumerate() {
        let placed = placed(STAMPS_NS[index]);
        let off_m = |frame: &str, point: &Point3<f64>| {
            let in_base = (placed[frame] * point).cast::<f32>();
            posture.nearest(&observations.arm, &in_base).unwrap().distance_m
        };
        for (_, frame, kind, follows, corners) in &robot {
            assert!(*kind == 11 && *follows && !corners.is_empty() && corners.len() % 3 == 0);
            // Corners of parts that lie within others are inside.
            assert!(corners.iter().all(|corner| off_m(frame, corner) < 0.003));
        }
        let (_, frame, kind, follows, ends) =
            on("/eyebolt/outline").nth(index).map(|message| markers(message).remove(0)).unwrap();
        assert!(kind == 5 && !follows && ends.len() > 400, "{}", ends.len());
        let far = ends.iter().filter(|end| off_m(&frame, end).abs() > 0.006).count();
        assert!(100 * far < ends.len(), "{far} of {}", ends.len());
    }
}

#[test]
fn pictures_are_those_of_the_report() {
    let drawn: Vec<_> = overlays(&GOOD.outcome, |_| None).collect();
    let shown: Vec<_> = on("/eyebolt/overlay/compressed").collect();
    assert_eq!(shown.len(), drawn.len());
    for (message, picture) in shown.iter().zip(&drawn) {
        let mut wire = Wire::new(&message.data);
        wire.header();
        assert_eq!(wire.string(), "png");
        let mut decoder = png::Decoder::new(Cursor::new(wire.blob())).read_info().unwrap();
        let mut pixels = vec![0; decoder.output_buffer_size().unwrap()];
        decoder.next_frame(&mut pixels).unwrap();
        assert!(pixels == picture.rgb().as_flattened());
    }
}

#[test]
fn the_layout_names_what_is_in_the_file() {
    let viewer = Viewer::new(&GOOD.answer, &GOOD.outcome).unwrap();
    let layout: Value = serde_json::from_str(&viewer.layout()).unwrap();
    let panels = layout["configById"].as_object().unwrap();
    let scene = &panels["3D!eyebolt"];
    for topic in scene["topics"].as_object().unwrap().keys() {
        assert!(on(topic).next().is_some(), "{topic}");
    }
    let picture = panels["Image!eyebolt"]["imageMode"]["imageTopic"].as_str().unwrap();
    let kind = &on(picture).next().unwrap().kind;
    assert_eq!(kind, "sensor_msgs/msg/CompressedImage");
    let placed = placed(STAMPS_NS[4]);
    for frame in scene["transforms"].as_object().unwrap().keys() {
        assert!(placed.contains_key(frame.strip_prefix("frame:").unwrap()), "{frame}");
    }
    assert!(placed.contains_key(scene["followTf"].as_str().unwrap()));
    for place in ["first", "second"] {
        assert!(panels.contains_key(layout["layout"][place].as_str().unwrap()));
    }
}

#[test]
fn without_a_pose_there_is_nothing_to_see() {
    let (answer, outcome) = without_pose(&GOOD, vec![Reason::NothingFound]);
    assert!(Viewer::new(&answer, &outcome).is_none());
}

#[test]
fn threads_change_nothing() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| written(Some(&STAMPS_NS)))
    };
    assert!(on(1) == on(3));
}

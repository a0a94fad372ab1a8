//! Laws of sessions that need no camera.

use eyebolt::robots::BuiltIn;
use eyebolt_live::{Event, Goal, Incoming, Session};
use eyebolt_recording::{JointNotes, text_message};
use proptest::prelude::*;

const MS: i64 = 1_000_000;

fn header(at_ns: i64) -> Vec<u8> {
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend(((at_ns / 1_000_000_000) as i32).to_le_bytes());
    bytes.extend(((at_ns % 1_000_000_000) as u32).to_le_bytes());
    bytes.extend([2, 0, 0, 0, b'c', 0]);
    bytes
}

fn put(bytes: &mut Vec<u8>, size: usize, value: &[u8]) {
    bytes.resize(4 + (bytes.len() - 4).next_multiple_of(size), 0);
    bytes.extend(value);
}

fn joints(at_ns: i64, names: &[&str], position: f64) -> Incoming {
    let mut data = header(at_ns);
    put(&mut data, 4, &(names.len() as u32).to_le_bytes());
    for name in names {
        put(&mut data, 4, &(name.len() as u32 + 1).to_le_bytes());
        data.extend(name.bytes().chain([0]));
    }
    put(&mut data, 4, &(names.len() as u32).to_le_bytes());
    for _ in names {
        put(&mut data, 8, &position.to_le_bytes());
    }
    put(&mut data, 4, &[0; 8]);
    message("/joint_states", "sensor_msgs/msg/JointState", at_ns, data)
}

/// An image of `16UC1` that shows the same all the time.
fn image(at_ns: i64) -> Incoming {
    let mut data = header(at_ns);
    let (width, height) = (8_u32, 8_u32);
    put(&mut data, 4, &height.to_le_bytes());
    put(&mut data, 4, &width.to_le_bytes());
    put(&mut data, 4, &6_u32.to_le_bytes());
    data.extend(b"16UC1\0\0");
    put(&mut data, 4, &(2 * width).to_le_bytes());
    put(&mut data, 4, &(2 * width * height).to_le_bytes());
    data.extend((0..width * height).flat_map(|_| 1000_u16.to_le_bytes()));
    message("/depth", "sensor_msgs/msg/Image", at_ns, data)
}

fn message(topic: &str, kind: &str, received_ns: i64, data: Vec<u8>) -> Incoming {
    let (topic, message_type) = (topic.to_owned(), kind.to_owned());
    Incoming { topic, message_type, data, received_ns, lost_before: 0 }
}

/// What a session makes of an arm that rests at each of `places` for a second and a half, and moves for one between.
fn taken(places: &[f64]) -> Vec<Event> {
    let robot = BuiltIn::named("shackle").unwrap();
    let arm = robot.arm();
    let names: Vec<String> = arm.required_joints().into_iter().map(str::to_owned).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut session = Session::new(Goal::default(), JointNotes::default());
    let mut events = session.hear(&message(
        "/robot_description",
        "std_msgs/msg/String",
        0,
        text_message(robot.urdf),
    ));
    session.set_arm(arm);
    let (mut at_ns, mut before) = (0, places[0]);
    for place in places {
        for step in 0..250 {
            let part = (f64::from(step) / 100.0).min(1.0);
            events.extend(session.hear(&joints(at_ns, &names, before + part * (place - before))));
            if step % 3 == 0 {
                events.extend(session.hear(&image(at_ns)));
            }
            at_ns += 10 * MS;
        }
        before = *place;
    }
    assert!(!events.iter().any(|event| matches!(event, Event::Unreadable { .. })), "{events:?}");
    events
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Each place is taken once, in order; who comes back is told so.
    #[test]
    fn each_place_is_taken_once(order in proptest::collection::vec(0..4_usize, 1..7)) {
        // Apart from the one before, and none twice in a row.
        let mut order = order;
        order.dedup();
        let places: Vec<f64> = order.iter().map(|place| 0.1 + 0.15 * *place as f64).collect();
        let events = taken(&places);
        let mut seen: Vec<usize> = Vec::new();
        let mut expected = Vec::new();
        for place in &order {
            match seen.iter().position(|known| known == place) {
                Some(known) => expected.push(Event::Known { configuration: known }),
                None => {
                    expected.push(Event::Taken { configuration: seen.len() });
                    seen.push(*place);
                }
            }
        }
        let of_places = |event: &&Event| matches!(event, Event::Taken { .. } | Event::Known { .. });
        let found: Vec<Event> = events.iter().filter(of_places).cloned().collect();
        prop_assert_eq!(found, expected);
        // It is calibrated from the third on, and one at a time: nobody has answered the first.
        let asked = events.iter().filter(|event| **event == Event::Calibrate).count();
        prop_assert_eq!(asked, usize::from(seen.len() >= 3));
    }

    /// Bytes that are no messages are told once of each topic, and harm nothing.
    #[test]
    fn rubbish_is_told_once(rubbish in proptest::collection::vec((0..6_usize, proptest::collection::vec(any::<u8>(), 0..60)), 1..40)) {
        let kinds = [
            "sensor_msgs/msg/Image", "sensor_msgs/msg/JointState", "sensor_msgs/msg/CameraInfo", "std_msgs/msg/String",
            "tf2_msgs/msg/TFMessage", "sensor_msgs/msg/PointCloud2",
        ];
        let mut session = Session::new(Goal::default(), JointNotes::default());
        let mut told = Vec::new();
        for (step, (kind, data)) in rubbish.into_iter().enumerate() {
            let events = session.hear(&message(&format!("/{kind}"), kinds[kind], step as i64 * MS, data));
            for event in events {
                if let Event::Unreadable { topic, .. } = event {
                    prop_assert!(!told.contains(&topic));
                    told.push(topic);
                }
            }
        }
    }
}

#[test]
fn what_is_lost_is_told_and_summed_up() {
    let mut session = Session::new(Goal::default(), JointNotes::default());
    let mut first = image(0);
    first.lost_before = 2;
    let lost = |count, total| Event::Lost { topic: "/depth".to_owned(), count, total };
    assert!(session.hear(&first).contains(&lost(2, 2)));
    assert!(!session.hear(&image(MS)).iter().any(|event| matches!(event, Event::Lost { .. })));
    let mut later = image(2 * MS);
    later.lost_before = 5;
    assert!(session.hear(&later).contains(&lost(5, 7)));
    assert_eq!(session.status().lost["/depth"], 7);
}

#[test]
fn what_is_missing_is_told() {
    let mut session = Session::new(Goal::default(), JointNotes::default());
    assert_eq!(session.missing().len(), 4);
    assert!(matches!(session.capture()[..], [Event::NotPlaced { .. }]));
    session.hear(&image(0));
    session.hear(&joints(0, &["a"], 0.0));
    assert_eq!(session.missing(), ["camera info", "the robot description"]);
}

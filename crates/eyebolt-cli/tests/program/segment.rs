//! `eyebolt segment`: the same labels in every form, and clouds without a recording.

use crate::desk::{Desk, text};
use crate::program::{CACHE, Ended, eyebolt};
use crate::simulate::SIMULATED;
use std::fs;
use std::io::Read;
use std::path::Path;

const FRAMES: usize = 15;

fn segment(from: &Path, to: &Path, model: &str, more: &[&str]) -> Ended {
    let fixed = ["segment", text(from), "--model", model, "-o", text(to)];
    eyebolt(&[&fixed, more, &["--cache", text(&CACHE)]].concat())
}

fn done(ended: &Ended) {
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
}

/// What follows the head of an NPY.
fn body(npy: &[u8]) -> &[u8] {
    let head = usize::from(u16::from_le_bytes([npy[8], npy[9]]));
    &npy[10 + head..]
}

fn little(bytes: &[u8]) -> u32 {
    u32::from_le_bytes(bytes.try_into().unwrap())
}

#[test]
fn the_same_labels_in_every_form() {
    let desk = Desk::new();
    let (folder, npz, mcap) = (desk.file("labels"), desk.file("l.npz"), desk.file("l.mcap"));
    for to in [&folder, &npz, &mcap] {
        let ended = segment(&SIMULATED, to, "shackle", &["--networks-alone"]);
        done(&ended);
        assert!(ended.out.contains("15 frames written to"), "{}", ended.out);
    }
    let mut zip = zip::ZipArchive::new(fs::File::open(&npz).unwrap()).unwrap();
    let mut array = |name: &str| {
        let mut bytes = Vec::new();
        zip.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    };
    let (label, probability) = (array("label.npy"), array("probability.npy"));
    let names = array("name.npy");
    let characters: Vec<char> =
        body(&names).chunks(4).filter_map(|c| char::from_u32(little(c))).collect();
    let names = characters.chunks(characters.len() / FRAMES);
    let names = names.map(|name| name.iter().filter(|c| **c != '\0').collect::<String>());
    let bytes = fs::read(&mcap).unwrap();
    let messages: Vec<_> =
        mcap::MessageStream::new(&bytes).unwrap().map(|message| message.unwrap()).collect();
    assert_eq!(messages.len(), FRAMES);
    let pixels = body(&label).len() / FRAMES;
    for (frame, (message, name)) in messages.iter().zip(names).enumerate() {
        let alone = fs::read(folder.join(format!("label_{name}.npy"))).unwrap();
        let of_frame = frame * pixels..(frame + 1) * pixels;
        assert!(body(&alone) == &body(&label)[of_frame.clone()], "frame {name}");
        // Each class but that of no depth has a probability, and so many points are of it.
        let sure = body(&probability).chunks(4).skip(of_frame.start).take(pixels);
        let sure: Vec<f32> = sure.map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        for (label, sure) in body(&alone).iter().zip(&sure) {
            assert_eq!(*label == 255, *sure == 0.0, "{label} {sure}");
            assert!((0.0..=1.0).contains(sure));
        }
        assert_eq!(message.channel.topic, "/eyebolt/labelled");
        for class in [0, 1, 2] {
            let counted = body(&alone).iter().filter(|label| **label == class).count();
            assert_eq!(labels_of(&message.data, u32::from(class)), counted, "{name}, {class}");
        }
    }
    segment(&SIMULATED, &npz, "shackle", &[]).assert_error(1, &["l.npz", "exists", "--force"]);
}

/// How many points of a cloud in CDR with six numbers each have this label.
fn labels_of(message: &[u8], label: u32) -> usize {
    // Behind the encapsulation, the array of points ends the message but for `is_dense`.
    const POINT: usize = 24;
    let count_at = (4..message.len() - 5)
        .step_by(4)
        .find(|at| at + 4 + little(&message[*at..at + 4]) as usize + 1 == message.len());
    let points = &message[count_at.unwrap() + 4..message.len() - 1];
    points.chunks(POINT).filter(|point| little(&point[16..20]) == label).count()
}

/// A cloud that was written is read again, without camera, joints or recording.
#[test]
fn a_cloud_alone_is_enough() {
    let desk = Desk::new();
    let folder = desk.file("labels");
    done(&segment(&SIMULATED, &folder, "shackle", &["--networks-alone", "--clouds", "pcd"]));
    let cloud = folder.join("cloud_0.pcd");
    let to = desk.file("again.ply");
    let ended = segment(&cloud, &to, "shackle", &["--robot", "shackle"]);
    done(&ended);
    assert!(ended.out.starts_with("1 frame written to"), "{}", ended.out);
    let ply = fs::read(&to).unwrap();
    let end = b"end_header\n";
    let head = ply.windows(end.len()).position(|window| window == end).unwrap() + end.len();
    let again = ply[head..].chunks(16).filter(|point| [1, 2].contains(&point[15])).count();
    let before = fs::read(folder.join("label_0.npy")).unwrap();
    let before = body(&before).iter().filter(|label| [1, 2].contains(*label)).count();
    // As many points as the cloud had, seen by a camera of another size.
    let ratio = again as f64 / before as f64;
    assert!((0.7..1.4).contains(&ratio), "{again} points of the arm, {before} before");
    let pose = ["pose", text(&cloud), "--model", "shackle", "--cache", text(&CACHE)];
    eyebolt(&pose).assert_error(1, &["cloud_0.pcd", "--robot"]);
    let json = eyebolt(&[&pose[..], &["--robot", "shackle", "--json"]].concat()).out;
    assert!(json.contains("\"frame\":\"cloud_0\""), "{json}");
}

#[test]
fn what_does_not_go_together_is_said() {
    let desk = Desk::new();
    let to = |name: &str| desk.file(name);
    segment(&SIMULATED, &to("one.ply"), "shackle", &[])
        .assert_error(1, &["one.ply", "15", "--clouds ply", ".mcap"]);
    segment(&SIMULATED, &to("all.mcap"), "shackle", &["--clouds", "ply"])
        .assert_error(1, &["all.mcap", "--clouds"]);
    assert!(desk.names().is_empty());
}

//! Every mistake in joints of CSV and JSON is told, and none is a panic.

use crate::joint_files::{with_files, with_joints, with_table};
use crate::sample::assert_says;
use eyebolt_recording::FrameSource;
use proptest::prelude::*;

#[track_caller]
fn csv(text: &str, named: bool, parts: &[&str]) {
    let parts: Vec<_> = parts.iter().chain(&["joints_2.csv: joints"]).copied().collect();
    assert_says(with_files("csv", text, named).frame(), &parts);
}

#[track_caller]
fn json(text: &str, named: bool, parts: &[&str]) {
    let parts: Vec<_> = parts.iter().chain(&["joints_2.json: joints"]).copied().collect();
    assert_says(with_files("json", text, named).frame(), &parts);
}

#[track_caller]
fn table(name: &str, text: &str, named: bool, parts: &[&str]) {
    let parts: Vec<_> = parts.iter().chain(&[name]).copied().collect();
    assert_says(with_table(name, text, named).open(), &parts);
}

#[test]
fn csv_of_one_frame() {
    csv("", false, &["the file is empty", "Begin the file"]);
    csv("\n\n", true, &["the file is empty"]);
    csv("shoulder,elbow\n", true, &["no row follows", "Add the positions"]);
    csv("shoulder,elbow\n1,1\n2,2\n", true, &["line 3", "second row", "without {}"]);
    csv("shoulder,elbow\n1\n", true, &["line 2", "found 1 values", "has 2"]);
    csv("shoulder;elbow\n0,5;1\n", true, &["no commas", "separated by commas"]);
    csv("shoulder,hand\n1,1\n", true, &["\"elbow\" is not among \"shoulder\", \"hand\""]);
    csv("shoulder,elbow,elbow\n1,1,1\n", true, &["\"elbow\" is there twice"]);
    csv("a,b,a\n1,1,1\n", false, &["\"a\" is there twice"]);
    csv("a,\n1,1\n", false, &["a joint has no name", "joint_names"]);
    csv("time,stamp\n1,1\n", false, &["no joint is named"]);
    csv("shoulder,elbow\n1,one\n", true, &["elbow is \"one\"", "Write a number"]);
    csv("a,state\n1,moving\n", false, &["state is \"moving\"", "joint_names"]);
    csv("shoulder,elbow\n0,90\n", true, &["elbow is 90", "looks like degrees"]);
    csv("shoulder,elbow\n0,nan\n", true, &["elbow is NaN", "leave it out"]);
    csv("0.5,0.5\n", false, &["numbers, not names", "joint_names"]);
    csv("0.5,0.5,0.5\n", true, &["3 positions", "2 names", "joint_names"]);
    csv("0.5,0.5\n1,1\n", true, &["line 2", "one row of numbers, or one column"]);
    csv("0.5\nx\n", true, &["line 2", "one row of numbers"]);
    let many: Vec<_> = (0..1001).map(|i| format!("j{i}")).collect();
    csv(&many.join(","), false, &["1001 columns, more than 1000"]);
    let sample = with_files("csv", "", false);
    sample.write("joints_2.csv", b"a\xff\n1\n");
    assert_says(sample.frame(), &["joints_2.csv", "byte 1 is not UTF-8"]);
}

#[test]
fn json_of_one_frame() {
    json(" \n", false, &["the file is empty", "radians"]);
    json("{\"a\": 1", false, &["EOF", "line 1"]);
    json("{\"a\": NaN}", false, &["line 1"]);
    json("{} {}", false, &["trailing characters"]);
    json("[1, 2]", false, &["sequence", "an object of joints"]);
    json("{}", false, &["no joint is named"]);
    json("{\"shoulder\": 1}", true, &["\"elbow\" is not among \"shoulder\""]);
    json("{\"a\": 1, \"a\": 2}", false, &["\"a\" is there twice"]);
    json("{\"a\": \"1\"}", false, &["position of a is not a number"]);
    json("{\"a\": null}", false, &["position of a is not a number"]);
    json("{\"a\": 1e999}", false, &["out of range"]);
    json("{\"a\": -90}", false, &["a is -90", "looks like degrees"]);
    json("{\"name\": [\"a\", \"b\"], \"position\": [1]}", false, &["2 entries", "has 1"]);
    json("{\"name\": [\"a\", \"a\"], \"position\": [1, 1]}", false, &["\"a\" is there twice"]);
    json("{\"name\": [7], \"position\": [1]}", false, &["a joint has no name"]);
    json("{\"name\": [\"a\"], \"position\": [[1]]}", false, &["a is not a number"]);
    json("{\"name\": [], \"position\": []}", false, &["no joint is named"]);
    for (open, close) in [("[", ""), ("{\"a\":", ""), ("[", "]")] {
        let deep = open.repeat(100_000) + &close.repeat(100_000);
        json(&format!("{{\"a\": {deep}}}"), false, &[""]);
        json(&deep, false, &[""]);
    }
    let many: Vec<_> = (0..1001).map(|i| format!("\"j{i}\": 0")).collect();
    json(&format!("{{{}}}", many.join(",")), false, &["more than 1000 names"]);
    let long = format!("{{\"name\": [{}\"a\"]}}", "\"a\",".repeat(2000));
    json(&long, false, &["name is not a number"]);
}

#[test]
fn tables_have_one_row_for_every_frame() {
    let name = "joints.csv";
    table(name, "frame,a\n2,1\n", false, &["frame 10 is not there", "move the files"]);
    table(name, "frame,a\n2,1\n10,1\n2,1\n", false, &["line 4: frame 2 again, after line 2"]);
    table(name, "frame,a\n2,1\n10,1\n02,1\n", false, &["line 4: frame 02 again, after line 2"]);
    table(name, "frame,a\n2,90\n10,1\n", false, &["line 2: the position of a", "degrees"]);
    table(name, "frame,a\n2,\n10,1\n", false, &["line 2: the position of a is \"\""]);
    table(name, "frame,a\n2,1\n10,1,1\n", false, &["line 3: found 3 values"]);
    table(name, "name,a\n2,1\n10,1\n", false, &["one column \"frame\"", "Add it"]);
    table(name, "frame,a,frame\n2,1,2\n", false, &["one column \"frame\""]);
    table(name, "frame,shoulder\n2,1\n10,1\n", true, &["\"elbow\" is not among"]);
    table(name, "0,1,1\n2,1,1\n", true, &["\"shoulder\" is not among"]);
    table(name, "", false, &["the file is empty"]);
    let name = "joints.json";
    table(name, "{\"2\": {\"a\": 1}}", false, &["frame 10 is not there"]);
    let twice = "{\"2\": {\"a\": 1}, \"10\": {\"a\": 1}, \"2\": {\"a\": 1}}";
    table(name, twice, false, &["entry 3: frame 2 again, after entry 1"]);
    table(name, "[{\"frame\": 10, \"a\": 99}]", false, &["entry 1: the position of a is 99"]);
    table(name, "[{\"a\": 1}]", false, &["entry 1: no \"frame\""]);
    table(name, "[{\"frame\": [2], \"a\": 1}]", false, &["entry 1: no \"frame\""]);
    table(name, "{\"a\": 1}", false, &["integer", "an object of joints"]);
    table(name, "7", false, &["integer", "the joints of every frame"]);
    table(name, &"[".repeat(100_000), false, &["joints.json: joints"]);
    table(name, &"{\"a\":".repeat(100_000), false, &["joints.json: joints"]);
    // A row of zeros fits two frames by its number, and so none.
    let sample = with_table("joints.csv", "frame,a\n002,1\n10,1\n", false);
    for kind in ["depth_2.npy", "mask_2.png", "color_2.png"] {
        sample.write(&kind.replace('2', "02"), &sample.read(kind));
    }
    assert_says(sample.open(), &["frame 02 is not there"]);
}

#[test]
fn descriptions_of_joints() {
    assert_says(with_joints("joints.npy", true).open(), &["frames.joints", "no {}"]);
    assert_says(with_joints("joints.txt", true).open(), &["frames.joints", "no {}"]);
    assert_says(with_joints("j_{}.txt", true).open(), &[".npy or .csv or .json"]);
    assert_says(with_joints("{}/joints.csv", true).open(), &["in its file name"]);
    assert_says(with_joints("joints.csv", true).open(), &["joints.csv", "cannot read joints"]);
    let missing = with_joints("j_{}.json", true).open();
    assert_says(missing, &["frames.joints", "frame 2", "j_2.json is missing"]);
    let sample = with_joints("joints_{}.csv", true);
    sample.describe("\"shoulder\", \"elbow\"", "");
    assert_says(sample.open(), &["frames.joint_names", "empty", "List the joints"]);
    let folder = with_table("joints.csv", "frame,a\n2,1\n10,1\n", false).open().unwrap();
    assert_says(folder.read_joints(2), &["index 2", "2 frames"]);
}

#[test]
fn text_that_is_too_large() {
    let sample = with_files("csv", "", false);
    std::fs::File::create(sample.file("joints_2.csv")).unwrap().set_len(2 << 20).unwrap();
    assert_says(sample.frame(), &["joints_2.csv", "1 MiB"]);
    let sample = with_table("joints.json", "", false);
    std::fs::File::create(sample.file("joints.json")).unwrap().set_len(9 << 20).unwrap();
    assert_says(sample.open(), &["joints.json", "8 MiB"]);
}

const CSV: &str = "frame,shoulder,elbow\n2,0.5,\"0.25\"\n10,1,1\n";
const JSON: &str = "{\"2\": {\"name\": [\"a\"], \"position\": [0.5]}, \"10\": {\"a\": 1}}";

#[test]
fn text_cut_short() {
    for end in 0..JSON.len() {
        assert!(with_table("joints.json", &JSON[..end], false).open().is_err());
    }
    for end in 0..CSV.len() {
        let opened = with_table("joints.csv", &CSV[..end], false).open();
        // The last line may do without its end.
        assert!(opened.is_err() || end + 1 == CSV.len(), "cut to {end} was read");
    }
}

proptest! {
    // Every case writes a folder.
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn changed_bytes_never_panic(
        json in any::<bool>(),
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let (name, text) = if json { ("joints.json", JSON) } else { ("joints.csv", CSV) };
        let mut bytes = text.as_bytes().to_vec();
        for (index, value) in changes {
            let at = index.index(bytes.len());
            bytes[at] = value;
        }
        let sample = with_table(name, text, false);
        sample.write(name, &bytes);
        let _ = sample.frame();
    }
}

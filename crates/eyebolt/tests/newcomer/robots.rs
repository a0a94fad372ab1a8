//! Robot descriptions that hold more than the arm, or something else.

use crate::recording::{write, write_depth};
use crate::run::{MASKED, WITH_MASKS, folder, run, truth, try_run};
use crate::scene::{JOINTS, Shot, URDF, shot, shots};
use eyebolt::calibrate::{Reason, Verdict};
use tempfile::TempDir;

/// The recording of `shots` with another robot description.
fn recorded(shots: &[Shot], urdf: &str) -> TempDir {
    let folder = folder();
    write_depth(folder.path(), shots);
    write(folder.path(), "arm.urdf", urdf.as_bytes());
    folder
}

/// The arm's description with `more` added to it.
fn with(more: &str) -> String {
    let text = URDF.replace("</robot>", &format!("{more}</robot>"));
    assert_ne!(text, URDF);
    text
}

#[test]
fn what_the_arm_stands_on_is_not_the_arm() {
    let table = "<link name=\"world\"/>
        <link name=\"table\"><visual><geometry><box size=\"80 80 0.02\"/></geometry></visual></link>
        <joint name=\"floor\" type=\"fixed\"><parent link=\"world\"/><child link=\"table\"/></joint>
        <joint name=\"feet\" type=\"fixed\"><parent link=\"table\"/><child link=\"base\"/></joint>";
    let folder = recorded(&shots(), &with(table));
    run(folder.path(), WITH_MASKS).assert_trusted(&truth(), MASKED);
}

#[test]
fn a_link_in_millimetres_is_told_so() {
    let huge = "<link name=\"tool\"><visual><geometry><box size=\"120 80 60\"/></geometry></visual></link>
        <joint name=\"flange\" type=\"fixed\"><parent link=\"hand\"/><child link=\"tool\"/></joint>";
    let folder = recorded(&shots(), &with(huge));
    let error = try_run(folder.path(), WITH_MASKS).err().unwrap().to_string();
    assert!(["tool", "120 m", "0.001"].iter().all(|word| error.contains(word)), "{error}");
}

#[test]
fn a_joint_that_is_not_the_arms_makes_no_configurations() {
    let cart = "<link name=\"cart\"/>
        <joint name=\"wheel\" type=\"continuous\"><parent link=\"cart\"/><child link=\"base\"/></joint>";
    // The wheel takes the place of a name that the base's own arm does not have.
    let frames: Vec<Shot> = (1..6).map(|seed| shot(JOINTS[0], seed)).collect();
    let folder = recorded(&frames, &with(cart));
    for frame in 0..5 {
        let values: Vec<f64> = JOINTS[0].into_iter().chain([f64::from(frame)]).collect();
        let bytes = crate::recording::npy_f64(&[7], &values);
        write(folder.path(), &format!("joints_{frame}.npy"), &bytes);
    }
    let path = folder.path().join("recording.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let names = format!("{:?}", crate::scene::JOINT_NAMES);
    let more = names.replace(']', ", \"wheel\"]");
    std::fs::write(&path, text.replace(&names, &more)).unwrap();
    let Verdict::Refused(reasons) = run(folder.path(), WITH_MASKS).verdict().clone() else {
        panic!("trusted")
    };
    let few = |reason: &Reason| matches!(reason, Reason::FewConfigurations { used: 1, .. });
    assert!(reasons.iter().any(few), "{reasons:?}");
}

//! What goes wrong with a recording goes wrong where it should, and nowhere else.

use eyebolt::robots::BuiltIn;
use eyebolt::study::{Kind, Tampering};
use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera};
use eyebolt_recording::{FrameSource, InMemory, Range};
use eyebolt_render::Random;
use eyebolt_robot::JointPositions;

fn robot(name: &str) -> &'static BuiltIn {
    BuiltIn::named(name).unwrap()
}

/// Two frames of shackle and a background.
fn source() -> InMemory {
    let camera = PinholeCamera::new(4, 3, 5.0, 5.0, 1.5, 1.0, Distortion::None).unwrap();
    let depth = |z: f32| DepthImage::new(4, 3, vec![z; 12]).unwrap();
    let arm = robot("shackle").arm();
    let joints = |shift: f64| -> JointPositions {
        let names = arm.required_joints();
        names.iter().zip(1..).map(|(n, i)| ((*n).to_owned(), 0.1 * f64::from(i) + shift)).collect()
    };
    let mut source = InMemory::new(camera);
    source.push("a", depth(1.0), joints(0.0)).unwrap();
    source.push("b", depth(1.5), joints(0.03)).unwrap();
    source.push_background(depth(2.0)).unwrap();
    source
}

fn depth_m(source: &InMemory, frame: usize) -> f32 {
    match source.read_frame(frame).unwrap().range {
        Range::Depth(depth) => depth.at(1, 1),
        Range::Cloud(_) => panic!("depth is images"),
    }
}

#[test]
fn depth_in_another_unit_is_so_everywhere() {
    let arm = robot("shackle").arm();
    let short = Tampering::DepthUnit(0.001).apply(&source(), &arm).unwrap();
    assert_eq!((depth_m(&short, 0), depth_m(&short, 1)), (0.001, 0.0015));
    assert_eq!(short.read_background(0).unwrap().at(0, 0), 0.002);
    assert_eq!(short.read_joints(1).unwrap(), source().read_joints(1).unwrap());
    // Kilometres are turned down at the door.
    assert!(Tampering::DepthUnit(1000.0).apply(&source(), &arm).is_err());
}

#[test]
fn exchanged_joints_are_two_and_the_rest_stays() {
    let arm = robot("shackle").arm();
    for seed in 0..20 {
        let drawn = Tampering::draw(Kind::JointOrder, robot("shackle"), &mut Random::new(seed));
        let Some(Tampering::ExchangedJoints([one, other])) = &drawn else { panic!("{drawn:?}") };
        assert_ne!(one, other);
        let wrong = drawn.as_ref().unwrap().apply(&source(), &arm).unwrap();
        let (wrong, right) = (wrong.read_joints(1).unwrap(), source().read_joints(1).unwrap());
        assert_eq!((wrong.get(one), wrong.get(other)), (right.get(other), right.get(one)));
        let same = right.iter().filter(|(name, at)| wrong.get(name) == Some(*at)).count();
        assert_eq!(same, 5);
    }
}

#[test]
fn degrees_and_another_robots_names() {
    let arm = robot("shackle").arm();
    // Small ones could be radians; larger ones are turned down at the door.
    let told = Tampering::Degrees.apply(&source(), &arm).unwrap_err().to_string();
    assert!(told.contains("looks like degrees"), "{told}");
    let mut small = InMemory::new(source().camera().unwrap().clone());
    let joints = [("joint1".to_owned(), 0.01)].into_iter().collect();
    small.push("a", DepthImage::new(4, 3, vec![1.0; 12]).unwrap(), joints).unwrap();
    let degrees = Tampering::Degrees.apply(&small, &arm).unwrap().read_joints(0).unwrap();
    assert!((degrees.get("joint1").unwrap() - 0.01_f64.to_degrees()).abs() < 1e-12);
    let other = Tampering::OtherRobot(robot("davit")).apply(&source(), &arm).unwrap();
    let other = other.read_joints(0).unwrap();
    assert_eq!(
        (other.get("shoulder_pan"), other.get("wrist_3_joint")),
        (Some(0.1), Some(6.0 * 0.1))
    );
    assert_eq!(other.len(), 6);
    // Where the other has more joints, the rest stands at 0.
    let five = robot("cleat").arm();
    let names = five.required_joints().into_iter().map(|name| (name.to_owned(), 0.5));
    let mut few = InMemory::new(source().camera().unwrap().clone());
    few.push("a", DepthImage::new(4, 3, vec![1.0; 12]).unwrap(), names.collect()).unwrap();
    let seven = Tampering::OtherRobot(robot("capstan")).apply(&few, &five).unwrap();
    let seven = seven.read_joints(0).unwrap();
    assert_eq!((seven.get("joint5"), seven.get("joint6")), (Some(0.5), Some(0.0)));
}

#[test]
fn other_kinds_leave_the_recording_alone() {
    for kind in Kind::ALL {
        let drawn = Tampering::draw(*kind, robot("shackle"), &mut Random::new(1));
        let tampers = matches!(kind, Kind::OtherRobot | Kind::JointOrder | Kind::WrongUnit);
        assert_eq!(drawn.is_some(), tampers, "{kind}");
    }
}

//! Robot descriptions, up to where the links of the arm are.
#![no_main]

use eyebolt_fuzz::{FOLDER, file};
use eyebolt_robot::{
    JointPositions, KinematicsError, PackageRoots, Prefer, Robot, Shape, link_fingerprint,
    link_mesh,
};
use libfuzzer_sys::fuzz_target;

/// Round shapes above this have too many facets to be made thousands of times, metres.
const LARGEST: f64 = 0.2;

fuzz_target!(|text: &str| {
    file("mesh.stl", include_bytes!("../seeds/meshes/binary.stl"));
    let packages = PackageRoots::new().with_package("robot", FOLDER.as_path());
    let Ok(robot) = Robot::from_urdf_str(text, Some(FOLDER.as_path()), &packages) else { return };
    for link in robot.links.iter().take(2) {
        let _ = link_fingerprint(link, Prefer::Visual);
        if link.visuals.iter().take(4).all(|body| is_small(&body.shape)) {
            let _ = link_mesh(link, Prefer::Visual);
        }
    }
    let Ok(arm) = robot.arm(None, None) else { return };
    let names = arm.required_joints().into_iter().chain(arm.other_joints());
    let positions: JointPositions = names.map(|name| (name.to_owned(), 0.25)).collect();
    let _ = (arm.unknown_joints(&positions), arm.joints_outside_limits(&positions));
    // Numbers may still be too large for a product of them.
    if let Err(error) = arm.link_poses(&positions) {
        assert!(matches!(error, KinematicsError::NotFinite { .. }), "{error}");
    }
});

fn is_small(shape: &Shape) -> bool {
    match shape {
        Shape::Mesh { .. } | Shape::Box { .. } => true,
        Shape::Cylinder { radius, .. }
        | Shape::Capsule { radius, .. }
        | Shape::Sphere { radius } => *radius <= LARGEST,
    }
}

//! Keypoints chosen on meshes.

use crate::gripper::{apart_m, arm, joints, two_fingers, visual};
use eyebolt::end_effector::{EndEffector, FEWEST_KEYPOINTS, MOST_KEYPOINTS};
use eyebolt::robots::BUILT_IN;
use eyebolt_robot::{JointPositions, TriangleMesh};
use nalgebra::Point3;
use std::path::Path;

/// Each triangle as four, the corners of the old ones where they were.
fn subdivided(mesh: &TriangleMesh) -> TriangleMesh {
    let mut finer = TriangleMesh { vertices: mesh.vertices.clone(), triangles: Vec::new() };
    for [a, b, c] in &mesh.triangles {
        let mut middle = |i: &u32, j: &u32| {
            let (i, j) = (&mesh.vertices[*i as usize], &mesh.vertices[*j as usize]);
            finer.vertices.push(nalgebra::center(i, j));
            finer.vertices.len() as u32 - 1
        };
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        finer.triangles.extend([[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]);
    }
    finer
}

/// The same triangles in another order, by other corners first.
fn shuffled(mesh: &TriangleMesh) -> TriangleMesh {
    let turned = mesh.triangles.iter().rev().map(|[a, b, c]| [*b, *c, *a]);
    TriangleMesh { vertices: mesh.vertices.clone(), triangles: turned.collect() }
}

fn keypoints_of(mesh: &TriangleMesh, folder: &Path) -> Vec<Point3<f64>> {
    let mut text = String::new();
    for v in &mesh.vertices {
        text += &format!("v {} {} {}\n", v.x, v.y, v.z);
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| corner + 1);
        text += &format!("f {a} {b} {c}\n");
    }
    std::fs::write(folder.join("hand.obj"), text).unwrap();
    let hand = arm(&visual("0 0 0", r#"<mesh filename="hand.obj"/>"#), "", Some(folder));
    EndEffector::of(&hand).unwrap().keypoints(&JointPositions::default())
}

/// As far apart as one of `a` is from the nearest of `b`: symmetric ones have no order.
fn unordered_m(a: &[Point3<f64>], b: &[Point3<f64>]) -> f64 {
    let nearest = |p: &Point3<f64>| b.iter().map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min);
    a.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn another_triangulation_has_the_same_keypoints() {
    let folder = tempfile::tempdir().unwrap();
    for robot in BUILT_IN {
        let mesh = EndEffector::of(&robot.arm()).unwrap().mesh(&JointPositions::default());
        let plain = keypoints_of(&mesh, folder.path());
        let finer = keypoints_of(&subdivided(&mesh), folder.path());
        let again = keypoints_of(&shuffled(&subdivided(&subdivided(&mesh))), folder.path());
        assert_eq!(plain.len(), finer.len(), "{}", robot.name);
        assert!(apart_m(&plain, &finer) < 2e-3, "{}: {plain:?} {finer:?}", robot.name);
        assert!(unordered_m(&plain, &again) < 2e-3, "{}: {plain:?} {again:?}", robot.name);
    }
}

#[test]
fn keypoints_are_few_and_far_apart_and_on_the_outside() {
    for robot in BUILT_IN {
        let hand = EndEffector::of(&robot.arm()).unwrap();
        let none = JointPositions::default();
        let points = hand.keypoints(&none);
        assert!((FEWEST_KEYPOINTS..=MOST_KEYPOINTS).contains(&points.len()), "{}", robot.name);
        let size = hand.mesh_box(&none).size_m().norm();
        for (index, point) in points.iter().enumerate() {
            let others = points.iter().enumerate().filter(|(other, _)| *other != index);
            let nearest = others.map(|(_, q)| (point - q).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest > 0.1 * size, "{}: {points:?}", robot.name);
        }
    }
}

#[test]
fn fingers_carry_their_keypoints() {
    let hand = EndEffector::of(&two_fingers()).unwrap();
    let at = |open: f64| hand.keypoints(&joints(&[("slide_left", open)]));
    let (closed, open) = (at(0.0), at(0.04));
    let links = hand.fixed_keypoints().iter().map(|keypoint| keypoint.link);
    let mut moved = 0;
    for ((link, before), after) in links.zip(&closed).zip(&open) {
        let on_finger = link != hand.fixed_keypoints()[0].link && (before - after).norm() > 0.0;
        assert!((before - after).norm() < 1e-9 || ((before - after).norm() - 0.04).abs() < 1e-9);
        moved += usize::from(on_finger);
    }
    assert!(moved >= 2, "{:?}", hand.fixed_keypoints());
}

#[test]
fn where_the_arm_is_does_not_matter_nor_what_is_not_a_number() {
    let hand = EndEffector::of(&two_fingers()).unwrap();
    let known = hand.keypoints(&joints(&[("slide_left", 0.0)]));
    let turned = hand.keypoints(&joints(&[("slide_left", 0.0), ("turn", 1.2)]));
    assert!(apart_m(&known, &turned) < 1e-12);
    let broken = hand.keypoints(&joints(&[("slide_left", f64::NAN), ("turn", f64::INFINITY)]));
    assert!(apart_m(&known, &broken) < 1e-12);
}

//! What stands around an arm in an image to learn from.

use crate::simulate::{Solid, clutter, room_of_any_size};
use eyebolt_geometry::{Base, Link, Transform};
use eyebolt_render::{Random, RayScene, SceneMesh};
use eyebolt_robot::{Body, Shape};
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// Things that stand about, at most.
const MOST_THINGS: usize = 9;
/// How often the arm stands on something higher than the table, hangs, or is tilted.
const ON_PEDESTAL: f64 = 0.25;
const TILTED: f64 = 0.12;
/// How often there is no room around at all: beyond the range of the camera.
const NO_ROOM: f64 = 0.06;

/// Everything around arms that cameras at `eyes` (base frame, metres) look at: no wall is before one of
/// them, and nothing close to it.
pub fn scenery(random: Random, eyes: &[Point3<f64>]) -> RayScene {
    let mut style = random.at(0);
    let base_from_world = mounting(&mut style);
    let world_from_base = base_from_world.inverse();
    let eyes: Vec<Point3<f64>> = eyes.iter().map(|eye| world_from_base.point(eye)).collect();
    let mut solids = Vec::new();
    if style.uniform() >= NO_ROOM {
        solids = room_of_any_size(&mut style, &eyes);
        if style.uniform() < 0.3 {
            solids.retain(|solid| solid.name != "table" && solid.name != "leg");
        }
    }
    let raised = world_from_base.point(&Point3::origin()).z;
    if raised > 0.02 {
        solids.push(pedestal(&mut style, raised));
    }
    let things = style.index(MOST_THINGS + 1);
    solids.extend((0..things as u64).map(|thing| clutter(&mut random.at(1).at(thing))));
    let floating = style.index(4);
    solids.extend((0..floating as u64).map(|thing| debris(&mut random.at(2).at(thing))));
    let clear = |solid: &&Solid| {
        let near = |vertex: &Point3<f32>| {
            eyes.iter().any(|eye| (vertex.cast::<f64>() - eye).norm() < 0.35)
        };
        !solid.mesh.vertices.iter().any(near)
    };
    let meshes: Vec<SceneMesh<'_>> = solids
        .iter()
        .filter(clear)
        .map(|solid| SceneMesh { mesh: &solid.mesh, base_from_mesh: base_from_world })
        .collect();
    RayScene::new(&meshes)
}

/// Where the room is: the arm stands on the table, is raised, or mounted aslant.
fn mounting(random: &mut Random) -> Transform<Base, Link> {
    let choice = random.uniform();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.between(0.0, 6.3));
    if choice < TILTED {
        let axis = Vector3::new(random.normal(), random.normal(), random.normal());
        let angle = random.between(0.3, 3.1);
        let tilt = UnitQuaternion::new(axis.normalize() * angle);
        let at = Vector3::from_fn(|_, _| random.between(-0.5, 0.5));
        return Transform::from_parts(at, tilt * turn);
    }
    let raised = choice < TILTED + ON_PEDESTAL;
    let down = if raised { random.between(0.03, 0.8) } else { 0.0 };
    Transform::from_parts(Vector3::new(0.0, 0.0, -down), turn)
}

/// What a raised arm stands on.
fn pedestal(random: &mut Random, height: f64) -> Solid {
    let width = random.between(0.12, 0.5);
    let shape = if random.uniform() < 0.6 {
        Shape::Box { size: [width, random.between(0.12, 0.5), height] }
    } else {
        Shape::Cylinder { radius: 0.5 * width, length: height }
    };
    let middle = Vector3::new(0.0, 0.0, 0.5 * height - 0.002);
    let link_from_body = Transform::from_parts(middle, UnitQuaternion::identity());
    Solid::new("pedestal", &[Body { link_from_body, shape }])
}

/// A post, a board, a ball or a frame anywhere around, which a network must not take for an arm.
fn debris(random: &mut Random) -> Solid {
    let around = random.between(0.0, std::f64::consts::TAU);
    let far = random.between(0.25, 1.8);
    let mut at = Vector3::new(far * around.cos(), far * around.sin(), random.between(-0.2, 1.3));
    let upright = random.uniform() < 0.6;
    let axis = Vector3::new(random.normal(), random.normal(), random.normal()).normalize();
    let turn = if upright {
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), around)
    } else {
        UnitQuaternion::new(axis * random.between(0.0, 3.1))
    };
    let mut part = |shape: Shape| {
        let body = Body { link_from_body: Transform::from_parts(at, turn), shape };
        at += turn * Vector3::new(0.0, 0.0, 0.2);
        body
    };
    let [a, b, c] = [0, 1, 2].map(|_| random.between(0.02, 0.25));
    let long = random.between(0.15, 1.2);
    let bodies = match random.index(5) {
        0 => vec![part(Shape::Box { size: [0.3 * a, 0.3 * b, long] })],
        1 => vec![part(Shape::Box { size: [a, 2.0 * b, 0.5 * long] })],
        2 => vec![part(Shape::Cylinder { radius: 0.3 * a, length: long })],
        3 => vec![part(Shape::Sphere { radius: 0.5 * a })],
        _ => vec![
            part(Shape::Cylinder { radius: 0.3 * a, length: 0.4 }),
            part(Shape::Box { size: [a, b, c] }),
            part(Shape::Cylinder { radius: 0.4 * b, length: 0.3 }),
        ],
    };
    Solid::new("debris", &bodies)
}

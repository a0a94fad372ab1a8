//! What stands around a robot: table, walls, boxes, cables, a person.

use super::solids::{Solid, place};
use eyebolt_geometry::Transform;
use eyebolt_render::Random;
use eyebolt_robot::{Body, Shape};
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// Top of the table that the arm stands on, metres below the base's origin: as flush as two real
/// surfaces are.
pub const TABLE_BELOW_M: f64 = 0.001;

/// Half the size of the table along x and y, and where its middle is, metres.
const TABLE_HALF_M: [f64; 2] = [0.75, 0.80];
const TABLE_MIDDLE_M: [f64; 2] = [0.35, 0.0];
const TABLE_HEIGHT_M: f64 = 0.75;

/// How far walls are from the arm, and half the breadth of floor and walls, metres.
#[derive(Clone, Copy)]
pub struct RoomSize {
    walls_m: [f64; 2],
    half_m: f64,
}

/// A usual room, and a hall.
pub const ROOM: RoomSize = RoomSize { walls_m: [1.9, 3.4], half_m: 4.5 };
pub const HALL: RoomSize = RoomSize { walls_m: [4.0, 6.0], half_m: 7.0 };
/// How far walls are behind the camera at least, metres.
const BEHIND_CAMERA_M: f64 = 0.3;

/// The room around an arm and cameras at `eyes` (base frame): what never comes nearer to the arm
/// than the table does, nor between the two.
pub fn room(random: &mut Random, eyes: &[Point3<f64>], size: RoomSize) -> Vec<Solid> {
    let RoomSize { walls_m: [near, far], half_m } = size;
    let top = -TABLE_BELOW_M;
    let [x, y] = TABLE_MIDDLE_M;
    let [half_x, half_y] = TABLE_HALF_M;
    let mut solids = vec![
        cuboid("table", [x, y, top - 0.02], [2.0 * half_x, 2.0 * half_y, 0.04]),
        cuboid("floor", [0.0, 0.0, -TABLE_HEIGHT_M - 0.05], [2.0 * half_m, 2.0 * half_m, 0.1]),
    ];
    let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
    solids.extend(corners.map(|[sx, sy]| {
        let at = [x + 0.9 * sx * half_x, y + 0.9 * sy * half_y, top - 0.5 * TABLE_HEIGHT_M];
        cuboid("leg", at, [0.06, 0.06, TABLE_HEIGHT_M])
    }));
    // Walls on all four sides, at a distance of their own.
    for (axis, sign) in [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0)] {
        let behind = eyes.iter().map(|eye| sign * eye[axis] + BEHIND_CAMERA_M);
        let far = behind.fold(random.between(near, far), f64::max);
        let mut at = [0.0, 0.0, 0.8];
        let mut size = [2.0 * half_m; 3];
        size[2] = 3.4;
        at[axis] = sign * far;
        size[axis] = 0.1;
        solids.push(cuboid("wall", at, size));
    }
    solids
}

/// A room or a hall, as `random` decides.
pub fn room_of_any_size(random: &mut Random, eyes: &[Point3<f64>]) -> Vec<Solid> {
    let size = if random.uniform() < 0.5 { ROOM } else { HALL };
    room(random, eyes, size)
}

/// Something to stand about on the table or beside it, wherever `random` puts it.
pub fn clutter(random: &mut Random) -> Solid {
    match random.index(10) {
        0..=3 => crate_on_table(random),
        4..=5 => bottle(random),
        6 => ball(random),
        7..=8 => cable(random),
        _ => person(random),
    }
}

/// Somebody or something that is not always there.
pub fn passer_by(random: &mut Random) -> Solid {
    if random.uniform() < 0.5 { person(random) } else { clutter(random) }
}

fn on_table(random: &mut Random, margin: f64) -> Vector3<f64> {
    let [half_x, half_y] = TABLE_HALF_M.map(|half| half - margin);
    let [x, y] = TABLE_MIDDLE_M;
    Vector3::new(
        x + random.between(-half_x, half_x),
        y + random.between(-half_y, half_y),
        -TABLE_BELOW_M,
    )
}

fn crate_on_table(random: &mut Random) -> Solid {
    let size = [0.06, 0.05, 0.04].map(|least| random.between(least, 0.30));
    let at = on_table(random, 0.15) + Vector3::new(0.0, 0.0, 0.5 * size[2]);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.between(0.0, 3.0));
    let body = Body { link_from_body: Transform::from_parts(at, turn), shape: Shape::Box { size } };
    Solid::new("box", &[body])
}

fn bottle(random: &mut Random) -> Solid {
    let (radius, length) = (random.between(0.02, 0.05), random.between(0.08, 0.26));
    let at = on_table(random, 0.10);
    let at_height = |z: f64| at + Vector3::new(0.0, 0.0, z);
    let neck = 0.3 * length;
    Solid::new(
        "bottle",
        &[
            place(at_height(0.5 * length), Shape::Cylinder { radius, length }),
            place(
                at_height(length + 0.5 * neck),
                Shape::Cylinder { radius: 0.35 * radius, length: neck },
            ),
        ],
    )
}

fn ball(random: &mut Random) -> Solid {
    let radius = random.between(0.03, 0.11);
    let at = on_table(random, 0.12) + Vector3::new(0.0, 0.0, radius);
    Solid::new("ball", &[place(at, Shape::Sphere { radius })])
}

/// A cable that lies on the table in bends.
fn cable(random: &mut Random) -> Solid {
    let radius = random.between(0.003, 0.008);
    let mut at = Point3::from(on_table(random, 0.15) + Vector3::new(0.0, 0.0, radius));
    let mut heading = random.between(0.0, std::f64::consts::TAU);
    let mut bodies = Vec::new();
    for _ in 0..14 {
        heading += random.between(-0.6, 0.6);
        let next = at + 0.05 * Vector3::new(heading.cos(), heading.sin(), 0.0);
        bodies.push(rod(&at, &next, radius));
        at = next;
    }
    Solid::new("cable", &bodies)
}

/// Somebody standing beside the table, arms hanging.
fn person(random: &mut Random) -> Solid {
    let around = random.between(0.0, std::f64::consts::TAU);
    let far = random.between(1.15, 1.7);
    let height = random.between(1.55, 1.9);
    let feet = Vector3::new(
        TABLE_MIDDLE_M[0] + far * around.cos(),
        far * around.sin(),
        -TABLE_BELOW_M - TABLE_HEIGHT_M,
    );
    let facing = UnitQuaternion::from_axis_angle(
        &Vector3::z_axis(),
        around + std::f64::consts::PI + random.between(-0.6, 0.6),
    );
    // Heights and breadths as shares of the stature (Drillis and Contini, 1966).
    let at =
        |x: f64, y: f64, z: f64| Point3::from(feet + facing * (height * Vector3::new(x, y, z)));
    let limb = |from: Point3<f64>, to: Point3<f64>, radius: f64| rod(&from, &to, height * radius);
    let mut bodies = vec![
        limb(at(0.0, 0.0, 0.56), at(0.0, 0.0, 0.76), 0.085),
        limb(at(0.0, -0.07, 0.78), at(0.0, 0.07, 0.78), 0.045),
        place(at(0.01, 0.0, 0.93).coords, Shape::Sphere { radius: 0.06 * height }),
        limb(at(0.0, 0.0, 0.82), at(0.0, 0.0, 0.88), 0.032),
    ];
    for side in [-1.0, 1.0] {
        bodies.push(limb(at(0.0, 0.055 * side, 0.05), at(0.0, 0.05 * side, 0.50), 0.045));
        bodies.push(limb(at(0.0, 0.125 * side, 0.79), at(0.01, 0.14 * side, 0.63), 0.027));
        bodies.push(limb(at(0.01, 0.14 * side, 0.62), at(0.06, 0.13 * side, 0.44), 0.022));
    }
    Solid::new("person", &bodies)
}

/// A capsule from `a` to `b`.
fn rod(a: &Point3<f64>, b: &Point3<f64>, radius: f64) -> Body {
    let along = b - a;
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 3.2));
    Body {
        link_from_body: Transform::from_parts(nalgebra::center(a, b).coords, turn),
        shape: Shape::Capsule { radius, length: along.norm() },
    }
}

fn cuboid(name: &'static str, middle: [f64; 3], size: [f64; 3]) -> Solid {
    Solid::new(name, &[place(Vector3::from(middle), Shape::Box { size })])
}

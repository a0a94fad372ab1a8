//! A small arm on a table before a wall, and what a depth camera whose pose is known sees of it.

use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, Transform};
use eyebolt_render::{PosedMesh, Raster};
use eyebolt_robot::{JointPositions, PackageRoots, Prefer, Robot, TriangleMesh, link_mesh};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use std::path::Path;
use std::sync::LazyLock;

/// The arm's description.
pub const URDF: &str = include_str!("arm.urdf");

/// Names of its joints, from the base to the hand.
pub const JOINT_NAMES: [&str; 6] = ["turn", "lift", "elbow", "twist", "bend", "roll"];

/// Five configurations, radians.
pub const JOINTS: [[f64; 6]; 5] = [
    [0.4, 0.3, 1.1, 0.4, 0.7, 0.2],
    [-0.9, -0.4, 1.5, -1.0, -0.8, 1.6],
    [1.5, 0.7, 0.4, 1.9, 1.0, -1.2],
    [-0.2, -0.7, 1.9, 0.9, -1.3, 2.6],
    [0.9, 0.1, -1.0, -1.7, 0.9, -2.3],
];

/// The camera.
pub static CAMERA: LazyLock<PinholeCamera> = LazyLock::new(|| {
    PinholeCamera::new(424, 240, 306.0, 306.5, 213.4, 119.1, Distortion::None).unwrap()
});

/// Where the camera is.
pub static CAMERA_FROM_BASE: LazyLock<Transform<Camera, Base>> = LazyLock::new(|| {
    let (camera_in_base, middle_in_base) =
        (Vector3::new(1.10, 0.50, 0.85), Vector3::new(0.10, 0.05, 0.38));
    let forward = middle_in_base - camera_in_base;
    let rotation = UnitQuaternion::face_towards(&forward, &-Vector3::z())
        * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.12);
    Transform::<Base, Camera>::from_parts(camera_in_base, rotation).inverse()
});

/// Boxes of the room in the base frame, metres, from corner to corner: table, wall, floor, crate.
const ROOM: [[[f64; 3]; 2]; 4] = [
    [[-0.60, -0.90, -0.05], [0.60, 0.80, -0.001]],
    [[-0.80, -3.00, -1.00], [-0.70, 3.00, 3.00]],
    [[-3.00, -3.00, -0.80], [3.00, 3.00, -0.75]],
    [[-0.45, -0.60, 0.00], [-0.20, -0.30, 0.35]],
];

/// Standard deviation of depth, metres at 1 m; it grows with the square of the distance.
const NOISE_M: f64 = 0.002;
/// Share of pixels without depth.
const HOLES: f64 = 0.01;

/// One depth image with the joints it is recorded with.
#[derive(Clone)]
pub struct Shot {
    pub joints: [f64; 6],
    /// Metres, 0 where there is none; row by row.
    pub depth_m: Vec<f32>,
    /// The arm's pixels.
    pub mask: Vec<bool>,
}

static LINKS: LazyLock<(Robot, Vec<(usize, TriangleMesh)>)> = LazyLock::new(|| {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../eyebolt/tests/newcomer/arm.urdf");
    let robot = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap();
    let links = robot.links.iter().enumerate();
    let meshes =
        links.map(|(index, link)| (index, link_mesh(link, Prefer::Visual).unwrap().unwrap()));
    let meshes = meshes.collect();
    (robot, meshes)
});

/// What the camera sees with the arm at `joints`; `seed` is that of the noise.
pub fn shot(joints: [f64; 6], seed: u64) -> Shot {
    let raster = draw(joints);
    let width = CAMERA.width() as usize;
    let mut random = Random(seed);
    let pixels = 0..CAMERA.pixel_count();
    let depth = pixels.clone().map(|at| {
        let room = room_depth_m((at % width) as f64, (at / width) as f64);
        let z = raster.depth_m(at).map_or(room, |arm| f64::from(arm).min(room));
        let noisy = z + NOISE_M * z * z * random.normal();
        // Outside the room there is nothing to see.
        if random.uniform() < HOLES || !z.is_finite() { 0.0 } else { noisy as f32 }
    });
    let depth_m = depth.collect();
    let mask = pixels.map(|at| {
        let room = room_depth_m((at % width) as f64, (at / width) as f64);
        raster.depth_m(at).is_some_and(|arm| f64::from(arm) < room)
    });
    Shot { joints, depth_m, mask: mask.collect() }
}

/// All of [`JOINTS`].
pub fn shots() -> Vec<Shot> {
    JOINTS.iter().zip(1..).map(|(joints, seed)| shot(*joints, seed)).collect()
}

fn draw(joints: [f64; 6]) -> Raster {
    let (robot, meshes) = &*LINKS;
    let named = JOINT_NAMES.iter().zip(joints).map(|(name, angle)| ((*name).to_owned(), angle));
    let positions: JointPositions = named.collect();
    let poses = robot.arm(None, None).unwrap().link_poses(&positions).unwrap();
    let posed = meshes.iter().map(|(link, mesh)| PosedMesh {
        mesh,
        camera_from_link: *CAMERA_FROM_BASE * poses[*link].unwrap(),
        link: 0,
    });
    let mut raster = Raster::new(&CAMERA);
    raster.draw(&CAMERA, &posed.collect::<Vec<PosedMesh<'_>>>());
    raster
}

/// Depth at which the ray of pixel `u`, `v` meets the room; infinite if it does not.
fn room_depth_m(u: f64, v: f64) -> f64 {
    let ray = Vector3::new((u - CAMERA.cx()) / CAMERA.fx(), (v - CAMERA.cy()) / CAMERA.fy(), 1.0);
    let base_from_camera = CAMERA_FROM_BASE.inverse();
    let (from, along) =
        (base_from_camera.point(&Point3::origin()), base_from_camera.direction(&ray));
    let depths = ROOM.iter().filter_map(|[low, high]| {
        let (mut enters, mut leaves) = (0.0, f64::INFINITY);
        for axis in 0..3 {
            let at = |plane: f64| (plane - from[axis]) / along[axis];
            let (a, b) = (at(low[axis]), at(high[axis]));
            (enters, leaves) = (a.min(b).max(enters), a.max(b).min(leaves));
        }
        (enters < leaves).then_some(enters)
    });
    depths.fold(f64::INFINITY, f64::min)
}

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to 1.
    fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Of mean 0 and variance 1, near enough.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

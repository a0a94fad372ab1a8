//! An arm of three links, and what a camera sees of it.

use crate::shapes::{cuboid, cylinder, joined};
use eyebolt_geometry::{
    Base, Camera, DepthImage, Distortion, Link, Mask, PinholeCamera, RayTable, Transform,
};
use eyebolt_registration::{ArmJoint, ArmLink, ArmModel, JointAxis, LinkModel, Posture, View};
use eyebolt_render::{PosedMesh, Raster};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use std::sync::{Arc, LazyLock};

pub static CAMERA: LazyLock<PinholeCamera> = LazyLock::new(|| {
    PinholeCamera::new(320, 240, 280.0, 281.0, 161.3, 118.2, Distortion::None).unwrap()
});
pub static RAYS: LazyLock<RayTable> = LazyLock::new(|| RayTable::new(&CAMERA));

/// The links' meshes as they are drawn in the images, link frames.
static MESHES: LazyLock<[TriangleMesh; 3]> = LazyLock::new(|| {
    let foot = joined(&[cylinder(0.08, 0.25, 32), cuboid([0.1, 0.08, 0.06], [0.09, 0.0, 0.05])]);
    let upper = joined(&[
        cuboid([0.1, 0.08, 0.42], [0.0, 0.0, 0.17]),
        cuboid([0.06, 0.1, 0.08], [0.0, 0.07, 0.1]),
    ]);
    let fore = joined(&[cylinder(0.05, 0.3, 32), cuboid([0.16, 0.06, 0.1], [0.03, 0.0, 0.33])]);
    [foot, upper, fore]
});

pub static ARM: LazyLock<ArmModel> = LazyLock::new(|| {
    let links = ["foot", "upper", "fore"].iter().zip(MESHES.iter());
    let link = |(name, mesh): (&&str, &TriangleMesh)| ArmLink {
        name: (*name).to_owned(),
        model: Arc::new(LinkModel::build(mesh)),
    };
    let carried = [("turn", 1), ("shoulder", 1), ("elbow", 2), ("twist", 2)];
    let joint = |(name, first): (&str, usize)| ArmJoint {
        name: name.to_owned(),
        carries: (0..3).map(|link| link >= first).collect(),
        defines_base: false,
    };
    ArmModel::new(links.map(link).collect()).with_joints(carried.map(joint).to_vec())
});

/// Four configurations: turn of the foot, shoulder, elbow, turn of the fore arm, radians.
pub const JOINTS: [[f64; 4]; 4] =
    [[0.0, 0.3, 1.3, 0.2], [1.1, -0.4, 1.6, 1.0], [-1.2, 0.6, 0.8, -0.9], [2.4, 0.2, -1.2, 2.0]];

pub static POSTURES: LazyLock<Vec<Posture>> =
    LazyLock::new(|| JOINTS.iter().map(posture).collect());

/// Where the joints put the links.
pub fn posture(&[turn, shoulder, elbow, twist]: &[f64; 4]) -> Posture {
    let along = |z: f64| Isometry3::translation(0.0, 0.0, z);
    let (about_y, about_z) = (
        |angle: f64| Isometry3::rotation(Vector3::y() * angle),
        |angle: f64| Isometry3::rotation(Vector3::z() * angle),
    );
    let turned = along(0.28) * about_z(turn);
    let upper = turned * about_y(shoulder);
    let bent = upper * along(0.36) * about_y(elbow);
    let fore = bent * about_z(twist) * along(0.03);
    let poses = [Isometry3::identity(), upper, fore];
    let axes = [(turned, Vector3::z_axis()), (upper, Vector3::y_axis())]
        .into_iter()
        .chain([(bent, Vector3::y_axis()), (fore, Vector3::z_axis())])
        .map(|(at, axis)| JointAxis {
            through_in_base: at * Point3::origin(),
            along_in_base: at.rotation * axis,
        });
    Posture::new(&ARM, poses.map(Transform::<Base, Link>::from_isometry).to_vec())
        .with_axes(axes.collect())
}

/// The pose of a camera at `from` (base frame) that looks at `at`, rolled by `roll`.
pub fn looking(from: Vector3<f64>, at: Vector3<f64>, roll: f64) -> Transform<Camera, Base> {
    let forward = at - from;
    let rotation = UnitQuaternion::face_towards(&forward, &-Vector3::z())
        * UnitQuaternion::new(Vector3::z() * roll);
    Transform::<Base, Camera>::from_parts(from, rotation).inverse()
}

/// What a camera saw of one configuration.
pub struct Scene {
    pub posture: &'static Posture,
    pub depth: DepthImage,
    pub mask: Mask,
}

impl Scene {
    pub fn view(&self) -> View<'_> {
        View {
            camera: &CAMERA,
            depth: &self.depth,
            depth_factor: 1.0,
            mask: Some(&self.mask),
            posture: self.posture,
        }
    }

    /// Points of the pixels at least `rim` pixels inside the mask, on every `stride`-th row and
    /// column.
    pub fn points(&self, rim: u32, stride: usize) -> Vec<Point3<f32>> {
        let inside = self.mask.eroded(rim);
        let (width, depth) = (CAMERA.width() as usize, self.depth.depth_m());
        let chosen = (0..depth.len()).filter(|at| {
            let on_grid = (at % width) % stride == 0 && (at / width) % stride == 0;
            on_grid && inside.as_slice()[*at] && depth[*at] > 0.0
        });
        chosen.map(|at| RAYS.point(at, depth[at])).collect()
    }
}

/// All configurations before a wall at 2.6 m. What stands beside the arm counts as the arm.
pub fn scenes(truth: &Transform<Camera, Base>, beside: Option<&TriangleMesh>) -> Vec<Scene> {
    POSTURES.iter().map(|posture| scene(truth, posture, beside)).collect()
}

fn scene(
    camera_from_base: &Transform<Camera, Base>,
    posture: &'static Posture,
    beside: Option<&TriangleMesh>,
) -> Scene {
    let links = MESHES.iter().zip(posture.base_from_link());
    let mut meshes: Vec<PosedMesh<'_>> = links
        .map(|(mesh, pose)| PosedMesh {
            mesh,
            camera_from_link: *camera_from_base * *pose,
            link: 0,
        })
        .collect();
    let at_base = Transform::<Camera, Link>::from_isometry(*camera_from_base.isometry());
    meshes.extend(beside.map(|mesh| PosedMesh { mesh, camera_from_link: at_base, link: 1 }));
    let mut raster = Raster::new(&CAMERA);
    raster.draw(&CAMERA, &meshes);
    let mut depth_m = raster.to_depth_image().into_depth_m();
    let set = depth_m.iter().map(|z| *z > 0.0).collect();
    depth_m.iter_mut().filter(|z| **z == 0.0).for_each(|z| *z = 2.6);
    Scene {
        posture,
        depth: DepthImage::new(320, 240, depth_m).unwrap(),
        mask: Mask::new(320, 240, set).unwrap(),
    }
}

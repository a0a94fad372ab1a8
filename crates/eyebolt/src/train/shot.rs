//! Images to learn from, made as they are needed.

use super::actor::{Actor, Pose};
use super::corrupt::corrupt;
use super::error::TrainError;
use super::invented::invented_arm;
use super::scenery::scenery;
use crate::segment::{ARM, BACKGROUND, END_EFFECTOR, Thinned};
use eyebolt_geometry::{
    Base, Camera, Distortion, EndEffector, Link, PinholeCamera, RayTable, Transform,
};
use eyebolt_render::{Random, Raster, RayScene, SceneMesh};
use eyebolt_robot::{Body, JointPositions, Prefer, Shape, TriangleMesh, link_mesh};
use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3};

/// The label of a tool, a cable, a bracket on the arm that no description has: neither answer is wrong.
pub const IGNORE: u8 = 255;

/// Whose images.
pub enum Cast {
    /// Of one of these arms.
    Known(Vec<Actor>),
    /// Of arms that nobody built, and in one of so many images of a known one.
    Any {
        /// Known ones, too.
        known: Vec<Actor>,
        /// Share of the images that are of a known one.
        share_known: f64,
    },
}

/// An image with the truth about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// What the camera saw, its faults included.
    pub image: Thinned,
    /// Of each pixel: [`BACKGROUND`], [`ARM`], [`END_EFFECTOR`] or [`IGNORE`].
    pub label: Vec<u8>,
    /// Pose of the end-effector.
    pub camera_from_end_effector: Transform<Camera, EndEffector>,
    /// Joints of the arm, fingers included.
    pub joints: JointPositions,
}

/// What images are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Pixels in a row.
    pub columns: usize,
    /// Whether the camera looks at the end-effector, from near, instead of at the arm.
    pub at_end_effector: bool,
    /// Whether depth is what a camera makes of it, or as it is.
    pub faults: bool,
}

impl Framing {
    /// The arm in its room, as a segmentation sees it.
    pub const ARM: Self = Self { columns: 160, at_end_effector: false, faults: true };
    /// The part of an image with the end-effector.
    pub const AT_END_EFFECTOR: Self = Self { columns: 112, at_end_effector: true, faults: true };
}

/// Images drawn until one shows the arm.
const TRIES: u64 = 40;
/// Share of the image that the arm takes at least, and how often it may be less.
const LEAST_SHARE: f64 = 0.01;
const NOTHING: f64 = 0.02;

impl Cast {
    /// Image `index` of the stream `random`, the same whatever was drawn before.
    ///
    /// # Errors
    ///
    /// The arm is in none of many images.
    pub fn shot(&self, random: Random, framing: Framing) -> Result<Shot, TrainError> {
        for attempt in 0..TRIES {
            let random = random.at(attempt);
            let mut style = random.at(0);
            let made;
            let actor = match self {
                Self::Known(actors) => &actors[style.index(actors.len())],
                Self::Any { known, share_known } if style.uniform() < *share_known => {
                    &known[style.index(known.len())]
                }
                Self::Any { .. } => {
                    made = Actor::of_plain_shapes(invented_arm(random.at(1))?)?;
                    &made
                }
            };
            if let Some(shot) = shot_of(actor, random.at(2), framing) {
                return Ok(shot);
            }
        }
        Err(TrainError::NothingToSee { tries: TRIES })
    }
}

fn shot_of(actor: &Actor, random: Random, framing: Framing) -> Option<Shot> {
    let mut style = random.at(0);
    let pose = any_pose(actor, &mut random.at(1))?;
    let look = if framing.at_end_effector { look_at_end_effector } else { look_at_arm };
    let (camera, base_from_camera) = look(actor, &pose, &mut style, framing.columns);
    let (mut image, label) =
        draw(actor, &pose, &camera, &base_from_camera, framing.at_end_effector, random.at(2));
    let count = |of: &dyn Fn(u8) -> bool| label.iter().filter(|label| of(**label)).count() as f64;
    let share = if framing.at_end_effector {
        count(&|label| label == END_EFFECTOR)
    } else {
        count(&|label| label == ARM || label == END_EFFECTOR)
    } / label.len() as f64;
    let nothing = !framing.at_end_effector && style.uniform() < NOTHING;
    let nearest = image.seen().map(|at| image.depth_m[at]).fold(f32::INFINITY, f32::min);
    if (share < LEAST_SHARE && !nothing) || nearest < 0.2 {
        return None;
    }
    if framing.faults {
        corrupt(&mut image, &label, random.at(3));
    }
    let camera_from_end_effector = base_from_camera.inverse() * pose.base_from_end_effector;
    Some(Shot { image, label, camera_from_end_effector, joints: pose.joints })
}

/// A posture that does not sink into what the arm stands on, if there is one among a few.
fn any_pose(actor: &Actor, random: &mut Random) -> Option<Pose> {
    const SINKS_M: f64 = -0.05;
    let mut poses = (0..12).filter_map(|_| actor.pose(actor.any_joints(random)));
    poses.find(|pose| actor.lowest_m(pose) > SINKS_M)
}

/// A camera of usual shape and angle of view, somewhere around, with the arm in view.
fn look_at_arm(
    actor: &Actor,
    pose: &Pose,
    random: &mut Random,
    columns: usize,
) -> (PinholeCamera, Transform<Base, Camera>) {
    let rows = if random.uniform() < 0.4 { columns * 9 / 16 } else { columns * 3 / 4 };
    let half_view = random.between(24.0, 46.0).to_radians();
    let focal = 0.5 * columns as f64 / half_view.tan();
    let middle = [columns, rows]
        .map(|size| 0.5 * (size as f64 - 1.0) + size as f64 * 0.02 * random.normal());
    let camera = camera([columns, rows], focal, middle);
    let tip = pose.base_from_end_effector.translation_m();
    let stray = 0.15 * actor.reach_m;
    let at = tip * random.uniform() + Vector3::from_fn(|_, _| stray * random.normal());
    let distance = spread_evenly(random, 0.45, 3.6).max(0.5 * actor.reach_m);
    (camera, from_anywhere(random, at, distance))
}

/// The part of an image of some camera that shows the end-effector.
fn look_at_end_effector(
    actor: &Actor,
    pose: &Pose,
    random: &mut Random,
    columns: usize,
) -> (PinholeCamera, Transform<Base, Camera>) {
    let extent = actor.end_effector_extent_m();
    let distance = spread_evenly(random, 0.4, 2.2).max(2.0 * extent);
    // As many pixels as real cameras give it at that distance.
    let focal = random.between(380.0, 750.0).min(0.9 * columns as f64 * distance / extent);
    let middle = pose.base_from_end_effector.point(&actor.end_effector_middle());
    let base_from_axis = from_anywhere(random, middle.coords, distance);
    // Beside the optical axis of the whole image.
    let aside = [0, 1].map(|_| 0.25 * random.normal());
    let turn = Rotation3::from_euler_angles(aside[0], aside[1], 0.0);
    let turn = Transform::<Camera, Camera>::from_parts(
        Vector3::zeros(),
        UnitQuaternion::from_rotation_matrix(&turn),
    );
    let toward = turn.inverse().direction(&Vector3::z());
    let half = 0.5 * (columns as f64 - 1.0);
    let at = [toward.x, toward.y].map(|slope| half - focal * slope / toward.z);
    (camera([columns, columns], focal, at), base_from_axis * turn)
}

fn camera([columns, rows]: [usize; 2], focal: f64, [cx, cy]: [f64; 2]) -> PinholeCamera {
    let (width, height) = (columns as u32, rows as u32);
    let camera = PinholeCamera::new(width, height, focal, focal, cx, cy, Distortion::None);
    camera.expect("a focal length above 0, and a few columns")
}

/// From `low` to `high`, each octave as often.
fn spread_evenly(random: &mut Random, low: f64, high: f64) -> f64 {
    (low / high).powf(random.uniform()) * high
}

/// A camera so far from `at` that looks at it from any side, mostly upright and from above.
fn from_anywhere(random: &mut Random, at: Vector3<f64>, distance: f64) -> Transform<Base, Camera> {
    let around = random.between(0.0, std::f64::consts::TAU);
    let toward = Vector3::new(around.cos(), around.sin(), random.between(-0.25, 1.0)).normalize();
    let roll = if random.uniform() < 0.2 { 3.0 * random.normal() } else { 0.12 * random.normal() };
    let looking = Rotation3::face_towards(&-toward, &-Vector3::z());
    let roll = Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
    let rotation = UnitQuaternion::from_rotation_matrix(&(looking * roll));
    Transform::from_parts(at + distance * toward, rotation)
}

/// Ideal depth of the arm before what stands around, and whose each pixel is.
fn draw(
    actor: &Actor,
    pose: &Pose,
    camera: &PinholeCamera,
    base_from_camera: &Transform<Base, Camera>,
    at_end_effector: bool,
    random: Random,
) -> (Thinned, Vec<u8>) {
    let mut raster = Raster::new(camera);
    actor.draw(&mut raster, camera, pose, &base_from_camera.inverse());
    let rays = RayTable::new(camera);
    let mut depth_m = Vec::new();
    if at_end_effector {
        depth_m = backdrop(&rays, &raster, &mut random.at(0));
    } else {
        scenery(random.at(0), base_from_camera).depth(&rays, base_from_camera, &mut depth_m);
    }
    let mut label = vec![BACKGROUND; depth_m.len()];
    for at in raster.pixels() {
        let (Some(z), Some(link)) = (raster.depth_m(at), raster.link(at)) else { continue };
        if depth_m[at] == 0.0 || z < depth_m[at] {
            depth_m[at] = z;
            let hand = actor.is_end_effector[usize::from(link)];
            label[at] = if hand { END_EFFECTOR } else { ARM };
        }
    }
    let parts = undescribed(actor, pose, random.at(1));
    if !parts.is_empty() {
        let meshes = parts
            .iter()
            .map(|(mesh, base_from_mesh)| SceneMesh { mesh, base_from_mesh: *base_from_mesh });
        let mut in_front = Vec::new();
        let scene = RayScene::new(&meshes.collect::<Vec<_>>());
        scene.depth(&rays, base_from_camera, &mut in_front);
        for (at, z) in in_front.into_iter().enumerate().filter(|(_, z)| *z > 0.0) {
            if depth_m[at] == 0.0 || z < depth_m[at] {
                (depth_m[at], label[at]) = (z, IGNORE);
            }
        }
    }
    let (width, height) = (camera.width() as usize, camera.height() as usize);
    let rays = crate::segment::rays(camera, 1);
    (Thinned { width, height, step: 1, depth_m, rays }, label)
}

/// A plane somewhere behind the middle of what is drawn: of the room, no more is seen beside an
/// end-effector from near. Or nothing, where that is out of range.
fn backdrop(rays: &RayTable, raster: &Raster, random: &mut Random) -> Vec<f32> {
    const NOTHING_BEHIND: f64 = 0.2;
    let none = vec![0.0; rays.rays().len()];
    let (columns, rows) = raster.drawn();
    let middle = (rows.start + rows.end) / 2 * raster.width() + (columns.start + columns.end) / 2;
    let (Some(z), true) = (raster.depth_m(middle), random.uniform() >= NOTHING_BEHIND) else {
        return none;
    };
    let [slope_x, slope_y] = [0, 1].map(|_| 0.7 * random.normal() as f32);
    let [x0, y0] = rays.rays()[middle];
    let behind = z + spread_evenly(random, 0.03, 2.0) as f32;
    // Through the point behind the middle, with normal (slope_x, slope_y, -1).
    let at = |[x, y]: &[f32; 2]| {
        let z = behind * (1.0 - slope_x * x0 - slope_y * y0) / (1.0 - slope_x * x - slope_y * y);
        if z.is_finite() && (0.0..20.0).contains(&z) { z } else { 0.0 }
    };
    rays.rays().iter().map(at).collect()
}

/// Tools, brackets and cables that a description lacks.
fn undescribed(
    actor: &Actor,
    pose: &Pose,
    random: Random,
) -> Vec<(TriangleMesh, Transform<Base, Link>)> {
    const SOME: f64 = 0.35;
    let mut style = random.at(0);
    if style.uniform() >= SOME {
        return Vec::new();
    }
    let count = 1 + style.index(3);
    let part = |index: u64| {
        let mut random = random.at(1).at(index);
        let on = random.index(actor.meshes.len());
        let (low, high) = actor.meshes[on].bounds()?;
        let corner = |axis: usize, random: &mut Random| {
            random.between(f64::from(low[axis]), f64::from(high[axis]))
        };
        let at =
            Point3::new(corner(0, &mut random), corner(1, &mut random), corner(2, &mut random));
        let axis = Vector3::new(random.normal(), random.normal(), random.normal());
        let turn = UnitQuaternion::new(axis.normalize() * random.between(0.0, 3.1));
        let shape = match random.index(3) {
            0 => Shape::Box { size: [0, 1, 2].map(|_| random.between(0.02, 0.12)) },
            1 => Shape::Cylinder {
                radius: random.between(0.004, 0.03),
                length: random.between(0.05, 0.3),
            },
            _ => Shape::Capsule {
                radius: random.between(0.004, 0.02),
                length: random.between(0.1, 0.4),
            },
        };
        let link_from_body = Transform::from_parts(at.coords, turn);
        let link = eyebolt_robot::Link {
            name: String::new(),
            parent: None,
            visuals: vec![Body { link_from_body, shape }],
            collisions: Vec::new(),
        };
        Some((link_mesh(&link, Prefer::Visual).ok()??, pose.base_from_link[on]))
    };
    (0..count as u64).filter_map(part).collect()
}

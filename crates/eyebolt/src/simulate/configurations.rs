//! Configurations worth recording: free, in view, turned toward the camera, far from each other.

use super::body::ArmBody;
use super::error::SimulateError;
use super::rejected::Rejected;
use crate::record::most_spread;
use eyebolt_geometry::{Base, Camera, PinholeCamera, Transform};
use eyebolt_registration::Posture;
use eyebolt_render::{PosedMesh, Random, Raster, RayScene};
use eyebolt_robot::JointPositions;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// An arm at rest.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub(super) joints: JointPositions,
    pub(super) posture: Posture,
}

/// What looks on.
pub(crate) struct Onlooker<'a> {
    pub(crate) camera: &'a PinholeCamera,
    pub(crate) camera_from_base: Transform<Camera, Base>,
    /// Nearest and farthest depth that it tells, metres.
    pub(crate) range_m: [f64; 2],
    /// What it multiplies true depth by, and adds to it, metres.
    pub(crate) told_m: [f64; 2],
    /// What may stand between it and the arm.
    pub(crate) room: &'a RayScene,
}

/// Why one configuration is not fit.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    OutOfView,
    Bumping,
    Hidden,
}

/// Good configurations gathered for each that is wanted, so that there is something to choose from,
/// but no more beyond those wanted than this.
const CHOICE: usize = 8;
const MOST_SPARE: usize = 150;
/// Configurations drawn at most, at each anchor, and at a time.
const MOST_DRAWN: u64 = 200_000;
const MOST_DRAWN_ALIKE: u64 = 20_000;
const FIRST_LOOK: u64 = 20_480;
const BATCH: u64 = 512;
/// Places that the joints nearer to the base are tried at where they are held.
const ANCHORS: u64 = 12;

/// Which configurations are wanted.
struct Wanted {
    count: usize,
    /// Joints that stay where they are.
    held: JointPositions,
    most_drawn: u64,
}

/// `count` configurations of `body` that `onlooker` sees well, as different as they can be.
pub(super) fn choose(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    count: usize,
    random: Random,
) -> Result<Vec<Pose>, SimulateError> {
    let held = JointPositions::default();
    choose_wanted(body, onlooker, &Wanted { count, held, most_drawn: MOST_DRAWN }, random)
}

/// As [`choose`], with only the last half of the joints moving.
pub(super) fn choose_alike(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    count: usize,
    random: Random,
) -> Result<Vec<Pose>, SimulateError> {
    let names = body.arm.required_joints();
    let held = &names[..names.len().div_ceil(2)];
    let alike = |place: u64| {
        let anchor = choose(body, onlooker, 1, random.at(place))?;
        let at = |name: &&str| Some(((*name).to_owned(), anchor.first()?.joints.get(name)?));
        let held = held.iter().filter_map(at).collect();
        let wanted = Wanted { count, held, most_drawn: MOST_DRAWN_ALIKE };
        choose_wanted(body, onlooker, &wanted, random.at(place).at(0))
    };
    // The others only where this one leaves the last joints no room.
    let first = alike(0);
    (1..ANCHORS).fold(first, |found, place| found.or_else(|_| alike(place)))
}

fn choose_wanted(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    wanted: &Wanted,
    random: Random,
) -> Result<Vec<Pose>, SimulateError> {
    let Wanted { count, held, most_drawn } = wanted;
    let count = *count;
    let enough = (CHOICE * count).min(count + MOST_SPARE);
    let mut found: Vec<Pose> = Vec::new();
    let mut rejected = Rejected::default();
    // Where the first look finds nothing, the others hardly will: another view is what helps.
    let hopeless = |found: &[Pose], drawn: u64| found.is_empty() && drawn >= FIRST_LOOK;
    while found.len() < enough && rejected.drawn < *most_drawn && !hopeless(&found, rejected.drawn)
    {
        let batch = (rejected.drawn..rejected.drawn + BATCH).into_par_iter().map_init(
            || [Raster::new(onlooker.camera), Raster::new(onlooker.camera)],
            |rasters, place| {
                let drawn = body.any_joints(&mut random.at(place));
                let joint =
                    |(name, at): (&str, f64)| (name.to_owned(), held.get(name).unwrap_or(at));
                good(body, onlooker, drawn.iter().map(joint).collect(), rasters)
            },
        );
        for drawn in batch.collect::<Vec<_>>() {
            match drawn {
                Ok(pose) => found.push(pose),
                Err(Fault::OutOfView) => rejected.out_of_view += 1,
                Err(Fault::Bumping) => rejected.bumping += 1,
                Err(Fault::Hidden) => rejected.hidden += 1,
            }
        }
        rejected.drawn += BATCH;
    }
    if found.len() < count {
        return Err(SimulateError::Unfit { found: found.len(), wanted: count, rejected });
    }
    found.truncate(enough);
    let poses: Vec<_> = found.iter().map(|pose| pose.posture.base_from_link().to_vec()).collect();
    Ok(most_spread(&poses, count).into_iter().map(|index| found[index].clone()).collect())
}

/// The configuration at `joints`, if it is a good one.
fn good(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    joints: JointPositions,
    rasters: &mut [Raster; 2],
) -> Result<Pose, Fault> {
    if !has_hand_in_view(body, onlooker, &joints) {
        return Err(Fault::OutOfView);
    }
    let posture = body.posture(&joints).ok_or(Fault::OutOfView)?;
    let eye = onlooker.camera_from_base.inverse().point(&Point3::origin());
    if body.bumps(&posture, &eye) {
        return Err(Fault::Bumping);
    }
    if !shows_hand(body, onlooker, &posture, rasters) || behind_room(body, onlooker, &posture, &eye)
    {
        return Err(Fault::Hidden);
    }
    Ok(Pose { joints, posture })
}

/// Whether the end-effector's frame is in view and in range.
pub(crate) fn has_hand_in_view(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    joints: &JointPositions,
) -> bool {
    let in_range = |hand: &Point3<f64>| {
        let ([near, far], [scale, offset_m]) = (onlooker.range_m, onlooker.told_m);
        (1.1 * near..0.95 * far).contains(&(scale * hand.z + offset_m))
    };
    let hand = body.end_effector(joints, &onlooker.camera_from_base).filter(in_range);
    let pixel = hand.and_then(|hand| onlooker.camera.project(&hand));
    pixel.is_some_and(|pixel| onlooker.camera.contains(&pixel))
}

/// Whether the room hides some of the arm, as a camera below the table has it.
fn behind_room(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    posture: &Posture,
    eye: &Point3<f64>,
) -> bool {
    const HIDDEN: f64 = 0.1;
    const MOST_POINTS: usize = 20_000;
    let points: Vec<Point3<f32>> = body.surface(posture).collect();
    // Of a robot of very many links some points tell.
    let points: Vec<Point3<f32>> =
        points.iter().copied().step_by(points.len().div_ceil(MOST_POINTS)).collect();
    let hidden = onlooker.room.visible_from(*eye, &points).iter().filter(|sees| !**sees).count();
    hidden as f64 > HIDDEN * points.len() as f64
}

/// Share of what is seen of the end-effector alone that the arm leaves in sight.
const IN_SIGHT: f64 = 0.6;
/// Area seen of the end-effector, of the largest side of its box: turned toward the camera.
const TURNED: f64 = 0.3;
/// No part of the end-effector is nearer to the border of the image, pixels.
const BORDER_PX: f64 = 4.0;

/// Whether the whole end-effector is in the image, not much hidden, and not seen from its thin side.
pub(crate) fn shows_hand(
    body: &ArmBody,
    onlooker: &Onlooker<'_>,
    posture: &Posture,
    [whole, alone]: &mut [Raster; 2],
) -> bool {
    let meshes = posture.meshes(&body.model, &onlooker.camera_from_base);
    let is_hand = |link: u8| body.is_end_effector[usize::from(link)];
    let hand: Vec<PosedMesh<'_>> = meshes.iter().filter(|m| is_hand(m.link)).copied().collect();
    let inside = hand.iter().all(|posed| {
        posed
            .mesh
            .vertices
            .iter()
            .all(|vertex| in_image(onlooker, &posed.camera_from_link.point(&vertex.cast())))
    });
    if !inside {
        return false;
    }
    alone.draw(onlooker.camera, &hand);
    if alone.pixels().next().is_none() {
        return false;
    }
    whole.draw(onlooker.camera, &before(body, &meshes, &hand));
    let seen = whole.pixels().filter(|at| whole.link(*at).is_some_and(is_hand)).count();
    let focal = onlooker.camera.fx() * onlooker.camera.fy();
    let area = alone.pixels().filter_map(|at| alone.depth_m(at)).map(|z| f64::from(z * z) / focal);
    seen as f64 >= IN_SIGHT * alone.pixels().count() as f64
        && area.sum::<f64>() >= TURNED * largest_side(&hand)
}

/// Those of `meshes` that may hide some of `hand`: a robot has limbs that are nowhere near it in the image.
fn before<'m>(
    body: &ArmBody,
    meshes: &[PosedMesh<'m>],
    hand: &[PosedMesh<'m>],
) -> Vec<PosedMesh<'m>> {
    // What is drawn is simpler than what the spheres are around.
    const SIMPLER_M: f64 = 0.002;
    let around = |posed: &PosedMesh<'_>| {
        let (centre, radius_m) = body.sphere(usize::from(posed.link));
        let centre = posed.camera_from_link.point(&centre.cast()).coords;
        // As the camera sees it: a direction, and the sine of half of the angle that it fills.
        (centre.normalize(), (f64::from(radius_m) + SIMPLER_M) / centre.norm())
    };
    let hands: Vec<_> = hand.iter().map(around).collect();
    let overlaps = |posed: &&PosedMesh<'m>| {
        let (along, sine) = around(posed);
        hands.iter().any(|(hand, hand_sine)| {
            let angle = |sine: f64| if sine < 1.0 { sine.asin() } else { PI };
            along.angle(hand) <= angle(sine) + angle(*hand_sine)
        })
    };
    meshes.iter().filter(overlaps).copied().collect()
}

fn in_image(onlooker: &Onlooker<'_>, point: &Point3<f64>) -> bool {
    let (width, height) = (onlooker.camera.width(), onlooker.camera.height());
    let within = |at: f64, size: u32| (BORDER_PX..f64::from(size) - BORDER_PX).contains(&at);
    let pixel = onlooker.camera.project(point);
    pixel.is_some_and(|pixel| within(pixel.x, width) && within(pixel.y, height))
}

/// Area of the largest side of the box around `meshes`, along the axes of the first, square metres.
fn largest_side(meshes: &[PosedMesh<'_>]) -> f64 {
    let Some(first) = meshes.first() else { return 0.0 };
    let first_from_camera = first.camera_from_link.inverse();
    let vertices = meshes.iter().flat_map(|posed| {
        let to_first = first_from_camera.isometry() * posed.camera_from_link.isometry();
        posed.mesh.vertices.iter().map(move |vertex| (to_first * vertex.cast::<f64>()).coords)
    });
    let nothing = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let (low, high) = vertices.fold(nothing, |(low, high), v| (low.inf(&v), high.sup(&v)));
    let mut size: [f64; 3] = (high - low).into();
    size.sort_by(f64::total_cmp);
    size[1] * size[2]
}

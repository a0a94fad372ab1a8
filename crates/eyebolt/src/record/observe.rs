//! From frames and an arm to observations.

use super::background;
use super::configurations::{Group, Groups, group_frames};
use super::error::RecordError;
use super::joints;
use super::options::RecordOptions;
use super::projection::{Projection, find};
use super::reader::{Reader, first_frame};
use super::shapes::shapes;
use super::spread::most_spread;
use crate::depth_noise::DepthNoise;
use crate::joint_limits::WorstOutside;
use crate::observations::{Configuration, Observations};
use eyebolt_geometry::{Base, Link, RayTable, Transform};
use eyebolt_recording::FrameSource;
use eyebolt_registration::{ArmModel, LinkCache, Posture};
use eyebolt_robot::Arm;
use rayon::prelude::*;

/// Poses `arm` in every frame of `source`, gets the shapes of its links from `cache` or their
/// meshes, and reads the frames of each configuration.
///
/// Depth is read of no more frames than tell something new, one configuration after the other, so
/// that memory does not grow with the length of the recording.
///
/// # Errors
///
/// The first thing that cannot be read or does not fit, in the order of the frames.
pub fn observe(
    source: &dyn FrameSource,
    arm: &Arm,
    cache: &LinkCache,
    options: &RecordOptions,
) -> Result<Observations, RecordError> {
    let mut outside = WorstOutside::default();
    let Groups { groups, untold_frames } =
        group_frames(source, arm, |frame, joints| outside.add(arm, frame, joints))?;
    let Some(first) = groups.first() else { return Err(RecordError::NoFrames) };
    let placed = PlacedArm::new(arm, &groups, cache)?;
    let chosen = most_spread(&placed.postures, options.most_configurations);
    let example = first_frame(source, &groups[chosen[0]].frames)?;
    let projection = find(source, &example, options.use_masks)?;
    let rays = RayTable::new(&projection.camera);
    let reader = Reader { source, projection: &projection, rays: &rays, options };
    let configurations = chosen.par_iter().map(|group| {
        let seen = reader.configuration(&groups[*group].frames)?;
        let frames = &groups[*group].frames;
        Ok(Configuration {
            frames: frames.iter().map(|frame| source.frame_names()[*frame].clone()).collect(),
            depth: seen.depth,
            mask: seen.mask,
            base_from_end_effector: groups[*group].first.base_from_end_effector,
            posture: placed.posture(arm, *group, &groups[*group]),
            joints_rad: placed.positions(&groups[*group]),
        })
    });
    // Collected first: of several errors the first is reported, whichever thread met it.
    let configurations: Vec<Result<_, RecordError>> = configurations.collect();
    let configurations = configurations.into_iter().collect::<Result<Vec<_>, _>>()?;
    let background = background::read(source, &projection, &configurations)?;
    let images: Vec<_> = configurations.iter().map(|c| &c.depth).collect();
    let noise = DepthNoise::learn(&images);
    let Projection { camera, optical_from_camera, source: image_source } = projection;
    Ok(Observations {
        camera,
        rays,
        optical_from_camera,
        source: image_source,
        configurations,
        background,
        noise,
        unplaced_joints: first.first.unplaced_joints.clone(),
        outside_limits: outside.of_arm(arm),
        spare_configurations: groups.len() - chosen.len(),
        untold_frames,
        arm: placed.model,
    })
}

/// The arm's shapes, and where every group has them.
struct PlacedArm {
    model: ArmModel,
    /// Joints of the robot that the model's joints are.
    joints: Vec<usize>,
    /// Poses of the model's links, for each group.
    postures: Vec<Vec<Transform<Base, Link>>>,
}

impl PlacedArm {
    fn new(arm: &Arm, groups: &[Group], cache: &LinkCache) -> Result<Self, RecordError> {
        // A link that some frame does not place takes no part in any.
        let placed = |link: &usize| groups.iter().all(|g| g.first.base_from_links[*link].is_some());
        let links = (0..arm.robot().links.len()).filter(|link| arm.is_below_base(*link));
        let (links, model) = shapes(arm, links.filter(placed).collect(), cache)?;
        let poses = |group: &Group| {
            links.iter().filter_map(|link| group.first.base_from_links[*link]).collect()
        };
        let postures = groups.iter().map(poses).collect();
        let hand = arm.end_effector_links();
        let model = model.with_end_effector(links.iter().map(|l| hand.contains(l)).collect());
        let (joints, model) = joints::offered(arm, &links, model);
        Ok(Self { model, joints, postures })
    }

    /// Positions of the model's joints.
    fn positions(&self, group: &Group) -> Vec<f64> {
        let joints = self.model.joints().iter();
        joints.map(|joint| group.first.joints.get(&joint.name).unwrap_or(0.0)).collect()
    }

    fn posture(&self, arm: &Arm, index: usize, group: &Group) -> Posture {
        let axes = joints::axes(arm, &self.joints, &group.first.base_from_links);
        Posture::new(&self.model, self.postures[index].clone()).with_axes(axes)
    }
}

//! What the camera sees of a plan, as a recording.

use super::aftermath::Shot;
use super::encoders::Encoders;
use super::error::SimulateError;
use super::plan::Plan;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use super::static_frames::static_transforms;
use super::timeline::{Event, Timeline, background_stamp_ns};
use super::viewpoint::Viewpoint;
use crate::progress::Progress;
use eyebolt_geometry::{Base, Camera, DepthImage, Transform};
use eyebolt_recording::{CameraMoved, RecordingInfo, RecordingWriter, Truth, WriteError};
use eyebolt_render::{RayScene, Specimen};
use eyebolt_robot::JointPositions;
use std::collections::BTreeMap;
use std::io::{Seek, Write};

/// Name of the simulated camera's frame.
pub(super) const FRAME_ID: &str = "camera_depth_optical_frame";

impl Plan<'_> {
    /// Writes the recording as MCAP to `output`. Memory does not grow with its length.
    ///
    /// # Errors
    ///
    /// A failing `output`, or a `progress` that wants an end.
    pub fn record(
        &self,
        output: impl Write + Seek,
        progress: &dyn Progress,
    ) -> Result<(), SimulateError> {
        let scenario = &self.scenario;
        let arm = scenario.arm;
        let static_transforms = static_transforms(arm.robot(), FRAME_ID);
        let info = RecordingInfo {
            camera: &self.stated_camera,
            camera_frame_id: FRAME_ID,
            in_millimetres: scenario.sensor.in_millimetres,
            static_transforms: &static_transforms,
            urdf: Some(scenario.urdf),
            base: Some(arm.base_name()),
            end_effector: Some(arm.end_effector_name()),
        };
        let mut writer = RecordingWriter::new(output, &info)?;
        let timeline = self.timeline();
        let ways = self.poses.len().saturating_sub(1);
        let total = scenario.backgrounds
            + self.poses.len() * scenario.frames
            + ways * scenario.moving_frames;
        let mut told = |done: usize| progress.advance(done, total).map_err(WriteError::from);
        self.write_backgrounds(&mut writer, &mut told)?;
        let encoders = self.encoders();
        let mut done = 0;
        for (index, pose) in self.poses.iter().enumerate() {
            let before = index.checked_sub(1).map(|before| &self.poses[before].joints);
            let mut resting: Option<Shot> = None;
            let painted = self.painted(index);
            for moment in timeline.moments(index, before, &pose.joints) {
                let Event::Frame { at_rest } = moment.event else {
                    let read = encoders.read(&moment.joints, before, &pose.joints);
                    writer.joints(moment.stamp_ns, &read)?;
                    continue;
                };
                told(scenario.backgrounds + done)?;
                let known = resting.take();
                let shot = known.unwrap_or_else(|| self.look(&moment.joints, index));
                let frame = shot.frame(RandomStream::Frames.of(scenario.seed).at(done as u64));
                writer.depth(self.skewed_ns(moment.stamp_ns), &frame)?;
                if let Some(painted) = painted.as_ref().filter(|_| at_rest) {
                    writer.color(self.skewed_ns(moment.stamp_ns), &painted.frame(done as u64))?;
                }
                resting = at_rest.then_some(shot);
                done += 1;
            }
        }
        writer.truth(&self.truth(&timeline))?;
        writer.finish()?;
        told(total)?;
        Ok(())
    }

    fn timeline(&self) -> Timeline {
        let Scenario { frames, moving_frames, backgrounds, .. } = self.scenario;
        Timeline { frames, moving_frames, backgrounds }
    }

    fn write_backgrounds<W: Write + Seek>(
        &self,
        writer: &mut RecordingWriter<W>,
        told: &mut impl FnMut(usize) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        if self.scenario.backgrounds == 0 {
            return Ok(());
        }
        let frames = self.backgrounds();
        (0..self.scenario.backgrounds).zip(frames).try_for_each(|(index, frame)| {
            told(index)?;
            writer.background(background_stamp_ns(index), &frame)
        })
    }

    /// Frames without the arm, without end.
    pub(super) fn backgrounds(&self) -> impl Iterator<Item = DepthImage> + use<> {
        let scene = self.empty_scene();
        let shot = self.look_at(&scene, &self.base_from_camera, None);
        let random = RandomStream::Frames.of(self.scenario.seed).at(u64::MAX);
        (0..).map(move |index| shot.frame(random.at(index)))
    }

    /// What the camera sees while the arm rests in a configuration.
    pub(super) fn look_at_rest(&self, configuration: usize) -> Shot {
        self.look(&self.poses[configuration].joints, configuration)
    }

    /// What the camera sees with the arm at `joints`, on the way to a configuration or there.
    fn look(&self, joints: &JointPositions, configuration: usize) -> Shot {
        let scene = self.scene_with(joints, configuration);
        self.look_at(&scene, self.pose_at(configuration), Some(configuration))
    }

    /// The scene with the arm at `joints`.
    pub(super) fn scene_with(&self, joints: &JointPositions, configuration: usize) -> RayScene {
        let posture = self.body.posture(joints);
        let posture = posture.expect("the arm was posed with these joints, or others between them");
        self.scene(&self.body.scene_meshes(&posture), joints, configuration)
    }

    fn look_at(
        &self,
        scene: &RayScene,
        base_from_camera: &Transform<Base, Camera>,
        configuration: Option<usize>,
    ) -> Shot {
        let faults = &self.scenario.faults;
        let specimen = Specimen {
            random: RandomStream::Specimen.of(self.scenario.seed),
            depth_scale: faults.depth_scale,
            depth_offset_m: faults.depth_offset_m,
        };
        let exposure = self.scenario.sensor.look(scene, &self.camera, base_from_camera, &specimen);
        self.shoot(scene, base_from_camera, exposure, configuration)
    }

    /// Where the camera is while the arm goes to, and rests in, a configuration.
    pub(super) fn pose_at(&self, configuration: usize) -> &Transform<Base, Camera> {
        let after = configuration >= self.bumped_at();
        self.bumped.as_ref().filter(|_| after).unwrap_or(&self.base_from_camera)
    }

    /// The first configuration after the camera was bumped, if it is.
    fn bumped_at(&self) -> usize {
        self.poses.len().div_ceil(2)
    }

    /// What the recording says of a moment at which depth was taken.
    fn skewed_ns(&self, stamp_ns: i64) -> i64 {
        stamp_ns + (1e9 * self.scenario.faults.time_skew_s) as i64
    }

    pub(super) fn encoders(&self) -> Encoders {
        let Scenario { arm, faults, seed, .. } = &self.scenario;
        Encoders::new(arm, faults, &mut RandomStream::Encoders.of(*seed))
    }

    /// What a calibration should find when the recording begins: where the camera has the base that
    /// the joints speak of. Where the first joint is off that one is turned against the base link.
    pub fn sought_camera_from_base(&self) -> Transform<Camera, Base> {
        self.camera_from_base() * self.encoders().base_from_told_base(self.scenario.arm)
    }

    /// As [`Self::sought_camera_from_base`] after the camera was bumped, if it was.
    pub fn sought_camera_from_base_after(&self) -> Option<Transform<Camera, Base>> {
        let after = self.bumped.filter(|_| self.bumped_at() < self.poses.len())?;
        Some(after.inverse() * self.encoders().base_from_told_base(self.scenario.arm))
    }

    /// How much farther each joint that turns stands than it says, radians.
    pub fn joint_offsets(&self) -> BTreeMap<String, f64> {
        self.encoders().offsets()
    }

    fn truth(&self, timeline: &Timeline) -> Truth {
        let after = self.sought_camera_from_base_after().map(|camera_from_base| CameraMoved {
            stamp_ns: self.skewed_ns(timeline.begin_ns(self.bumped_at())),
            camera_from_base,
        });
        let preset = match self.scenario.viewpoint {
            Viewpoint::Preset(preset) => Some(preset.name.to_owned()),
            Viewpoint::Within(_) => None,
        };
        Truth {
            robot: self.scenario.arm.robot().name.clone(),
            base: self.scenario.arm.base_name().to_owned(),
            sensor: self.scenario.sensor.name.to_owned(),
            preset,
            seed: self.scenario.seed,
            camera_from_base: self.sought_camera_from_base(),
            camera_from_base_after: after.into_iter().collect(),
            faults: self.scenario.faults.named(),
        }
    }
}

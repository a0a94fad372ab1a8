//! What the camera sees of a plan, as a recording.

use super::faults::Encoders;
use super::surroundings::in_place;
use super::timeline::{Event, Moment, background_stamp_ns, moments};
use super::{Choice, Plan, SimulateError};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::{
    CameraMoved, RecordingInfo, RecordingWriter, Truth, WriteError, WriteProgress,
};
use eyebolt_registration::Posture;
use eyebolt_render::{Exposure, RayScene, SceneMesh, Specimen};
use eyebolt_robot::JointPositions;
use std::io::{Seek, Write};

/// Name of the simulated camera's frame.
const FRAME_ID: &str = "camera_depth_optical_frame";

impl Plan<'_> {
    /// Writes the recording as MCAP to `output`. Memory does not grow with its length.
    ///
    /// # Errors
    ///
    /// A failing `output`, or a `progress` that wants an end.
    pub fn record(
        &self,
        output: impl Write + Seek,
        progress: &mut WriteProgress<'_>,
    ) -> Result<(), SimulateError> {
        let scenario = &self.scenario;
        let arm = scenario.arm;
        let info = RecordingInfo {
            camera: &self.stated_camera,
            camera_frame_id: FRAME_ID,
            in_millimetres: scenario.sensor.in_millimetres,
            urdf: Some(scenario.urdf),
            base: Some(arm.base_name()),
            end_effector: Some(arm.end_effector_name()),
        };
        let mut writer = RecordingWriter::new(output, &info)?;
        let joints: Vec<JointPositions> =
            self.poses.iter().map(|pose| pose.joints.clone()).collect();
        let (frames, on_ways) = (scenario.frames, scenario.moving_frames);
        let moments = moments(&joints, frames, on_ways, scenario.backgrounds);
        let total = joints.len() * frames + joints.len().saturating_sub(1) * on_ways;
        let mut done = 0;
        let mut told = |done: usize| match progress(done, total + scenario.backgrounds) {
            std::ops::ControlFlow::Continue(()) => Ok(()),
            std::ops::ControlFlow::Break(()) => Err(WriteError::Stopped),
        };
        self.write_backgrounds(&mut writer)?;
        let encoders =
            Encoders::new(arm, &scenario.faults, &mut Choice::Encoders.of(scenario.seed));
        let mut resting: Option<(usize, Exposure)> = None;
        for moment in &moments {
            match moment.event {
                Event::Joints => {
                    let before = &joints[moment.configuration.saturating_sub(1)];
                    writer.joints(moment.stamp_ns, &encoders.read(&moment.joints, before))?;
                }
                Event::Frame { at_rest } => {
                    told(scenario.backgrounds + done)?;
                    let exposure = match (at_rest, resting.take()) {
                        (Some(index), Some((known, exposure))) if index == known => exposure,
                        _ => self.look(&moment.joints, self.pose_at(moment.configuration)),
                    };
                    let frame = exposure.frame(Choice::Frames.of(scenario.seed).at(done as u64));
                    writer.depth(self.stamp_ns(moment), &frame)?;
                    resting = at_rest.map(|index| (index, exposure));
                    done += 1;
                }
            }
        }
        writer.truth(&self.truth(&moments))?;
        writer.finish()?;
        told(scenario.backgrounds + done)?;
        Ok(())
    }

    fn write_backgrounds<W: Write + Seek>(
        &self,
        writer: &mut RecordingWriter<W>,
    ) -> Result<(), WriteError> {
        if self.scenario.backgrounds == 0 {
            return Ok(());
        }
        let exposure = self.look_at(&[], &self.base_from_camera);
        let random = Choice::Frames.of(self.scenario.seed).at(u64::MAX);
        (0..self.scenario.backgrounds).try_for_each(|index| {
            writer.background(background_stamp_ns(index), &exposure.frame(random.at(index as u64)))
        })
    }

    /// What the camera sees with the arm at `joints`.
    fn look(
        &self,
        joints: &JointPositions,
        base_from_camera: &Transform<Base, Camera>,
    ) -> Exposure {
        let posture: Option<Posture> = self.body.posture(joints);
        let meshes = posture.map(|posture| self.body.scene_meshes(&posture)).unwrap_or_default();
        self.look_at(&meshes, base_from_camera)
    }

    fn look_at(
        &self,
        arm: &[SceneMesh<'_>],
        base_from_camera: &Transform<Base, Camera>,
    ) -> Exposure {
        let around = self.solids.iter().map(in_place);
        let meshes: Vec<SceneMesh<'_>> = arm.iter().copied().chain(around).collect();
        let scene = RayScene::new(&meshes);
        let faults = &self.scenario.faults;
        let specimen = Specimen {
            random: Choice::Specimen.of(self.scenario.seed),
            depth_scale: faults.depth_scale,
            depth_offset_m: faults.depth_offset_m,
        };
        self.scenario.sensor.look(&scene, &self.camera, base_from_camera, &specimen)
    }

    /// Where the camera is while the arm goes to, and rests in, a configuration.
    fn pose_at(&self, configuration: usize) -> &Transform<Base, Camera> {
        let after = configuration >= self.bumped_at();
        self.bumped.as_ref().filter(|_| after).unwrap_or(&self.base_from_camera)
    }

    /// The first configuration after the camera was bumped, if it is.
    fn bumped_at(&self) -> usize {
        self.poses.len().div_ceil(2)
    }

    fn stamp_ns(&self, moment: &Moment) -> i64 {
        moment.stamp_ns + (1e9 * self.scenario.faults.time_skew_s) as i64
    }

    fn truth(&self, moments: &[Moment]) -> Truth {
        let moved = moments.iter().find(|moment| moment.configuration >= self.bumped_at());
        let after = self.bumped.zip(moved).map(|(base_from_camera, moment)| CameraMoved {
            stamp_ns: self.stamp_ns(moment),
            camera_from_base: base_from_camera.inverse(),
        });
        let preset = match self.scenario.viewpoint {
            super::Viewpoint::Preset(preset) => Some(preset.name.to_owned()),
            super::Viewpoint::Within(_) => None,
        };
        Truth {
            robot: self.scenario.arm.robot().name.clone(),
            sensor: self.scenario.sensor.name.to_owned(),
            preset,
            seed: self.scenario.seed,
            camera_from_base: self.camera_from_base(),
            camera_from_base_after: after.into_iter().collect(),
            faults: self.scenario.faults.named(),
        }
    }
}

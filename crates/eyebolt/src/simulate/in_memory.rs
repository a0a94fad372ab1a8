//! What the camera sees of a plan, without a file.

use super::error::SimulateError;
use super::plan::Plan;
use super::random_stream::RandomStream;
use super::record::FRAME_ID;
use eyebolt_geometry::DepthImage;
use eyebolt_recording::{
    FrameSource, InMemory, RecordingError, RobotSection, depth_from_millimetres,
};

impl Plan<'_> {
    /// The frames at rest that [`Self::record`] writes, with their joints, the backgrounds and the
    /// camera as stated.
    ///
    /// Clocks that disagree ([`crate::simulate::Faults::time_skew_s`]) show only where the arm moves:
    /// at rest the joints say the same a moment earlier, so nothing of it is here.
    ///
    /// # Errors
    ///
    /// Depth that cannot be in metres, as of a scale that is far off. A frame that saw nothing is left
    /// out, as readers of bags leave it out.
    pub fn in_memory(&self) -> Result<InMemory, SimulateError> {
        let scenario = &self.scenario;
        let robot = RobotSection {
            description: Some(scenario.urdf.to_owned()),
            base: Some(scenario.arm.base_name().to_owned()),
            end_effector: Some(scenario.arm.end_effector_name().to_owned()),
            ..RobotSection::default()
        };
        let mut source = InMemory::new(self.stated_camera.clone())
            .named("simulated")
            .with_camera_frame_id(FRAME_ID)
            .with_robot(robot);
        if scenario.backgrounds > 0 {
            for background in self.backgrounds().take(scenario.backgrounds) {
                source.push_background(self.as_stored(background))?;
            }
        }
        let encoders = self.encoders();
        let noise = RandomStream::Frames.of(scenario.seed);
        for (index, pose) in self.poses.iter().enumerate() {
            let before = index.checked_sub(1).map(|before| &self.poses[before].joints);
            let joints = encoders.read(&pose.joints, before, &pose.joints);
            let shot = self.look_at_rest(index);
            let painted = self.painted(index);
            for frame in 0..scenario.frames {
                // Frames of all kinds are counted: each has the noise that it has in a file.
                let place = index * (scenario.frames + scenario.moving_frames) + frame;
                let depth = self.as_stored(shot.frame(noise.at(place as u64)));
                match source.push(format!("{index}-{frame}"), depth, joints.clone()) {
                    Err(RecordingError::EmptyFrame { .. }) => continue,
                    pushed => drop(pushed?),
                }
                if let Some(painted) = &painted {
                    let last = source.frame_names().len() - 1;
                    source.set_color(last, painted.frame(place as u64))?;
                }
            }
        }
        Ok(source)
    }

    /// Depth as it is after a file: many sensors tell whole millimetres.
    fn as_stored(&self, depth: DepthImage) -> DepthImage {
        if !self.scenario.sensor.in_millimetres {
            return depth;
        }
        let millimetres: Vec<u16> =
            depth.depth_m().iter().map(|z| (1e3 * z).round() as u16).collect();
        depth_from_millimetres(depth.width(), depth.height(), &millimetres)
            .expect("as many pixels as before")
    }
}

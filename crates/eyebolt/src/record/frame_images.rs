//! The frames of a recording as depth images, one by one.

use super::error::RecordError;
use super::projection::{self, Projection};
use super::reader::{check_size, first_frame};
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_recording::FrameSource;

/// How the frames of a recording become depth images of one camera.
#[derive(Debug)]
pub struct FrameImages {
    projection: Projection,
}

impl FrameImages {
    /// Of a recording: its camera, or the one that its clouds tell.
    ///
    /// # Errors
    ///
    /// There is no frame, none that can be read, or no camera can be told.
    pub fn of(source: &dyn FrameSource) -> Result<Self, RecordError> {
        let frames: Vec<usize> = (0..source.frame_names().len()).collect();
        if frames.is_empty() {
            return Err(RecordError::NoFrames);
        }
        let first = first_frame(source, &frames)?;
        Ok(Self { projection: projection::find(source, &first, false)? })
    }

    /// The camera of all images.
    pub fn camera(&self) -> &PinholeCamera {
        &self.projection.camera
    }

    /// What the camera saw in frame `index`; `None` if the frame is damaged and may be left out.
    ///
    /// # Errors
    ///
    /// A frame that cannot be read, or one of another size.
    pub fn depth(
        &self,
        source: &dyn FrameSource,
        index: usize,
    ) -> Result<Option<DepthImage>, RecordError> {
        let frame = match source.read_frame(index) {
            Err(error) if source.may_leave_out(&error) => return Ok(None),
            read => read?,
        };
        let name = frame.name;
        let image = self.projection.depth_image(frame.range);
        check_size(&format!("frame {name}"), &image, &self.projection.camera)?;
        Ok(Some(image))
    }
}

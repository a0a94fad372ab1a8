//! The frames of a configuration, read and merged.

use super::error::RecordError;
use super::merge::{common_mask, median_depth};
use super::options::RecordOptions;
use super::projection::Projection;
use crate::evenly::evenly;
use crate::observations::Observations;
use eyebolt_geometry::{DepthImage, Mask, PinholeCamera, RayTable};
use eyebolt_recording::{Frame, FrameSource};
use eyebolt_robot::JointPositions;

/// Pixels of the images that one configuration is made from: enough frames for a median, few
/// enough for memory.
const MOST_PIXELS: usize = 12_000_000;
/// A median of fewer frames hardly reduces noise.
const FEWEST_FRAMES: usize = 5;
/// Nor does one of more frames, since the errors of a scene stay.
pub(super) const MOST_FRAMES: usize = 30;

/// The first of `frames` that can be read.
pub(super) fn first_frame(
    source: &dyn FrameSource,
    frames: &[usize],
) -> Result<Frame, RecordError> {
    let mut left_out = None;
    for index in frames {
        match source.read_frame(*index) {
            Err(error) if source.may_leave_out(&error) => left_out = Some(error),
            read => return Ok(read?),
        }
    }
    // A group has a frame, so that one was left out.
    Err(left_out.expect("a configuration has a frame").into())
}

/// Reads the frames of configurations.
pub(super) struct Reader<'a> {
    pub(super) source: &'a dyn FrameSource,
    pub(super) projection: &'a Projection,
    pub(super) rays: &'a RayTable,
    pub(super) options: &'a RecordOptions,
}

/// What the frames of a configuration saw.
pub(super) struct Seen {
    pub(super) depth: DepthImage,
    pub(super) mask: Option<Mask>,
}

impl Reader<'_> {
    pub(super) fn configuration(&self, frames: &[usize]) -> Result<Seen, RecordError> {
        let camera = &self.projection.camera;
        let most = (MOST_PIXELS / camera.pixel_count().max(1)).clamp(FEWEST_FRAMES, MOST_FRAMES);
        let (mut images, mut masks, mut left_out) = (Vec::new(), Vec::new(), None);
        for index in evenly(frames, most) {
            let frame = match self.source.read_frame(index) {
                Err(error) if self.source.may_leave_out(&error) => {
                    left_out.get_or_insert(error);
                    continue;
                }
                read => read?,
            };
            let (image, mask) = self.image(frame)?;
            images.push(image);
            masks.push(mask);
        }
        if let Some(error) = left_out.filter(|_| images.is_empty()) {
            return Err(error.into());
        }
        let image = median_depth(&images).expect("a configuration has a frame");
        Ok(Seen { depth: self.along_rays(image), mask: common_mask(&masks) })
    }

    /// The image that a frame becomes, and its mask if masks are used.
    fn image(&self, frame: Frame) -> Result<(DepthImage, Option<Mask>), RecordError> {
        let camera = &self.projection.camera;
        let mask = frame.mask.filter(|_| self.options.use_masks);
        check_mask(&frame.name, mask.as_ref(), camera)?;
        let image = self.projection.depth_image(frame.range);
        check_size(&format!("frame {}", frame.name), &image, camera)?;
        Ok((image, mask))
    }

    /// `image` where the lens has rays.
    fn along_rays(&self, image: DepthImage) -> DepthImage {
        let (width, height) = (image.width(), image.height());
        let known = |(z, [x, y]): (f32, &[f32; 2])| if (x + y).is_nan() { 0.0 } else { z };
        let depth_m = image.into_depth_m().into_iter().zip(self.rays.rays()).map(known).collect();
        DepthImage::new(width, height, depth_m).expect("as many pixels as before")
    }
}

/// Reads frames one by one, as the images that `observations` are of.
pub(crate) struct SingleFrames<'a> {
    source: &'a dyn FrameSource,
    projection: Projection,
    rays: &'a RayTable,
    options: &'a RecordOptions,
}

impl<'a> SingleFrames<'a> {
    /// Of the recording that `observations` were made of, by the same `options`.
    pub(crate) fn new(
        source: &'a dyn FrameSource,
        observations: &'a Observations,
        options: &'a RecordOptions,
    ) -> Self {
        let Observations { camera, optical_from_camera, source: image_source, rays, .. } =
            observations;
        let projection = Projection {
            camera: camera.clone(),
            optical_from_camera: *optical_from_camera,
            source: *image_source,
        };
        Self { source, projection, rays, options }
    }

    /// What frame `index` saw, and its joints; an error that may be left out is a reason.
    pub(crate) fn read(&self, index: usize) -> Result<SingleFrame, RecordError> {
        let Self { source, projection, rays, options } = self;
        let reader = Reader { source: *source, projection, rays, options };
        let frame = self.source.read_frame(index)?;
        let joints = frame.joints.clone();
        let (depth, mask) = reader.image(frame)?;
        Ok(SingleFrame { depth: reader.along_rays(depth), mask, joints })
    }
}

/// What one frame saw.
pub(crate) struct SingleFrame {
    pub(crate) depth: DepthImage,
    pub(crate) mask: Option<Mask>,
    pub(crate) joints: JointPositions,
}

/// A source of anybody's may hand out images of any size.
pub(super) fn check_size(
    what: &str,
    image: &DepthImage,
    camera: &PinholeCamera,
) -> Result<(), RecordError> {
    let (found, size) = ((image.width(), image.height()), (camera.width(), camera.height()));
    if found == size {
        return Ok(());
    }
    Err(RecordError::ImageSize { what: what.to_owned(), found, size })
}

/// A mask belongs to the pixels of the camera's images, also where clouds of another size are drawn
/// as images.
fn check_mask(frame: &str, mask: Option<&Mask>, camera: &PinholeCamera) -> Result<(), RecordError> {
    let size = (camera.width(), camera.height());
    let found = mask.map(|mask| (mask.width(), mask.height()));
    match found.filter(|mask| *mask != size) {
        Some(found) => Err(RecordError::MaskSize { frame: frame.to_owned(), found, size }),
        None => Ok(()),
    }
}

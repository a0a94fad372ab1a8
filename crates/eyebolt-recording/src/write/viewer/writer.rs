//! Messages that show a posed arm and what the camera saw of it.

use super::topics::{CAMERA_INFO, CAPTION, OUTLINE, OVERLAY, POINTS};
use crate::camera_info::camera_info_message;
use crate::message::{
    CompressedImageMessage, Header, Marker, MarkerFrame, MarkerShape, PaintedCloud,
    StaticTransform, placed_markers_message, types, write_transforms,
};
use crate::write::definitions::{ROBOT, TF, TF_STATIC};
use crate::write::error::WriteError;
use crate::write::mcap::McapWriter;
use eyebolt_geometry::PinholeCamera;
use eyebolt_robot::TriangleMesh;
use std::io::{Seek, Write};

/// Light and transparent: points lie on either side of a surface.
const ROBOT_RGBA: [f32; 4] = [0.82, 0.85, 0.9, 0.55];
const OUTLINE_RGBA: [f32; 4] = [0.16, 1.0, 0.27, 1.0];
const OUTLINE_M: f64 = 0.002;
const LETTERS_M: f64 = 0.04;

/// One configuration as a viewer shows it.
#[derive(Clone, Copy, Debug)]
pub struct Viewed<'a> {
    /// When the camera saw it.
    pub stamp_ns: i64,
    /// Where the links are, each below the base.
    pub base_from_link: &'a [StaticTransform],
    /// What the camera saw, optical frame, in colours that tell how far it lies from the arm.
    pub points: PaintedCloud<'a>,
    /// Ends of the pieces that the posed arm's outline is made of, optical frame, metres.
    pub outline_m: &'a [[[f32; 3]; 2]],
    /// What to write beside it.
    pub caption: &'a str,
    /// A PNG file of the camera's size.
    pub picture_png: Option<&'a [u8]>,
}

/// Writes a calibration for Foxglove, Lichtblick or, by way of `ros2 bag play`, RViz, as MCAP with ROS 2 messages:
/// transforms, the robot as triangles in the frames of its links, and for each configuration its points, outline, caption
/// and picture. No mesh file or description is needed to look at it. The same
/// calls write the same bytes.
///
/// Viewers interpolate transforms, but an arm that was seen at rest did not glide: each posture is told again right before
/// the next.
pub struct ViewerWriter<W: Write + Seek> {
    writer: McapWriter<W>,
    base: String,
    camera_frame_id: String,
    camera: Option<PinholeCamera>,
    caption_in_base_m: [f64; 3],
    held: Option<(i64, Vec<StaticTransform>)>,
}

/// How long before the next one a posture is told again, and how long the last one holds.
const BEFORE_NEXT_NS: i64 = 1_000_000;
const LAST_NS: i64 = 1_000_000_000;

impl<W: Write + Seek> ViewerWriter<W> {
    /// A file without messages. `base_from_camera` has the base as parent and the optical frame as child; `camera` are
    /// the intrinsics of pictures, if a camera took them; captions stand at `caption_in_base_m`.
    ///
    /// # Errors
    ///
    /// A failing `output`.
    pub fn new(
        output: W,
        first_stamp_ns: i64,
        base_from_camera: &StaticTransform,
        camera: Option<&PinholeCamera>,
        caption_in_base_m: [f64; 3],
    ) -> Result<Self, WriteError> {
        let mut writer = McapWriter::new(output)?;
        let fixed = write_transforms(std::slice::from_ref(base_from_camera), first_stamp_ns);
        writer.write(TF_STATIC, types::TRANSFORMS, first_stamp_ns, &fixed)?;
        Ok(Self {
            writer,
            base: base_from_camera.parent.clone(),
            camera_frame_id: base_from_camera.child.clone(),
            camera: camera.cloned(),
            caption_in_base_m,
            held: None,
        })
    }

    /// Writes the shapes of links, each in the frame of its name, which they follow.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn robot<'m>(
        &mut self,
        stamp_ns: i64,
        links: impl IntoIterator<Item = (&'m str, &'m TriangleMesh)>,
    ) -> Result<(), WriteError> {
        let links = (0..).zip(links).map(|(id, (name, mesh))| {
            let corner = |index: u32| mesh.vertices.get(index as usize).map(|v| v.coords.into());
            let corners = mesh.triangles.iter();
            let corners =
                corners.filter_map(|[a, b, c]| Some([corner(*a)?, corner(*b)?, corner(*c)?]));
            let shape = MarkerShape::Triangles { corners_m: corners.collect() };
            (
                MarkerFrame { frame_id: name, stamp_ns, follows: true },
                Marker { id, shape, rgba: ROBOT_RGBA },
            )
        });
        let links: Vec<_> = links.collect();
        let placed = links.iter().map(|(frame, marker)| (*frame, marker));
        let data = placed_markers_message("robot", placed);
        self.writer.write(ROBOT, types::MARKERS, stamp_ns, &data)
    }

    /// Writes a configuration; its stamp is later than that of the one before.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn configuration(&mut self, viewed: &Viewed<'_>) -> Result<(), WriteError> {
        let stamp_ns = viewed.stamp_ns;
        self.tell_again(stamp_ns.saturating_sub(BEFORE_NEXT_NS))?;
        self.transforms(stamp_ns, viewed.base_from_link)?;
        self.held = Some((stamp_ns, viewed.base_from_link.to_vec()));
        if let Some(camera) = &self.camera {
            let data = camera_info_message(camera, self.header(stamp_ns)).write();
            self.writer.write(CAMERA_INFO, types::CAMERA_INFO, stamp_ns, &data)?;
        }
        let points = viewed.points.message(&self.camera_frame_id, stamp_ns);
        self.writer.write(POINTS, types::CLOUD, stamp_ns, &points)?;
        let shape =
            MarkerShape::Segments { ends_m: viewed.outline_m.to_vec(), thickness_m: OUTLINE_M };
        let outline = Marker { id: 0, shape, rgba: OUTLINE_RGBA };
        self.marker(OUTLINE, stamp_ns, &self.camera_frame_id.clone(), &outline)?;
        let (text, at_m) = (viewed.caption.to_owned(), self.caption_in_base_m);
        let shape = MarkerShape::Text { text, at_m, height_m: LETTERS_M };
        let caption = Marker { id: 0, shape, rgba: [1.0; 4] };
        self.marker(CAPTION, stamp_ns, &self.base.clone(), &caption)?;
        if let Some(data) = viewed.picture_png {
            let header = self.header(stamp_ns);
            let picture = CompressedImageMessage { header, format: "png", data }.write();
            self.writer.write(OVERLAY, types::COMPRESSED_IMAGE, stamp_ns, &picture)?;
        }
        Ok(())
    }

    /// Writes what is left, and the index.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn finish(mut self) -> Result<(), WriteError> {
        if let Some((stamp_ns, _)) = self.held {
            self.tell_again(stamp_ns.saturating_add(LAST_NS))?;
        }
        self.writer.finish()
    }

    fn header(&self, stamp_ns: i64) -> Header<'_> {
        Header { stamp_ns, frame_id: &self.camera_frame_id }
    }

    fn tell_again(&mut self, stamp_ns: i64) -> Result<(), WriteError> {
        match self.held.take() {
            Some((told_ns, transforms)) if told_ns < stamp_ns => {
                self.transforms(stamp_ns, &transforms)
            }
            _ => Ok(()),
        }
    }

    fn transforms(&mut self, stamp_ns: i64, told: &[StaticTransform]) -> Result<(), WriteError> {
        self.writer.write(TF, types::TRANSFORMS, stamp_ns, &write_transforms(told, stamp_ns))
    }

    fn marker(
        &mut self,
        topic: &str,
        stamp_ns: i64,
        frame_id: &str,
        marker: &Marker,
    ) -> Result<(), WriteError> {
        let frame = MarkerFrame { frame_id, stamp_ns, follows: false };
        let data = placed_markers_message("eyebolt", std::iter::once((frame, marker)));
        self.writer.write(topic, types::MARKERS, stamp_ns, &data)
    }
}

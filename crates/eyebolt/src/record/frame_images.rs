//! The frames of a recording as depth images, one by one.

use super::error::RecordError;
use super::projection::{self, Projection};
use super::reader::{check_size, first_frame};
use eyebolt_geometry::{Camera, Cloud, DepthImage, PinholeCamera, RayTable, Transform};
use eyebolt_recording::{FrameSource, Range};
use nalgebra::Point3;
use std::sync::OnceLock;

/// How the frames of a recording become depth images of one camera.
#[derive(Debug)]
pub struct FrameImages {
    projection: Projection,
    /// Of the camera, once somebody asks for points.
    rays: OnceLock<RayTable>,
}

/// What the camera saw in one frame.
#[derive(Clone, Debug)]
pub struct FrameImage {
    /// Of the size of [`FrameImages::camera`].
    pub depth: DepthImage,
    /// The cloud that it was made of, if so, in the optical frame of the recording.
    pub cloud: Option<Cloud>,
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
        Ok(Self { projection: projection::find(source, &first, false)?, rays: OnceLock::new() })
    }

    /// The camera of all images.
    pub fn camera(&self) -> &PinholeCamera {
        &self.projection.camera
    }

    /// From the frame of that camera to the optical frame of the recording: turned where clouds tell another axis.
    pub fn optical_from_camera(&self) -> &Transform<Camera, Camera> {
        &self.projection.optical_from_camera
    }

    /// What the camera saw in frame `index`; `None` if the frame is damaged and may be left out.
    ///
    /// # Errors
    ///
    /// A frame that cannot be read, or one of another size.
    pub fn read(
        &self,
        source: &dyn FrameSource,
        index: usize,
    ) -> Result<Option<FrameImage>, RecordError> {
        let frame = match source.read_frame(index) {
            Err(error) if source.may_leave_out(&error) => return Ok(None),
            read => read?,
        };
        let name = frame.name;
        let (depth, cloud) = match frame.range {
            Range::Depth(depth) => (depth, None),
            Range::Cloud(cloud) => (self.projection.cloud_depth(&cloud), Some(cloud)),
        };
        check_size(&format!("frame {name}"), &depth, &self.projection.camera)?;
        Ok(Some(FrameImage { depth, cloud }))
    }

    /// The points of a frame in the optical frame of the recording, metres, each with the pixel that it belongs to: of a
    /// cloud its own points, of a depth image its pixels.
    pub fn points(&self, frame: &FrameImage) -> Vec<(Point3<f32>, usize)> {
        let Some(cloud) = &frame.cloud else {
            let rays = self.rays.get_or_init(|| RayTable::new(self.camera()));
            let seen = frame.depth.depth_m().iter().enumerate().filter(|(_, z)| **z > 0.0);
            return seen.map(|(at, z)| (Point3::from(rays.point(at, *z)), at)).collect();
        };
        let camera_from_optical = self.optical_from_camera().rotation().inverse();
        let with_pixel = |point: &Point3<f32>| {
            let in_camera = camera_from_optical * point.cast::<f64>();
            Some((*point, self.pixel_of(&frame.depth, &in_camera)?))
        };
        cloud.valid().filter_map(with_pixel).collect()
    }

    /// The pixel about the projection of a point that is as deep as the point: several points may share one, which has the depth of
    /// the nearest.
    fn pixel_of(&self, depth: &DepthImage, in_camera: &Point3<f64>) -> Option<usize> {
        let camera = self.camera();
        let (width, height) = (i64::from(camera.width()), i64::from(camera.height()));
        let pixel = camera.project(in_camera).filter(|pixel| camera.contains(pixel))?;
        let (u, v) = (pixel.x.round() as i64, pixel.y.round() as i64);
        let around = (-1..=1).flat_map(|dv| (-1..=1).map(move |du| (u + du, v + dv)));
        let inside = around.filter(|(u, v)| (0..width).contains(u) && (0..height).contains(v));
        let seen = inside.map(|(u, v)| (v * width + u) as usize);
        let off = |at: &usize| (f64::from(depth.depth_m()[*at]) - in_camera.z).abs();
        seen.filter(|at| depth.depth_m()[*at] > 0.0).min_by(|a, b| off(a).total_cmp(&off(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_recording::InMemory;
    use eyebolt_robot::JointPositions;
    use nalgebra::{UnitQuaternion, Vector3};

    /// A near square before a wall, off the axis and without order: each point comes back with a pixel of its own surface, and where
    /// it was.
    #[test]
    fn points_of_a_cloud_keep_their_place_and_find_their_surface() {
        let aside = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.4, 0.0));
        let grid = |count: i32, half: f32, z: f32| {
            let at = move |i: i32| half * (2.0 * i as f32 / count as f32 - 1.0);
            (0..count).flat_map(move |i| (0..count).map(move |j| Point3::new(at(i), at(j), z)))
        };
        // What the square hides, no camera sees.
        let seen = |point: &Point3<f32>| point.x.abs().max(point.y.abs()) > 0.4;
        let points = grid(60, 0.2, 0.8).chain(grid(120, 0.9, 1.6).filter(seen));
        let points: Vec<_> =
            points.map(|point| (aside * point.cast::<f64>()).cast::<f32>()).collect();
        let mut source = InMemory::of_clouds();
        let joints: JointPositions = [("joint".to_owned(), 0.5)].into_iter().collect();
        source.push_cloud("0", Cloud::new(points.clone()), joints).unwrap();
        let images = FrameImages::of(&source).unwrap();
        let frame = images.read(&source, 0).unwrap().unwrap();
        let found = images.points(&frame);
        assert!(found.len() as f64 > 0.95 * points.len() as f64, "{} points found", found.len());
        let mut others = 0;
        for (point, at) in &found {
            assert!(points.contains(point));
            let z = (images.optical_from_camera().rotation().inverse() * point.cast::<f64>()).z;
            others += usize::from((f64::from(frame.depth.depth_m()[*at]) - z).abs() > 0.2);
        }
        assert!((others as f64) < 0.01 * found.len() as f64, "{others} points of another surface");
    }
}

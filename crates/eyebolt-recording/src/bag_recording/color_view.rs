//! Colour of another camera, as the depth camera would see it.

use super::choose::{Chosen, is_rectified, size};
use super::frames::between;
use super::scan::{Content, Scan};
use crate::bag::Bag;
use crate::camera_info::{CameraInfo, PictureForm};
use crate::color::ColorImage;
use crate::error::RecordingError;
use crate::message::{CameraInfoMessage, WireReader};
use eyebolt_geometry::{Camera, DepthImage, PinholeCamera, Transform};
use nalgebra::{Isometry3, Point2, Point3};
use std::path::Path;

/// A colour camera beside the depth camera.
#[derive(Clone, Debug)]
pub(super) struct ColorView {
    pub(super) camera: PinholeCamera,
    color_from_depth: Isometry3<f64>,
}

impl ColorView {
    /// The colour camera of `chosen`, if its pictures are of another camera than the depth.
    pub(super) fn read(
        path: &Path,
        bag: &Bag,
        scan: &Scan,
        chosen: &Chosen,
    ) -> Result<Option<Self>, RecordingError> {
        let (Some(color), Some(info)) = (chosen.color, chosen.color_info) else { return Ok(None) };
        let (color, info, depth) = (scan.topic(color), scan.topic(info), scan.topic(chosen.range));
        let Content::CameraInfo { locator: Some(locator), .. } = &info.content else {
            return Ok(None);
        };
        let frames = depth.frame_id.as_deref().zip(color.frame_id.as_deref());
        let color_from_depth =
            frames.and_then(|(depth, color)| between(&scan.static_transforms, color, depth));
        let Some(color_from_depth) = color_from_depth else { return Ok(None) };
        let bytes = bag.read(*locator)?;
        let message = WireReader::new(&info.encoding, &bytes)
            .and_then(|mut reader| CameraInfoMessage::read(&mut reader))
            .map_err(|wrong| {
                let field = format!("{}: {}", info.name, wrong.field);
                RecordingError::invalid(path, field, wrong.problem, "Record it again")
            })?;
        let picture = PictureForm { rectified: is_rectified(color), size: size(color) };
        let camera = CameraInfo::from_message(path, &message, picture)?.camera;
        Ok(Some(Self { camera, color_from_depth }))
    }

    /// Where this camera stands against the depth camera.
    pub(super) fn depth_from_color(&self) -> Transform<Camera, Camera> {
        Transform::from_isometry(self.color_from_depth.inverse())
    }

    /// `picture`, which is of this camera's size, in the pixels of `depth`, which `depth_camera` saw.
    ///
    /// Where there is no depth, things are taken to be as far as half of what is seen: this is for
    /// people to look at.
    pub(super) fn seen_by(
        &self,
        depth_camera: &PinholeCamera,
        depth: &DepthImage,
        picture: &ColorImage,
    ) -> ColorImage {
        let (width, height) = (depth.width(), depth.height());
        let mut seen: Vec<f32> = depth.depth_m().iter().copied().filter(|z| *z > 0.0).collect();
        let middle = seen.len() / 2;
        let usual_m = match seen.is_empty() {
            true => 1.0,
            false => *seen.select_nth_unstable_by(middle, f32::total_cmp).1,
        };
        let color = |(index, z): (usize, &f32)| {
            let (u, v) = (index % width as usize, index / width as usize);
            let ray = depth_camera.ray(&Point2::new(u as f64, v as f64))?;
            let z = f64::from(if *z > 0.0 { *z } else { usual_m });
            let point = self.color_from_depth * Point3::from(ray * z);
            let pixel = self.camera.project(&point)?;
            let (x, y) = (pixel.x.round(), pixel.y.round());
            let inside = x >= 0.0
                && y >= 0.0
                && x < f64::from(picture.width)
                && y < f64::from(picture.height);
            // Inside the picture, both are small and not negative.
            let place = || y as usize * picture.width as usize + x as usize;
            if inside { picture.rgb.get(place()).copied() } else { None }
        };
        let pixels = depth.depth_m().iter().enumerate();
        let rgb = pixels.map(|pixel| color(pixel).unwrap_or_default()).collect();
        ColorImage { width, height, rgb }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::Distortion;
    use proptest::prelude::*;

    proptest! {
        /// A plane square to the axes at a distance: colour moves by the baseline's disparity.
        #[test]
        fn a_picture_is_shifted_by_its_disparity(shift in -3_i32..4, z in 0.5_f32..3.0) {
            let camera = PinholeCamera::new(16, 8, 20.0, 20.0, 7.5, 3.5, Distortion::None).unwrap();
            let baseline = f64::from(shift) * f64::from(z) / 20.0;
            let view = ColorView {
                camera: camera.clone(),
                color_from_depth: Isometry3::translation(baseline, 0.0, 0.0),
            };
            let rgb: Vec<[u8; 3]> = (0..128).map(|i| [(i % 16) as u8, (i / 16) as u8, 9]).collect();
            let picture = ColorImage { width: 16, height: 8, rgb };
            let depth = DepthImage::new(16, 8, vec![z; 128]).unwrap();
            let seen = view.seen_by(&camera, &depth, &picture);
            for (index, rgb) in seen.rgb.iter().enumerate() {
                let (u, v) = ((index % 16) as i32 + shift, index / 16);
                let expected = if (0..16).contains(&u) { [u as u8, v as u8, 9] } else { [0; 3] };
                prop_assert_eq!(*rgb, expected);
            }
        }
    }
}

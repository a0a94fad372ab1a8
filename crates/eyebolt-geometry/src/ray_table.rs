//! The rays of a camera's pixels, and the cloud that they make of a depth image.

use crate::camera::PinholeCamera;
use crate::cloud::Cloud;
use crate::depth_image::DepthImage;
use crate::image::ImageError;
use nalgebra::{Point2, Point3};
use rayon::prelude::*;

/// The ray of every pixel of a camera, as `[x / z, y / z]`, row by row; NaN where there is none.
///
/// Computed once per camera, so that a lens costs nothing per image.
#[derive(Clone, Debug)]
pub struct RayTable {
    width: u32,
    height: u32,
    rays: Vec<[f32; 2]>,
}

impl RayTable {
    /// The rays of `camera`.
    pub fn new(camera: &PinholeCamera) -> Self {
        let (width, height) = (camera.width(), camera.height());
        let row = |v: u32| {
            (0..width).map(move |u| match camera.ray(&Point2::new(f64::from(u), f64::from(v))) {
                Some(ray) => [ray.x as f32, ray.y as f32],
                None => [f32::NAN; 2],
            })
        };
        let rays = (0..height).into_par_iter().flat_map_iter(row).collect();
        Self { width, height, rays }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// `[x / z, y / z]` of every pixel, row by row; NaN where the lens has no ray.
    pub fn rays(&self) -> &[[f32; 2]] {
        &self.rays
    }

    /// The point at depth `z_m` along the ray of row-major pixel `index`, camera frame; NaN where the
    /// lens has no ray.
    ///
    /// # Panics
    ///
    /// Beyond the last pixel.
    pub fn point(&self, index: usize, z_m: f32) -> Point3<f32> {
        let [x, y] = self.rays[index];
        Point3::new(x * z_m, y * z_m, z_m)
    }

    /// The organised cloud of `image` in the camera frame, metres.
    ///
    /// # Errors
    ///
    /// The image is of another size than the camera of the rays.
    pub fn unproject(&self, image: &DepthImage) -> Result<Cloud, ImageError> {
        let (size, own) = ((image.width(), image.height()), (self.width, self.height));
        if size != own {
            return Err(ImageError::Camera { image: size, camera: own });
        }
        let point = |(index, depth): (usize, &f32)| match *depth > 0.0 {
            true => self.point(index, *depth),
            false => Point3::new(f32::NAN, f32::NAN, f32::NAN),
        };
        let points = image.depth_m().iter().enumerate().map(point).collect();
        Cloud::organised(self.width, self.height, points)
    }
}

impl DepthImage {
    /// The organised cloud of the image in the camera frame.
    ///
    /// For many images of one camera, make its [`RayTable`] once.
    ///
    /// # Errors
    ///
    /// The camera is of another size.
    pub fn unproject(&self, camera: &PinholeCamera) -> Result<Cloud, ImageError> {
        RayTable::new(camera).unproject(self)
    }
}

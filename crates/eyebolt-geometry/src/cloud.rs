//! Point clouds, organised as an image or not.

use crate::camera::PinholeCamera;
use crate::depth_image::DepthImage;
use crate::frame::CoordinateFrame;
use crate::image::{ImageError, check_size};
use crate::transform::Transform;
use nalgebra::{Point3, Quaternion, Unit, UnitQuaternion};

/// Points in metres; a missing one is NaN in all three coordinates.
///
/// An organised cloud has one point per pixel, row by row.
#[derive(Clone, Debug)]
pub struct Cloud {
    points: Vec<Point3<f32>>,
    grid: Option<(u32, u32)>,
}

/// The axis-aligned box around the valid points of a cloud, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// Smallest coordinates.
    pub min: Point3<f32>,
    /// Largest coordinates.
    pub max: Point3<f32>,
}

impl BoundingBox {
    /// The middle of the box.
    pub fn centre(&self) -> Point3<f32> {
        nalgebra::center(&self.min, &self.max)
    }
}

/// The rotation from a ROS body frame (x forward, y left, z up) to an optical frame (x right,
/// y down, z forward), REP 103.
pub fn optical_from_body() -> UnitQuaternion<f64> {
    Unit::new_unchecked(Quaternion::new(0.5, 0.5, -0.5, 0.5))
}

impl Cloud {
    /// A cloud without order. Points with a coordinate that is not finite become all NaN.
    pub fn new(points: Vec<Point3<f32>>) -> Self {
        Self { points: cleaned(points), grid: None }
    }

    /// A cloud with one point per pixel, row by row.
    ///
    /// # Errors
    ///
    /// An empty grid, or another number of points than `width * height`.
    pub fn organised(
        width: u32,
        height: u32,
        points: Vec<Point3<f32>>,
    ) -> Result<Self, ImageError> {
        check_size(width, height, points.len())?;
        Ok(Self { points: cleaned(points), grid: Some((width, height)) })
    }

    /// All points, missing ones included.
    pub fn points(&self) -> &[Point3<f32>] {
        &self.points
    }

    /// All points, missing ones included.
    pub fn into_points(self) -> Vec<Point3<f32>> {
        self.points
    }

    /// Width and height, if the points are organised as an image.
    pub fn grid(&self) -> Option<(u32, u32)> {
        self.grid
    }

    /// The point of pixel `(u, v)`; `None` off the grid, where it is missing, or without a grid.
    pub fn at(&self, u: u32, v: u32) -> Option<&Point3<f32>> {
        let (width, height) = self.grid?;
        let index = v as usize * width as usize + u as usize;
        let point = if u < width && v < height { self.points.get(index) } else { None };
        point.filter(|p| is_valid(p))
    }

    /// The points that are there.
    pub fn valid(&self) -> impl Iterator<Item = &Point3<f32>> + Clone {
        self.points.iter().filter(|p| is_valid(p))
    }

    /// Index and point of those that are there.
    pub fn valid_indexed(&self) -> impl Iterator<Item = (usize, &Point3<f32>)> + Clone {
        self.points.iter().enumerate().filter(|(_, p)| is_valid(p))
    }

    /// How many points are there.
    pub fn count_valid(&self) -> usize {
        self.valid().count()
    }

    /// The same cloud with every point turned about the origin, on the same grid.
    #[must_use]
    pub fn rotated(&self, rotation: &UnitQuaternion<f64>) -> Self {
        let matrix = rotation.to_rotation_matrix();
        self.mapped(|p| matrix * p)
    }

    /// The same cloud in the frame `To`, on the same grid.
    #[must_use]
    pub fn transformed<To: CoordinateFrame, From: CoordinateFrame>(
        &self,
        to_from_cloud: &Transform<To, From>,
    ) -> Self {
        let matrix = to_from_cloud.rotation().to_rotation_matrix();
        let translation_m = to_from_cloud.translation_m();
        self.mapped(|p| matrix * p + translation_m)
    }

    /// The box around the valid points; `None` if there are none.
    pub fn bounding_box(&self) -> Option<BoundingBox> {
        self.valid().fold(None, |bounds: Option<BoundingBox>, p| match bounds {
            None => Some(BoundingBox { min: *p, max: *p }),
            Some(b) => Some(BoundingBox { min: b.min.inf(p), max: b.max.sup(p) }),
        })
    }

    /// The mean of the valid points; `None` if there are none.
    pub fn centroid(&self) -> Option<Point3<f64>> {
        let mut sum = nalgebra::Vector3::zeros();
        let mut count = 0_u32;
        for point in self.valid() {
            sum += point.coords.cast::<f64>();
            count += 1;
        }
        (count > 0).then(|| Point3::from(sum / f64::from(count)))
    }

    /// The depth image that `camera` sees of the points, given in its frame: every point falls on
    /// the pixel nearest to its projection, and the nearest point of a pixel wins.
    pub fn to_depth_image(&self, camera: &PinholeCamera) -> DepthImage {
        let mut depth_m = vec![0.0_f32; camera.pixel_count()];
        for point in self.valid() {
            let Some(pixel) = camera.project(&point.cast::<f64>()) else { continue };
            if !camera.contains(&pixel) {
                continue;
            }
            // Inside the image: -0.5 rounds to -0, which casts to 0.
            let (u, v) = (pixel.x.round() as usize, pixel.y.round() as usize);
            if let Some(depth) = depth_m.get_mut(v * camera.width() as usize + u)
                && (*depth == 0.0 || point.z < *depth)
            {
                *depth = point.z;
            }
        }
        DepthImage::from_clean(camera.width(), camera.height(), depth_m)
    }

    fn mapped(&self, map: impl Fn(Point3<f64>) -> Point3<f64>) -> Self {
        let points = self.points.iter().map(|p| map(p.cast::<f64>()).cast::<f32>()).collect();
        Self { points: cleaned(points), grid: self.grid }
    }
}

/// Whether a cleaned point is there: missing ones are NaN in all three coordinates.
pub(crate) fn is_valid(point: &Point3<f32>) -> bool {
    !point.x.is_nan()
}

fn cleaned(mut points: Vec<Point3<f32>>) -> Vec<Point3<f32>> {
    for point in &mut points {
        if !point.iter().all(|c| c.is_finite()) {
            *point = Point3::new(f32::NAN, f32::NAN, f32::NAN);
        }
    }
    points
}

//! What a specimen of a model makes of a scene.

use super::exposure::Exposure;
use super::model::{Family, Sensor};
use super::specimen::Specimen;
use super::{time_of_flight, triangulation};
use crate::rays::RayScene;
use crate::view::IdealView;
use eyebolt_geometry::{Base, Camera, PinholeCamera, RayTable, Transform};
use nalgebra::Point3;

impl Sensor {
    /// What `specimen` makes of `scene`, with `camera` at a pose.
    ///
    /// All that frames have in common is worked out here, once per configuration of the scene.
    /// `camera` may be another than [`Self::camera`], a crop of it for instance.
    pub fn look(
        &self,
        scene: &RayScene,
        camera: &PinholeCamera,
        base_from_camera: &Transform<Base, Camera>,
        specimen: &Specimen,
    ) -> Exposure {
        let rays = RayTable::new(camera);
        let view = scene.view_along(&rays, base_from_camera);
        let second_sees = self.baseline_m().map_or(Vec::new(), |baseline_m| {
            let pose = base_from_camera.isometry().cast::<f32>();
            let points = view.depth_m.iter().zip(rays.rays());
            // Where nothing is seen the point is the lens itself: seen or not, it has no depth.
            let in_base = |(z, [x, y]): (&f32, &[f32; 2])| match *z {
                0.0 => pose.translation.vector.into(),
                z => pose * Point3::new(x * z, y * z, z),
            };
            let points: Vec<Point3<f32>> = points.map(in_base).collect();
            scene.visible_from(base_from_camera.point(&Point3::new(baseline_m, 0.0, 0.0)), &points)
        });
        self.expose(&view, camera, &second_sees, specimen)
    }

    /// What `specimen` makes of `view`, the ideal view of `camera`.
    ///
    /// `second_sees` tells of each pixel whether the point seen there is in sight of the second
    /// lens, or lit by the projector, [`Self::baseline_m`] to the side; it is not read if there is
    /// none.
    ///
    /// # Panics
    ///
    /// If the three are not of one size.
    pub fn expose(
        &self,
        view: &IdealView,
        camera: &PinholeCamera,
        second_sees: &[bool],
        specimen: &Specimen,
    ) -> Exposure {
        assert_eq!(view.depth_m.len(), camera.pixel_count(), "the view is the camera's");
        let mut exposure = match &self.family {
            Family::Ideal => Exposure::of_depth(view, specimen),
            Family::Triangulation(figures) => {
                assert_eq!(second_sees.len(), view.depth_m.len(), "each pixel is seen or not");
                triangulation::expose(figures, view, camera, second_sees, specimen)
            }
            Family::TimeOfFlight(figures) => {
                time_of_flight::expose(figures, view, camera, specimen)
            }
        };
        exposure.range_m = self.range_m.map(|depth| depth as f32);
        exposure
    }
}

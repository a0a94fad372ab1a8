//! The cameras, each a row of figures.

use super::{AxialNoise, Family, LateralNoise, Mode, Sensor, Triangulation, Window};

impl Sensor {
    /// All models.
    pub const ALL: [Self; 2] = [Self::IDEAL, Self::KINECT_V1];

    /// No errors but those of the specimen.
    pub const IDEAL: Self = Self {
        name: "ideal",
        about: "no errors: what a camera would see if there were a perfect one",
        mode: Mode { width: 640, height: 480, focal_px: 525.0 },
        range_m: [0.0, f64::INFINITY],
        in_millimetres: false,
        family: Family::Ideal,
    };

    /// Structured light, Microsoft 2010; the PrimeSense and Xtion cameras are of the same make.
    ///
    /// - Focal length, baseline, steps of 1/8 pixel, a correlation window of 9 pixels, the blind
    ///   band of 8 columns: Konolige and Mihelich, *Technical description of Kinect calibration*,
    ///   ROS wiki, 2011.
    /// - Axial and lateral noise with depth and angle: Nguyen, Izadi and Lovell, *Modeling Kinect
    ///   Sensor Noise for Improved 3D Reconstruction and Tracking*, 3DIMPVT 2012, measured from
    ///   0.5 to 2.75 m. Khoshelham and Oude Elberink, *Accuracy and Resolution of Kinect Depth Data
    ///   for Indoor Mapping Applications*, Sensors 12(2), 2012, found `1.42e-3 z^2` metres and steps
    ///   of `2.85e-3 z^2`, on which the rows agree.
    /// - Range: the same, 0.5 to 5 m.
    /// - Noise is half correlated at half the window: neighbours compare mostly the same pixels.
    /// - Not measured by anyone known to us, and assumed: half of the variance stays from frame to
    ///   frame; a third of a window must match; no depth beyond 80 degrees, which is as far as
    ///   Nguyen et al. have any.
    pub const KINECT_V1: Self = Self {
        name: "kinect-v1",
        about: "Microsoft Kinect v1 (structured light), 640 x 480, 0.5 to 5 m",
        mode: Mode { width: 640, height: 480, focal_px: 580.0 },
        range_m: [0.5, 5.0],
        in_millimetres: true,
        family: Family::Triangulation(Triangulation {
            baseline_m: 0.075,
            shadows: true,
            overlap_only: false,
            blind_columns: 8,
            step_px: 1.0 / 8.0,
            axial: AxialNoise::Depth {
                floor_m: 0.0012,
                growth_per_m: 0.0019,
                from_m: 0.4,
                grazing: 0.0001,
            },
            half_correlation_px: 4.5,
            fixed_share: 0.5,
            half_correlation_disparity_px: 1.0,
            lateral: LateralNoise { base_px: 0.8, grazing_px: 0.035 },
            window: Window { half_px: 4, least_share: 0.33 },
            fattening_px: 0.0,
            rim_px: 0.0,
            largest_angle_rad: 80.0 * DEGREE,
        }),
    };
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

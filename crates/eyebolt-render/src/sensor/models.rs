//! The cameras, each a row of figures.

use super::figures::{TimeOfFlight, Triangulation, Window};
use super::laws::{AxialNoise, LateralNoise};
use super::model::{Family, Mode, Sensor};

impl Sensor {
    /// All models.
    pub const ALL: [Self; 6] =
        [Self::IDEAL, Self::KINECT_V1, Self::D435, Self::D455, Self::ZED_2I, Self::AZURE_KINECT];

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
            lateral: LateralNoise { base_px: 0.8, grazing_px: 0.035, half_correlation_px: 2.5 },
            window: Window { half_px: 4, least_share: 0.33 },
            fattening_px: 0.0,
            rim_px: 0.0,
            largest_angle_rad: 80.0 * DEGREE,
        }),
    };

    /// Active stereo, Intel 2018.
    ///
    /// - Focal length (90 degrees over 848 pixels), baseline, depth error
    ///   `z^2 subpixel / (f baseline)` with a subpixel of 0.08, nearest depth `f baseline / 126`:
    ///   Grunnet-Jepsen, Sweetser and Woodfill, *Best-Known-Methods for Tuning Intel RealSense D400
    ///   Depth Cameras for Best Performance*, Intel, 2018.
    /// - Disparity in steps of 1/32 pixel: Grunnet-Jepsen et al., *Subpixel Linearity Improvement for
    ///   Intel RealSense Depth Camera D400 Series*, Intel, 2019.
    /// - The left imager is the reference, the band without depth along the left edge is
    ///   `f baseline / z` wide, range to 10 m: *Intel RealSense D400 Series Datasheet*, section
    ///   "Invalid Depth Band".
    /// - A window of 7 pixels, noise half correlated at half of it, things fattened by half of it:
    ///   the matcher of the forerunner R200 (Keselman et al., *Intel RealSense Stereoscopic Depth
    ///   Cameras*, CVPR Workshops 2017); what the D400's semiglobal matcher aggregates is not told.
    /// - Assumed: edges are off by a pixel, half of the variance stays from frame to frame, a third
    ///   of a window must match, no depth beyond 80 degrees.
    pub const D435: Self = Self {
        name: "d435",
        about: "Intel RealSense D435 (active stereo, 50 mm), 848 x 480, 0.17 to 10 m",
        mode: D400,
        range_m: [424.0 * 0.050 / 126.0, 10.0],
        in_millimetres: true,
        family: Family::Triangulation(D400_STEREO),
    };

    /// Active stereo, Intel 2020: [`Self::D435`] with a longer baseline (*Intel RealSense D400
    /// Series Datasheet*).
    pub const D455: Self = Self {
        name: "d455",
        about: "Intel RealSense D455 (active stereo, 95 mm), 848 x 480, 0.32 to 10 m",
        mode: D400,
        range_m: [424.0 * 0.095 / 126.0, 10.0],
        in_millimetres: true,
        family: Family::Triangulation(Triangulation { baseline_m: 0.095, ..D400_STEREO }),
    };

    /// Passive stereo with a network for a matcher, Stereolabs 2021.
    ///
    /// - Baseline 120 mm, range 0.3 to 20 m, error below 1 % up to 3 m and 5 % up to 15 m: *ZED 2i
    ///   Datasheet*, Stereolabs, 2022. At this focal length both errors are 0.214 pixels of
    ///   disparity, taken as standard deviation.
    /// - Image, focal length, and how edges look: five frames at 1.4 m that came with the program
    ///   roboreg (KUKA LBR Med7). Things are outlined by a rim without depth, 3 to 4 pixels wide; what
    ///   only the left lens sees has depth all the same; residuals from a plane are below 0.02
    ///   pixels over 9 pixels, so errors are smooth over whole things.
    /// - Assumed: errors half correlated at 40 pixels and at 8 pixels of disparity, nine tenths of
    ///   the variance the same in every frame, edges fattened by 2 pixels and off by 1.
    pub const ZED_2I: Self = Self {
        name: "zed2i",
        about: "Stereolabs ZED 2i (passive stereo, 120 mm), 960 x 540, 0.3 to 20 m",
        mode: Mode { width: 960, height: 540, focal_px: 535.0 },
        range_m: [0.3, 20.0],
        in_millimetres: false,
        family: Family::Triangulation(Triangulation {
            baseline_m: 0.120,
            shadows: false,
            overlap_only: false,
            blind_columns: 0,
            step_px: 0.0,
            axial: AxialNoise::Disparity { rms_px: 0.214 },
            half_correlation_px: 40.0,
            fixed_share: 0.9,
            half_correlation_disparity_px: 8.0,
            lateral: LateralNoise { base_px: 1.0, grazing_px: 0.0, half_correlation_px: 10.0 },
            window: Window { half_px: 0, least_share: 0.0 },
            fattening_px: 2.0,
            rim_px: 3.0,
            largest_angle_rad: f64::INFINITY,
        }),
    };

    /// Time of flight, Microsoft 2019, its mode "NFOV unbinned".
    ///
    /// - 640 x 576 pixels, 0.5 to 3.86 m, random error at most 17 mm, systematic error below
    ///   11 mm + 0.1 % of the depth, on surfaces that reflect 15 % and more: *Azure Kinect DK hardware
    ///   specifications*, Microsoft; confirmed by Tölgyessy et al., *Evaluation of the Azure Kinect
    ///   and Its Comparison to Kinect V1 and Kinect V2*, Sensors 21(2), 2021. The systematic limit
    ///   is taken for three standard deviations. The random one is taken for what a surface that
    ///   reflects 15 % has at 3.86 m, where less signal is none; surfaces here reflect 50 %.
    /// - Focal length: what the factory's calibration states, of the middle of the lens. The field
    ///   of view of 75 by 65 degrees holds for the image before its distortion is taken out.
    /// - Modulation: the sensor's highest is 320 MHz (Bamji et al., *1Mpixel 65nm BSI 320MHz demodulated
    ///   TOF image sensor*, ISSCC 2018); 200 MHz, a wave of 1.5 m, is assumed for its depth modes.
    /// - Assumed: a point's image of 0.8 pixels, no depth where less than 55 % of the signal is of
    ///   one surface.
    pub const AZURE_KINECT: Self = Self {
        name: "azure-kinect",
        about: "Microsoft Azure Kinect (time of flight), 640 x 576, 0.5 to 3.86 m",
        mode: Mode { width: 640, height: 576, focal_px: 504.0 },
        range_m: [0.5, 3.86],
        in_millimetres: true,
        family: Family::TimeOfFlight(TimeOfFlight {
            random_m: 0.017 * 0.3 / (3.86 * 3.86),
            least_signal: 0.3 / (3.86 * 3.86),
            systematic_m: 0.011 / 3.0,
            systematic_growth: 0.001 / 3.0,
            blur_px: 0.8,
            least_share: 0.55,
            reflectivity: 0.5,
            wavelength_m: 1.5,
        }),
    };
}

const D400: Mode = Mode { width: 848, height: 480, focal_px: 424.0 };

const D400_STEREO: Triangulation = Triangulation {
    baseline_m: 0.050,
    shadows: true,
    overlap_only: true,
    blind_columns: 0,
    step_px: 1.0 / 32.0,
    axial: AxialNoise::Disparity { rms_px: 0.08 },
    half_correlation_px: 3.5,
    fixed_share: 0.5,
    half_correlation_disparity_px: 1.0,
    lateral: LateralNoise { base_px: 1.0, grazing_px: 0.0, half_correlation_px: 3.5 },
    window: Window { half_px: 3, least_share: 0.33 },
    fattening_px: 3.0,
    rim_px: 0.0,
    largest_angle_rad: 80.0 * DEGREE,
};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

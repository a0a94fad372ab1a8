//! The part of a sensor that a picture shows, and how coarsely.

use super::raw::Raw;

/// A region of interest of the sensor, whose pixels are then binned, as `sensor_msgs/CameraInfo`
/// tells it: its size and intrinsics are those of the whole sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    offset: (u32, u32),
    size: (u32, u32),
    /// Pixels of the sensor that make one of the picture.
    binning: (u32, u32),
}

impl Window {
    /// What `raw` tells of a sensor of size `whole`, if pictures of size `picture` are such.
    ///
    /// Some drivers tell the size and the intrinsics of the picture, and binning beside it: then
    /// there is nothing to do, as where the size is not known.
    pub(super) fn of(raw: &Raw, whole: (u32, u32), picture: Option<(u32, u32)>) -> Self {
        let all = Self { offset: (0, 0), size: whole, binning: (1, 1) };
        let roi = raw.roi;
        let part = match (roi.width, roi.height) {
            (0, _) | (_, 0) => all,
            size => Self { offset: (roi.x_offset, roi.y_offset), size, ..all },
        };
        let told = Self { binning: (raw.binning_x.max(1), raw.binning_y.max(1)), ..part };
        match picture {
            Some(picture) if picture != whole && told.picture() == picture => told,
            _ => all,
        }
    }

    fn picture(&self) -> (u32, u32) {
        (self.size.0 / self.binning.0, self.size.1 / self.binning.1)
    }

    /// Size and intrinsics (fx, fy, cx, cy) of the picture, by those of the sensor.
    pub(super) fn seen(
        &self,
        whole: (u32, u32),
        [fx, fy, cx, cy]: [f64; 4],
    ) -> ((u32, u32), [f64; 4]) {
        if *self == (Self { offset: (0, 0), size: whole, binning: (1, 1) }) {
            return (whole, [fx, fy, cx, cy]);
        }
        let (x, y) = (f64::from(self.offset.0), f64::from(self.offset.1));
        let (across, down) = (f64::from(self.binning.0), f64::from(self.binning.1));
        // As image_geometry has it.
        (self.picture(), [fx / across, fy / down, (cx - x) / across, (cy - y) / down])
    }
}

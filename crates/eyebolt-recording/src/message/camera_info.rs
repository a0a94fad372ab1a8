//! `sensor_msgs/CameraInfo`.

use super::header::Header;
use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;

/// Intrinsics of a camera, as its driver says them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CameraInfoMessage<'a> {
    pub(crate) header: Header<'a>,
    pub(crate) height: u32,
    pub(crate) width: u32,
    pub(crate) distortion_model: &'a str,
    /// Coefficients of the lens.
    pub(crate) d: Vec<f64>,
    /// 3 x 3, rows: intrinsics of the picture as taken.
    pub(crate) k: [f64; 9],
    /// 3 x 3, rows: turns into the rectified frame.
    pub(crate) r: [f64; 9],
    /// 3 x 4, rows: intrinsics of the rectified picture.
    pub(crate) p: [f64; 12],
    /// Pixels of the sensor that make one of the picture, in x and y; 0 is 1.
    pub(crate) binning: [u32; 2],
    /// The part of the sensor that is seen: x and y of its corner, height and width; all 0 is all.
    pub(crate) roi: [u32; 4],
    pub(crate) do_rectify: bool,
}

impl<'a> CameraInfoMessage<'a> {
    pub(crate) fn read(reader: &mut WireReader<'a>) -> Result<Self, WireProblem> {
        Ok(Self {
            header: Header::read(reader)?,
            height: reader.u32("height")?,
            width: reader.u32("width")?,
            distortion_model: reader.string("distortion_model")?,
            d: reader.f64_sequence("d")?,
            k: reader.f64_array("k")?,
            r: reader.f64_array("r")?,
            p: reader.f64_array("p")?,
            binning: [reader.u32("binning_x")?, reader.u32("binning_y")?],
            roi: [
                reader.u32("roi.x_offset")?,
                reader.u32("roi.y_offset")?,
                reader.u32("roi.height")?,
                reader.u32("roi.width")?,
            ],
            do_rectify: reader.bool("roi.do_rectify")?,
        })
    }

    pub(crate) fn write(&self) -> Vec<u8> {
        let mut writer = WireWriter::new();
        self.header.write(&mut writer);
        writer.u32(self.height);
        writer.u32(self.width);
        writer.string(self.distortion_model);
        writer.f64_sequence(&self.d);
        writer.f64_array(&self.k);
        writer.f64_array(&self.r);
        writer.f64_array(&self.p);
        self.binning.iter().chain(&self.roi).for_each(|number| writer.u32(*number));
        writer.bool(self.do_rectify);
        writer.finish()
    }
}

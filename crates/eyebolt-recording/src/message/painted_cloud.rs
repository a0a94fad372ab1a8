//! Clouds for viewers: points with a colour and further numbers.

use super::cloud::{CloudMessage, PointField};
use super::header::Header;

/// Numbers of the points of a cloud, one each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointValues<'a> {
    /// As `uint32`, as PCL has labels.
    Whole(&'a [u32]),
    /// As `float32`.
    Real(&'a [f32]),
}

/// Points that a viewer shows in their colours, or in those of one of their numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaintedCloud<'a> {
    /// In the frame of the message, metres.
    pub points_m: &'a [[f32; 3]],
    /// Of each point red, green, blue.
    pub rgb: &'a [[u8; 3]],
    /// Further numbers by their names, one for each point.
    pub values: &'a [(&'a str, PointValues<'a>)],
}

const UINT32: u8 = 6;
const FLOAT32: u8 = 7;
/// Bytes of every number.
const SIZE: u32 = 4;

impl PaintedCloud<'_> {
    /// A `sensor_msgs/PointCloud2` in CDR: x, y, z, `rgb` as PCL and RViz have it (in the bits of a float), then the values.
    /// Points beyond the shortest of the lists are left out.
    pub fn message(&self, frame_id: &str, stamp_ns: i64) -> Vec<u8> {
        let lengths = self.values.iter().map(|(_, values)| values.len());
        let count = lengths.chain([self.points_m.len(), self.rgb.len()]).min().unwrap_or(0);
        let mut data = Vec::with_capacity(count * (4 + self.values.len()) * SIZE as usize);
        for at in 0..count {
            self.points_m[at].iter().for_each(|value| data.extend(value.to_le_bytes()));
            let [red, green, blue] = self.rgb[at];
            data.extend([blue, green, red, 0]);
            self.values.iter().for_each(|(_, values)| data.extend(values.bytes(at)));
        }
        let fields = self.fields();
        let point_step = SIZE * fields.len() as u32;
        let width = u32::try_from(count).unwrap_or(u32::MAX);
        CloudMessage {
            header: Header { stamp_ns, frame_id },
            height: 1,
            width,
            fields,
            big_endian: false,
            point_step,
            row_step: width.saturating_mul(point_step),
            data: &data,
            is_dense: true,
        }
        .write()
    }

    fn fields(&self) -> Vec<PointField<'_>> {
        let coordinates = ["x", "y", "z", "rgb"].map(|name| (name, FLOAT32));
        let values = self.values.iter().map(|(name, values)| (*name, values.datatype()));
        let named = coordinates.into_iter().chain(values).zip(0..);
        named
            .map(|((name, datatype), at)| PointField {
                name,
                offset: SIZE * at,
                datatype,
                count: 1,
            })
            .collect()
    }
}

impl PointValues<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Real(values) => values.len(),
        }
    }

    fn datatype(&self) -> u8 {
        match self {
            Self::Whole(_) => UINT32,
            Self::Real(_) => FLOAT32,
        }
    }

    fn bytes(&self, at: usize) -> [u8; SIZE as usize] {
        match self {
            Self::Whole(values) => values[at].to_le_bytes(),
            Self::Real(values) => values[at].to_le_bytes(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message::WireReader;

    /// As a reader of ours has it: points where they were, and each number at the offset that its field says.
    #[test]
    fn points_and_their_numbers_are_where_the_fields_say() {
        let cloud = PaintedCloud {
            points_m: &[[1.0, 2.0, 3.0], [-1.0, 0.5, 0.25]],
            rgb: &[[1, 2, 3], [250, 251, 252]],
            values: &[
                ("label", PointValues::Whole(&[7, 70_000])),
                ("probability", PointValues::Real(&[0.5, 0.75])),
            ],
        };
        let bytes = cloud.message("camera", 1_500_000_000);
        let read =
            CloudMessage::read(&mut WireReader::new(&crate::bag::Encoding::Cdr, &bytes).unwrap())
                .unwrap();
        assert_eq!(read.header, Header { stamp_ns: 1_500_000_000, frame_id: "camera" });
        assert_eq!(read.points().unwrap(), cloud.points_m);
        let of = |name: &str, point: usize| {
            let field = read.fields.iter().find(|field| field.name == name).unwrap();
            let at = point * read.point_step as usize + field.offset as usize;
            (field.datatype, <[u8; 4]>::try_from(&read.data[at..at + 4]).unwrap())
        };
        assert_eq!(of("rgb", 1), (FLOAT32, [252, 251, 250, 0]));
        assert_eq!(of("label", 1), (UINT32, 70_000_u32.to_le_bytes()));
        assert_eq!(of("probability", 0), (FLOAT32, 0.5_f32.to_le_bytes()));
        assert_eq!(read.data.len(), 2 * read.point_step as usize);
    }

    #[test]
    fn a_list_that_is_too_short_leaves_points_out() {
        let values = [("label", PointValues::Whole(&[1]))];
        let cloud =
            PaintedCloud { points_m: &[[1.0; 3], [2.0; 3]], rgb: &[[0; 3]; 2], values: &values };
        let bytes = cloud.message("", 0);
        let read =
            CloudMessage::read(&mut WireReader::new(&crate::bag::Encoding::Cdr, &bytes).unwrap())
                .unwrap();
        assert_eq!(read.points().unwrap(), [[1.0; 3]]);
    }
}

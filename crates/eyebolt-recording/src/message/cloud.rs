//! `sensor_msgs/PointCloud2`.

use super::header::Header;
use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;

/// One number of every point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PointField<'a> {
    pub(crate) name: &'a str,
    /// First byte in the point.
    pub(crate) offset: u32,
    /// 7 is float32, 8 float64; the others are integers.
    pub(crate) datatype: u8,
    pub(crate) count: u32,
}

/// Points, row by row where they come from an image.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CloudMessage<'a> {
    pub(crate) header: Header<'a>,
    pub(crate) height: u32,
    pub(crate) width: u32,
    pub(crate) fields: Vec<PointField<'a>>,
    pub(crate) big_endian: bool,
    /// Bytes from one point to the next.
    pub(crate) point_step: u32,
    /// Bytes from one row to the next.
    pub(crate) row_step: u32,
    pub(crate) data: &'a [u8],
    pub(crate) is_dense: bool,
}

const FLOAT32: u8 = 7;
const FLOAT64: u8 = 8;
/// Bytes of a field with an empty name.
const SMALLEST_FIELD: usize = 13;
/// Points of the largest cloud: twice what a camera with 4K gives.
const MOST_POINTS: usize = 1 << 24;

impl<'a> CloudMessage<'a> {
    pub(crate) fn read(reader: &mut WireReader<'a>) -> Result<Self, WireProblem> {
        let header = Header::read(reader)?;
        let (height, width) = (reader.u32("height")?, reader.u32("width")?);
        let count = reader.count("fields", SMALLEST_FIELD)?;
        let mut field = || {
            Ok(PointField {
                name: reader.string("fields.name")?,
                offset: reader.u32("fields.offset")?,
                datatype: reader.u8("fields.datatype")?,
                count: reader.u32("fields.count")?,
            })
        };
        let fields = (0..count).map(|_| field()).collect::<Result<Vec<_>, WireProblem>>()?;
        Ok(Self {
            header,
            height,
            width,
            fields,
            big_endian: reader.bool("is_bigendian")?,
            point_step: reader.u32("point_step")?,
            row_step: reader.u32("row_step")?,
            data: reader.blob("data")?,
            is_dense: reader.bool("is_dense")?,
        })
    }

    pub(crate) fn write(&self) -> Vec<u8> {
        let mut writer = WireWriter::new();
        self.header.write(&mut writer);
        writer.u32(self.height);
        writer.u32(self.width);
        writer.count(self.fields.len());
        for field in &self.fields {
            writer.string(field.name);
            writer.u32(field.offset);
            writer.u8(field.datatype);
            writer.u32(field.count);
        }
        writer.bool(self.big_endian);
        writer.u32(self.point_step);
        writer.u32(self.row_step);
        writer.blob(self.data);
        writer.bool(self.is_dense);
        writer.finish()
    }

    /// x, y and z of every point as stored, `width * height` of them, row by row.
    pub(crate) fn points(&self) -> Result<Vec<[f32; 3]>, WireProblem> {
        self.stored()?.collect()
    }

    /// Whether there is a point.
    pub(crate) fn has_point(&self) -> Result<bool, WireProblem> {
        for point in self.stored()? {
            let point = point?;
            if point.iter().all(|c| c.is_finite()) && point != [0.0; 3] {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn stored(
        &self,
    ) -> Result<impl Iterator<Item = Result<[f32; 3], WireProblem>> + '_, WireProblem> {
        let axes = [self.axis("x")?, self.axis("y")?, self.axis("z")?];
        let (width, height) = (self.width as usize, self.height as usize);
        let (point, row) = (self.point_step as usize, self.row_step as usize);
        let count = width.saturating_mul(height);
        let used = point.saturating_mul(width);
        if count == 0 || count > MOST_POINTS {
            return Err(WireProblem::new("width", format!("{width} x {height} points")));
        }
        if point == 0 || (height > 1 && row < used) {
            let problem = format!("{row} bytes do not hold {width} points of {point} bytes");
            return Err(WireProblem::new("row_step", problem));
        }
        // With one row, nobody needs its step, and some drivers leave it at zero.
        let row = row.max(used);
        let least = row.saturating_mul(height - 1).saturating_add(used);
        if self.data.len() < least {
            let problem =
                format!("{} bytes do not hold {width} x {height} points", self.data.len());
            return Err(WireProblem::new("data", problem));
        }
        let rows = self.data.chunks(row).take(height);
        let points = rows.flat_map(move |row| row.chunks(point).take(width));
        Ok(points.map(move |bytes| self.point(bytes, axes)))
    }

    fn point(&self, bytes: &[u8], axes: [(usize, u8); 3]) -> Result<[f32; 3], WireProblem> {
        let number = |(offset, datatype): (usize, u8)| match datatype {
            FLOAT64 => float(bytes, offset, self.big_endian, f64::from_le_bytes).map(|v| v as f32),
            _ => float(bytes, offset, self.big_endian, f32::from_le_bytes),
        };
        let [x, y, z] = axes.map(number);
        let outside = || WireProblem::new("fields.offset", "a coordinate lies outside its point");
        Ok([x.ok_or_else(outside)?, y.ok_or_else(outside)?, z.ok_or_else(outside)?])
    }

    /// Offset and type of the coordinate `name`.
    fn axis(&self, name: &str) -> Result<(usize, u8), WireProblem> {
        let field = self.fields.iter().find(|field| field.name == name);
        match field {
            Some(field) if matches!(field.datatype, FLOAT32 | FLOAT64) && field.count <= 1 => {
                Ok((field.offset as usize, field.datatype))
            }
            Some(_) => {
                Err(WireProblem::new("fields", format!("{name} is not one float32 or float64")))
            }
            None => Err(WireProblem::new("fields", format!("there is no field {name}"))),
        }
    }
}

fn float<const N: usize, T>(
    bytes: &[u8],
    offset: usize,
    big_endian: bool,
    number: impl Fn([u8; N]) -> T,
) -> Option<T> {
    let mut stored: [u8; N] = *bytes.get(offset..)?.first_chunk::<N>()?;
    if big_endian {
        stored.reverse();
    }
    Some(number(stored))
}

//! `sensor_msgs/JointState`.

use super::header::Header;
use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;

/// Positions of joints. Velocities and efforts are of no use here.
///
/// A position belongs to the name of its index. Not every publisher tells as many of both; commands
/// of velocity or effort alone come without positions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointStateMessage<'a> {
    pub(crate) header: Header<'a>,
    pub(crate) names: Vec<&'a str>,
    /// Radians or metres, in the order of the names.
    pub(crate) positions: Vec<f64>,
}

/// Bytes of an empty text.
const SMALLEST_TEXT: usize = 4;

impl<'a> JointStateMessage<'a> {
    pub(crate) fn read(reader: &mut WireReader<'a>) -> Result<Self, WireProblem> {
        let header = Header::read(reader)?;
        let count = reader.count("name", SMALLEST_TEXT)?;
        let names = (0..count).map(|_| reader.string("name")).collect::<Result<Vec<_>, _>>()?;
        let positions = reader.f64_sequence("position")?;
        Ok(Self { header, names, positions })
    }

    pub(crate) fn write(&self) -> Vec<u8> {
        let mut writer = WireWriter::new();
        self.header.write(&mut writer);
        writer.count(self.names.len());
        self.names.iter().for_each(|name| writer.string(name));
        writer.f64_sequence(&self.positions);
        // Neither velocities nor efforts.
        writer.count(0);
        writer.count(0);
        writer.finish()
    }
}

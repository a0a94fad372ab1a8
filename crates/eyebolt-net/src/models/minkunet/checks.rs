//! What a description of a network may ask for. It may come from a file of anybody's.

use crate::Error;

/// More channels are a mistake, or malice.
const MOST_CHANNELS: usize = 1 << 12;
/// More blocks of a stage, or layers of a head; the deepest that is published has 23.
const MOST_LAYERS: usize = 64;

/// Blocks of stages.
pub fn blocks(field: &str, counts: &[usize]) -> Result<(), Error> {
    within(field, "blocks", counts, MOST_LAYERS)
}

/// Channels of layers.
pub fn channels(field: &str, counts: &[usize]) -> Result<(), Error> {
    within(field, "channels", counts, MOST_CHANNELS)
}

/// Channels of the layers of a head, of which there must be one.
pub fn widths(field: &str, counts: &[usize]) -> Result<(), Error> {
    if !(1..=MOST_LAYERS).contains(&counts.len()) {
        let problem = format!("{} layers; there must be 1 to {MOST_LAYERS}", counts.len());
        return Err(Error::network(field, problem));
    }
    channels(field, counts)
}

/// Edge of the first convolution's kernel.
pub fn stem_kernel(size: u32) -> Result<(), Error> {
    if matches!(size, 1 | 3 | 5 | 7) {
        return Ok(());
    }
    Err(Error::network("minkunet", format!("stem_kernel {size}; it is 1, 3, 5 or 7")))
}

fn within(field: &str, what: &str, counts: &[usize], most: usize) -> Result<(), Error> {
    match counts.iter().find(|count| !(1..=most).contains(*count)) {
        Some(count) => {
            Err(Error::network(field, format!("{count} {what}; there must be 1 to {most}")))
        }
        None => Ok(()),
    }
}

//! Networks by the names that MinkowskiEngine's code gives them.

use super::blocks::Block;
use super::encoder::MinkEncoder;
use super::segmentation::{Head, MinkUNet};
use crate::Error;

/// Channels of the first convolution, and of the stages down.
const STEM: usize = 32;
const DOWN: [usize; 4] = [32, 64, 128, 256];

impl MinkUNet {
    /// A network by its published name: `minkunet14a` to `d`, `18a`, `b`, `d`, `34a` to `c`, `50`,
    /// `101`. `minkunet18d` is the one of Sefercik and Akgun.
    ///
    /// # Errors
    /// If there is no such network.
    pub fn named(name: &str, inputs: usize, outputs: usize) -> Result<Self, Error> {
        let unknown = || unknown(name, "minkunet14a, b, c, d, 18a, b, d, 34a, b, c, 50 and 101");
        let short = short(name);
        let up = match short.as_str() {
            "14a" | "18a" => [128, 128, 96, 96],
            "14b" | "18b" => [128; 4],
            "14c" => [192, 192, 128, 128],
            "14d" | "18d" => [384; 4],
            "34a" => [256, 128, 64, 64],
            "34b" => [256, 128, 64, 32],
            "34c" | "50" | "101" => [256, 128, 96, 96],
            _ => return Err(unknown()),
        };
        let depth = short.trim_end_matches(['a', 'b', 'c', 'd']);
        let (block, [a, b, c, d]) = encoder_of(depth).ok_or_else(unknown)?;
        let each_up = if depth == "14" { 1 } else { 2 };
        Ok(Self {
            block,
            layers: [a, b, c, d, each_up, each_up, each_up, each_up],
            channels: [DOWN[0], DOWN[1], DOWN[2], DOWN[3], up[0], up[1], up[2], up[3]],
            stem_channels: STEM,
            stem_kernel: 5,
            flat: false,
            inputs,
            outputs,
            head: Head::Convolution,
        })
    }
}

impl MinkEncoder {
    /// Of a network by its published name, `minkunet14`, `18`, `34`, `50` or `101`; a letter behind
    /// it changes nothing, as those of one number have the same encoder.
    ///
    /// # Errors
    /// If there is no such network.
    pub fn named(name: &str, inputs: usize, widths: &[usize]) -> Result<Self, Error> {
        let short = short(name);
        let depth = short.strip_suffix(['a', 'b', 'c', 'd']).unwrap_or(&short);
        let known = "minkunet14, 18, 34, 50 and 101, each also with a letter from a to d";
        let (block, layers) = encoder_of(depth).ok_or_else(|| unknown(name, known))?;
        Ok(Self {
            block,
            layers,
            channels: DOWN,
            stem_channels: STEM,
            stem_kernel: 5,
            flat: false,
            inputs,
            widths: widths.to_vec(),
        })
    }
}

/// Kind and number of the blocks of each stage down.
fn encoder_of(depth: &str) -> Option<(Block, [usize; 4])> {
    Some(match depth {
        "14" => (Block::Basic, [1; 4]),
        "18" => (Block::Basic, [2; 4]),
        "34" => (Block::Basic, [2, 3, 4, 6]),
        "50" => (Block::Bottleneck, [2, 3, 4, 6]),
        "101" => (Block::Bottleneck, [2, 3, 4, 23]),
        _ => return None,
    })
}

/// What stands behind `minkunet`.
fn short(name: &str) -> String {
    let lower = name.to_lowercase();
    lower.strip_prefix("minkunet").map_or(lower.clone(), str::to_owned)
}

fn unknown(name: &str, known: &str) -> Error {
    Error::network(name, format!("not known; there are {known}"))
}

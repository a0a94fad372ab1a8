//! The MinkUNet family (Choy, Gwak and Savarese, *4D spatio-temporal ConvNets: Minkowski
//! convolutional neural networks*, CVPR 2019, with the names and layers of its published code).

mod blocks;

use crate::Error;
use crate::coordinates::{Kernel, KernelSpec};
use crate::graph::{Domain, Graph, GraphBuilder, MapSpec, NodeId, Source};
use blocks::{convolution_norm_relu, stage};
use serde::{Deserialize, Serialize};

/// Slope of negative values in heads.
const HEAD_SLOPE: f32 = 0.01;

/// More channels, or blocks, are a mistake, or malice.
const MOST: usize = 1 << 12;

/// What a stage is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Block {
    /// Two convolutions.
    Basic,
    /// One of three voxels between two of one; four times as many channels leave it.
    Bottleneck,
}

impl Block {
    fn expansion(self) -> usize {
        match self {
            Self::Basic => 1,
            Self::Bottleneck => 4,
        }
    }
}

/// How logits are made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Head {
    /// A convolution of one voxel, `final`, as published.
    Convolution,
    /// `final` to so many channels, then linear layers with leaky ReLU between them: `[256, 1024]`
    /// is the paper's 256 -> 1024 -> classes.
    Hidden(Vec<usize>),
}

/// A network of the family.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MinkUNet {
    /// What stages are made of.
    pub block: Block,
    /// Blocks of each stage, four down and four up.
    pub layers: [usize; 8],
    /// Channels of each stage.
    pub channels: [usize; 8],
    /// Channels of the first convolution.
    pub stem_channels: usize,
    /// Its size: 5 as published, 3 in the paper.
    pub stem_kernel: u32,
    /// Features of a voxel.
    pub inputs: usize,
    /// Classes.
    pub outputs: usize,
    /// How logits are made.
    pub head: Head,
}

impl MinkUNet {
    /// A network by its published name: `minkunet14a` to `d`, `18a`, `b`, `d`, `34a` to `c`, `50`,
    /// `101`.
    ///
    /// # Errors
    /// If there is no such network.
    pub fn named(name: &str, inputs: usize, outputs: usize) -> Result<Self, Error> {
        let lower = name.to_lowercase();
        let short = lower.strip_prefix("minkunet").unwrap_or(&lower);
        let up = match short {
            "14a" | "18a" => [128, 128, 96, 96],
            "14b" | "18b" => [128; 4],
            "14c" => [192, 192, 128, 128],
            "14d" | "18d" => [384; 4],
            "34a" => [256, 128, 64, 64],
            "34b" => [256, 128, 64, 32],
            "34c" | "50" | "101" => [256, 128, 96, 96],
            _ => {
                let known = "minkunet14a, b, c, d, 18a, b, d, 34a, b, c, 50 and 101";
                return Err(Error::network(name, format!("not known; there are {known}")));
            }
        };
        let (block, layers) = match &short[..2] {
            "14" => (Block::Basic, [1; 8]),
            "18" => (Block::Basic, [2; 8]),
            "34" => (Block::Basic, [2, 3, 4, 6, 2, 2, 2, 2]),
            "50" => (Block::Bottleneck, [2, 3, 4, 6, 2, 2, 2, 2]),
            _ => (Block::Bottleneck, [2, 3, 4, 23, 2, 2, 2, 2]),
        };
        let channels = [32, 64, 128, 256, up[0], up[1], up[2], up[3]];
        Ok(Self {
            block,
            layers,
            channels,
            stem_channels: 32,
            stem_kernel: 5,
            inputs,
            outputs,
            head: Head::Convolution,
        })
    }

    /// The segmentation network: logits of every point, by its voxel.
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn graph(&self) -> Result<Graph, Error> {
        let mut g = GraphBuilder::new();
        let mut skips = self.encoder(&mut g)?;
        let mut x = skips.pop().expect("the encoder gives five");
        for (stage_up, stride) in [8, 4, 2, 1].into_iter().enumerate() {
            let index = 4 + stage_up;
            let name = format!("convtr{index}p{}s2", 2 * stride);
            let spec = KernelSpec { kernel: Kernel::new(2), from: 2 * stride, to: stride };
            let norm = format!("bntr{index}");
            x = convolution_norm_relu(&mut g, &name, &norm, x, spec, self.channels[index])?;
            let skip = skips.pop().expect("one for every stage up");
            x = g.concatenate(&format!("cat{index}"), &[x, skip])?;
            x = self.stage(&mut g, index, x, stride)?;
        }
        let x = self.logits(&mut g, x)?;
        let points = g.combine("slice", x, MapSpec::Slice)?;
        g.finish(&[points])
    }

    /// The encoder alone, its mean over each item, and linear layers of these widths with leaky
    /// ReLU between them, `regression.0`, `regression.1`, ...; the paper's rotation network is
    /// `[2048, 4]`.
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn regression_graph(&self, widths: &[usize]) -> Result<Graph, Error> {
        let mut g = GraphBuilder::new();
        let encoded = self.encoder(&mut g)?.pop().expect("the encoder gives five");
        let mean = MapSpec::Means(Domain::Voxels { stride: 16 });
        let mut x = g.combine("mean", encoded, mean)?;
        for (index, &width) in widths.iter().enumerate() {
            if index > 0 {
                x = g.leaky_relu(x, HEAD_SLOPE);
            }
            x = g.linear(&format!("regression.{index}"), x, width, true);
        }
        g.finish(&[x])
    }

    fn check(&self) -> Result<(), Error> {
        let hidden = match &self.head {
            Head::Convolution => &[][..],
            Head::Hidden(widths) => widths,
        };
        let more = [self.stem_channels, self.inputs, self.outputs];
        let mut counts = self.channels.iter().chain(&more).chain(&self.layers).chain(hidden);
        match counts.find(|count| !(1..=MOST).contains(*count)) {
            Some(count) => {
                let problem = format!("{count} channels or layers; there must be 1 to {MOST}");
                Err(Error::network("minkunet", problem))
            }
            None if !matches!(self.stem_kernel, 1 | 3 | 5 | 7) => {
                let problem = format!("stem_kernel {}; it is 1, 3, 5 or 7", self.stem_kernel);
                Err(Error::network("minkunet", problem))
            }
            None => Ok(()),
        }
    }

    /// Values of strides 1, 2, 4, 8 and 16.
    fn encoder(&self, g: &mut GraphBuilder) -> Result<Vec<NodeId>, Error> {
        self.check()?;
        let input = g.input(Source::Features, Domain::Voxels { stride: 1 }, self.inputs);
        let stem = KernelSpec { kernel: Kernel::new(self.stem_kernel), from: 1, to: 1 };
        let mut x = convolution_norm_relu(g, "conv0p1s1", "bn0", input, stem, self.stem_channels)?;
        let mut values = vec![x];
        for (index, stride) in [1, 2, 4, 8].into_iter().enumerate() {
            let name = format!("conv{}p{stride}s2", index + 1);
            let spec = KernelSpec { kernel: Kernel::new(2), from: stride, to: 2 * stride };
            let channels = g.channels(x);
            x = convolution_norm_relu(g, &name, &format!("bn{}", index + 1), x, spec, channels)?;
            x = self.stage(g, index, x, 2 * stride)?;
            values.push(x);
        }
        Ok(values)
    }

    fn stage(
        &self,
        g: &mut GraphBuilder,
        index: usize,
        mut x: NodeId,
        stride: u32,
    ) -> Result<NodeId, Error> {
        for block in 0..self.layers[index] {
            let name = format!("block{}.{block}", index + 1);
            x = stage(g, &name, self.block, x, self.channels[index], stride)?;
        }
        Ok(x)
    }

    fn logits(&self, g: &mut GraphBuilder, x: NodeId) -> Result<NodeId, Error> {
        let plain = KernelSpec { kernel: Kernel::new(1), from: 1, to: 1 };
        let Head::Hidden(widths) = &self.head else {
            return g.convolution("final", x, plain, self.outputs, true);
        };
        let Some((&first, hidden)) = widths.split_first() else {
            return Err(Error::network("head", "no hidden channels"));
        };
        let mut x = g.convolution("final", x, plain, first, true)?;
        for (index, &width) in hidden.iter().chain([&self.outputs]).enumerate() {
            x = g.leaky_relu(x, HEAD_SLOPE);
            x = g.linear(&format!("head.{index}"), x, width, true);
        }
        Ok(x)
    }
}

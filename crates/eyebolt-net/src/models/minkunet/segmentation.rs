//! The way down and up again, for segmentation.

use super::blocks::{Block, HEAD_SLOPE, convolution_norm_relu, stage};
use super::checks;
use super::encoder::MinkEncoder;
use crate::Error;
use crate::coordinates::{Kernel, KernelSpec};
use crate::graph::{Graph, GraphBuilder, NodeId};
use serde::{Deserialize, Serialize};

/// How logits are made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Head {
    /// A convolution of one voxel, `final`, as MinkowskiEngine has it.
    Convolution,
    /// `final` to so many channels, then linear layers with leaky ReLU between them: `[256, 1024]`
    /// is the 256 -> 1024 -> classes with which the code of Sefercik and Akgun segments.
    Hidden(Vec<usize>),
}

/// A network of the family, for segmentation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MinkUNet {
    /// What stages are made of.
    #[doc(alias = "BLOCK")]
    pub block: Block,
    /// Blocks of each stage, four down and four up; 1 to 64.
    #[doc(alias = "LAYERS")]
    pub layers: [usize; 8],
    /// Channels of each stage; 1 to 4096.
    #[doc(alias = "PLANES")]
    pub channels: [usize; 8],
    /// Channels of the first convolution.
    #[doc(alias = "INIT_DIM")]
    pub stem_channels: usize,
    /// Its size: 5 as MinkowskiEngine has it, 3 in the code of Sefercik and Akgun.
    pub stem_kernel: u32,
    /// Whether it is on images: all kernels lie in the plane of x and y, and pixels are voxels with
    /// z = 0. Pixels that saw nothing are not there, as empty voxels are not.
    #[serde(default)]
    pub flat: bool,
    /// Features of a voxel.
    #[doc(alias = "in_channels")]
    pub inputs: usize,
    /// Classes.
    #[doc(alias = "out_channels")]
    pub outputs: usize,
    /// How logits are made.
    pub head: Head,
}

impl MinkUNet {
    /// For segmentation: logits of every point, by its voxel.
    ///
    /// A loss over them weighs a voxel by the points in it, and points are what counts in the end.
    /// [`MinkUNet::voxel_graph`] has one row for each voxel instead.
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn graph(&self) -> Result<Graph, Error> {
        let mut g = self.encoder().builder();
        let logits = self.voxel_logits(&mut g)?;
        let points = g.slice("slice", logits)?;
        g.finish(&[points])
    }

    /// For segmentation, as MinkowskiEngine trains it: logits of every finest voxel, in the order
    /// of [`VoxelSet::new`](crate::coordinates::VoxelSet::new), each with the same weight in a loss
    /// however many points it has.
    ///
    /// [`vote_labels`](crate::coordinates::vote_labels) makes the labels of voxels from those of
    /// points. Parameters are those of [`MinkUNet::graph`].
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn voxel_graph(&self) -> Result<Graph, Error> {
        let mut g = self.encoder().builder();
        let logits = self.voxel_logits(&mut g)?;
        g.finish(&[logits])
    }

    fn voxel_logits(&self, g: &mut GraphBuilder) -> Result<NodeId, Error> {
        self.check()?;
        let [mut skips @ .., mut x] = self.encoder().values(g)?;
        skips.reverse();
        for (up, skip) in skips.into_iter().enumerate() {
            let (index, stride) = (4 + up, 8 >> up);
            let (name, norm) = (format!("convtr{index}p{}s2", 2 * stride), format!("bntr{index}"));
            let spec = KernelSpec::up(2, 2 * stride, 2);
            x = convolution_norm_relu(g, &name, &norm, x, spec, self.channels[index])?;
            x = g.concatenate(&format!("cat{index}"), &[x, skip])?;
            let (blocks, channels) = (self.layers[index], self.channels[index]);
            x = stage(g, index, self.block, blocks, x, channels, stride)?;
        }
        self.head(g, x)
    }

    /// Its way down.
    fn encoder(&self) -> MinkEncoder {
        let ([layers @ .., _, _, _, _], [channels @ .., _, _, _, _]) = (self.layers, self.channels);
        MinkEncoder {
            block: self.block,
            layers,
            channels,
            stem_channels: self.stem_channels,
            stem_kernel: self.stem_kernel,
            flat: self.flat,
            inputs: self.inputs,
            widths: vec![],
        }
    }

    fn head(&self, g: &mut GraphBuilder, x: NodeId) -> Result<NodeId, Error> {
        let plain = KernelSpec::within(Kernel::new(1), 1);
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

    fn check(&self) -> Result<(), Error> {
        checks::blocks("layers", &self.layers)?;
        checks::channels("channels", &self.channels)?;
        checks::channels("outputs", &[self.outputs])?;
        match &self.head {
            Head::Convolution => Ok(()),
            Head::Hidden(widths) => checks::widths("head", widths),
        }
    }
}

//! The way down of a MinkUNet, and networks that end there.

use super::blocks::{Block, HEAD_SLOPE, convolution_norm_relu, stage};
use super::checks;
use crate::Error;
use crate::coordinates::{Kernel, KernelSpec};
use crate::graph::{Domain, Graph, GraphBuilder, NodeId, Source};
use serde::{Deserialize, Serialize};

/// The encoder of a [`MinkUNet`](super::MinkUNet), its mean over each item, and linear layers with
/// leaky ReLU between them: a few numbers for each cloud.
///
/// Sefercik and Akgun regress the rotation of an end-effector, a quaternion, by that of MinkUNet18D;
/// in their code the layers are `[2048, 4]`.
///
/// # What a batch must have to train it
///
/// Batch norm is over all rows of the batch, and the last ones are at stride 16: there must be more
/// than one voxel of 16 finest an edge, in one item or in several. Of a single row it would leave
/// nothing of the input, so an executor refuses that; of two, little more than a sign. The more of
/// them the better: Sefercik and Akgun's code takes 32 clouds at a time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MinkEncoder {
    /// What stages are made of.
    pub block: Block,
    /// Blocks of each stage; 1 to 64.
    #[doc(alias = "LAYERS")]
    pub layers: [usize; 4],
    /// Channels of each stage; 1 to 4096.
    #[doc(alias = "PLANES")]
    pub channels: [usize; 4],
    /// Channels of the first convolution.
    #[doc(alias = "INIT_DIM")]
    pub stem_channels: usize,
    /// Its size: 1, 3, 5 or 7.
    pub stem_kernel: u32,
    /// Whether it is on images: all kernels lie in the plane of x and y, and pixels are voxels with
    /// z = 0. Pixels that saw nothing are not there, as empty voxels are not.
    #[serde(default)]
    pub flat: bool,
    /// Features of a voxel.
    pub inputs: usize,
    /// Channels of the linear layers, of which the last are the outputs.
    pub widths: Vec<usize>,
}

impl MinkEncoder {
    /// The network: for each item as many numbers as the last of `widths`. Linear layers are called
    /// `regression.0`, `regression.1`, ..., the encoder's as in MinkowskiEngine.
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn graph(&self) -> Result<Graph, Error> {
        checks::widths("widths", &self.widths)?;
        let mut g = self.builder();
        let [.., encoded] = self.values(&mut g)?;
        let mut x = g.global_average_pool("mean", encoded)?;
        for (index, &width) in self.widths.iter().enumerate() {
            if index > 0 {
                x = g.leaky_relu(x, HEAD_SLOPE);
            }
            x = g.linear(&format!("regression.{index}"), x, width, true);
        }
        g.finish(&[x])
    }

    pub(super) fn builder(&self) -> GraphBuilder {
        if self.flat { GraphBuilder::in_plane() } else { GraphBuilder::new() }
    }

    /// Values of strides 1, 2, 4, 8 and 16.
    pub(super) fn values(&self, g: &mut GraphBuilder) -> Result<[NodeId; 5], Error> {
        self.check()?;
        let input = g.input(Source::Features, Domain::Voxels { stride: 1 }, self.inputs);
        let stem = KernelSpec::within(Kernel::new(self.stem_kernel), 1);
        let x = convolution_norm_relu(g, "conv0p1s1", "bn0", input, stem, self.stem_channels)?;
        let mut values = [x; 5];
        for index in 0..4 {
            let stride = 1 << index;
            let (name, norm) =
                (format!("conv{}p{stride}s2", index + 1), format!("bn{}", index + 1));
            let (x, spec) = (values[index], KernelSpec::down(2, stride, 2));
            let x = convolution_norm_relu(g, &name, &norm, x, spec, g.channels(x))?;
            let (blocks, channels) = (self.layers[index], self.channels[index]);
            values[index + 1] = stage(g, index, self.block, blocks, x, channels, 2 * stride)?;
        }
        Ok(values)
    }

    fn check(&self) -> Result<(), Error> {
        checks::blocks("layers", &self.layers)?;
        checks::channels("channels", &self.channels)?;
        checks::channels("stem_channels", &[self.stem_channels])?;
        checks::channels("inputs", &[self.inputs])?;
        checks::stem_kernel(self.stem_kernel)
    }
}

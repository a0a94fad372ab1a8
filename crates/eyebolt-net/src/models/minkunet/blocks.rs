//! Residual blocks (He et al., *Deep residual learning for image recognition*, CVPR 2016).

use crate::Error;
use crate::coordinates::{Kernel, KernelSpec};
use crate::graph::{GraphBuilder, NodeId};
use serde::{Deserialize, Serialize};

/// Slope of negative values in heads.
pub(super) const HEAD_SLOPE: f32 = 0.01;

/// What a stage is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Block {
    /// Two convolutions.
    #[doc(alias = "BasicBlock")]
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

/// A convolution, a batch norm, ReLU.
pub fn convolution_norm_relu(
    g: &mut GraphBuilder,
    name: &str,
    norm: &str,
    x: NodeId,
    spec: KernelSpec,
    channels: usize,
) -> Result<NodeId, Error> {
    let x = g.convolution(name, x, spec, channels, false)?;
    let x = g.batch_norm(norm, x);
    Ok(g.relu(x))
}

/// The blocks of a stage, `block1.0`, `block1.1`, ... of the first.
pub fn stage(
    g: &mut GraphBuilder,
    index: usize,
    block: Block,
    blocks: usize,
    mut x: NodeId,
    channels: usize,
    stride: u32,
) -> Result<NodeId, Error> {
    for place in 0..blocks {
        let name = format!("block{}.{place}", index + 1);
        x = residual(g, &name, block, x, channels, stride)?;
    }
    Ok(x)
}

/// One block. The shortcut is a convolution of one voxel where channels change.
fn residual(
    g: &mut GraphBuilder,
    name: &str,
    block: Block,
    x: NodeId,
    channels: usize,
    stride: u32,
) -> Result<NodeId, Error> {
    let spec = |size| KernelSpec::within(Kernel::new(size), stride);
    let out = channels * block.expansion();
    let sizes: &[u32] = match block {
        Block::Basic => &[3, 3],
        Block::Bottleneck => &[1, 3, 1],
    };
    // First, so that the last convolution can take the addition along.
    let shortcut = if g.channels(x) == out {
        x
    } else {
        let y = g.convolution(&format!("{name}.downsample.0"), x, spec(1), out, false)?;
        g.batch_norm(&format!("{name}.downsample.1"), y)
    };
    let mut y = x;
    for (index, &size) in sizes.iter().enumerate() {
        let is_last = index + 1 == sizes.len();
        let width = if is_last { out } else { channels };
        let (convolution, norm) =
            (format!("{name}.conv{}", index + 1), format!("{name}.norm{}", index + 1));
        y = g.convolution(&convolution, y, spec(size), width, false)?;
        y = g.batch_norm(&norm, y);
        if !is_last {
            y = g.relu(y);
        }
    }
    let sum = g.add(name, y, shortcut)?;
    Ok(g.relu(sum))
}

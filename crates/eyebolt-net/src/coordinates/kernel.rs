//! The shape of a convolution.

use crate::Error;

/// The widest kernel: beyond it the weights alone are absurd.
const MAX_SIZE: u32 = 15;
/// The largest step between resolutions, and between offsets of a kernel.
pub(super) const MAX_STEP: u32 = 64;

/// Offsets that a convolution sums over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Kernel {
    /// Voxels along each axis.
    #[doc(alias = "kernel_size")]
    pub size: u32,
    /// Voxels from one offset to the next; 1 is dense.
    pub dilation: u32,
    /// Within the plane of x and y only: a convolution of images, whose pixels are voxels with z = 0.
    pub flat: bool,
}

impl Kernel {
    /// A dense kernel.
    pub fn new(size: u32) -> Self {
        Self { size, dilation: 1, flat: false }
    }

    /// A dense kernel in the plane of x and y, for images.
    pub fn flat(size: u32) -> Self {
        Self { size, dilation: 1, flat: true }
    }

    /// Number of offsets.
    pub fn volume(self) -> usize {
        (self.size as usize).pow(if self.flat { 2 } else { 3 })
    }

    /// In order of the weights, z fastest: around the voxel where `size` is odd, from the voxel on
    /// where it is even; only those with z = 0 of a flat one.
    pub fn offsets(self) -> Vec<[i32; 3]> {
        let (size, dilation) = (self.size as i32, self.dilation as i32);
        let first = if size % 2 == 1 { -(size / 2) } else { 0 };
        let steps = move || (first..first + size).map(move |step| step * dilation);
        let deep = if self.flat { 0..1 } else { first..first + size };
        let heights: Vec<i32> = deep.map(|step| step * dilation).collect();
        let columns = steps().flat_map(|x| steps().map(move |y| [x, y]));
        columns.flat_map(|[x, y]| heights.iter().map(move |&z| [x, y, z])).collect()
    }

    /// Voxels that it reaches from the one it stands on.
    pub fn reach(self) -> u32 {
        let steps = if self.size % 2 == 1 { self.size / 2 } else { self.size - 1 };
        steps * self.dilation
    }
}

/// A convolution between two resolutions, each named by its stride: the edge of its voxels in
/// voxels of the finest.
///
/// `from < to` is a strided convolution ([`KernelSpec::down`]), `from > to` a transposed one
/// ([`KernelSpec::up`]) onto voxels that are there already, with the offsets of the strided
/// convolution back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct KernelSpec {
    /// Offsets, in voxels of the finer of both.
    pub kernel: Kernel,
    /// Stride of the input.
    pub from: u32,
    /// Stride of the output.
    pub to: u32,
}

impl KernelSpec {
    /// Within one resolution: every voxel of it from its neighbours that are occupied.
    #[doc(alias = "submanifold")]
    #[doc(alias = "SubMConv3d")]
    pub fn within(kernel: Kernel, stride: u32) -> Self {
        Self { kernel, from: stride, to: stride }
    }

    /// Strided: from voxels of stride `from` to those `factor` times as large.
    #[doc(alias = "strided")]
    #[doc(alias = "SparseConv3d")]
    pub fn down(size: u32, from: u32, factor: u32) -> Self {
        // Stride 0 is what `check` refuses.
        Self { kernel: Kernel::new(size), from, to: from.checked_mul(factor).unwrap_or(0) }
    }

    /// Transposed: from voxels of stride `from` to those a `factor`th as large, which must be there
    /// already; the convolution that undoes the shape of `down(size, from / factor, factor)`.
    #[doc(alias = "transposed")]
    #[doc(alias = "deconvolution")]
    #[doc(alias = "SparseInverseConv3d")]
    pub fn up(size: u32, from: u32, factor: u32) -> Self {
        let divides = from.checked_rem(factor) == Some(0);
        let to = if divides { from / factor } else { 0 };
        Self { kernel: Kernel::new(size), from, to }
    }

    /// The same with a [flat](Kernel::flat) kernel.
    pub fn in_plane(self) -> Self {
        Self { kernel: Kernel { flat: true, ..self.kernel }, ..self }
    }

    /// That there can be such a convolution.
    ///
    /// # Errors
    /// If the kernel is empty or too wide, or the coarser stride not a multiple of the finer.
    pub fn check(self) -> Result<(), Error> {
        let Kernel { size, dilation, .. } = self.kernel;
        let bad = |problem: String| {
            let place = format!("kernel {size}, stride {} to {}", self.from, self.to);
            Err(Error::network(place, problem))
        };
        if !(1..=MAX_SIZE).contains(&size) {
            return bad(format!("kernels have 1 to {MAX_SIZE} voxels an edge"));
        }
        if !(1..=MAX_STEP).contains(&dilation) {
            return bad(format!("dilation {dilation} is not 1 to {MAX_STEP}"));
        }
        let (fine, coarse) = (self.from.min(self.to), self.from.max(self.to));
        if fine == 0 || !coarse.is_multiple_of(fine) {
            return bad("the coarser stride must be a multiple of the finer".into());
        }
        Ok(())
    }
}

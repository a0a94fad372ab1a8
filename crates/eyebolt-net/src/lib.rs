//! Sparse convolution and point networks, trained and run on the CPU.
//!
//! The MinkUNet family and PointNet++, without CUDA and without a framework: a network is a
//! [`Graph`] of about a dozen operations, a cloud with who is whose neighbour in it a [`Batch`],
//! numbers that are learned are [`Parameters`], and an [`Executor`] brings the three together.
//! [`Cpu`] is the executor to use; [`reference::Reference`] says, slowly, what is right.
//!
//! ```
//! use eyebolt_net::coordinates::voxelise;
//! use eyebolt_net::losses::cross_entropy;
//! use eyebolt_net::models::MinkUNet;
//! use eyebolt_net::training::{Rule, Schedule, Trainer};
//! use eyebolt_net::{Batch, Cpu, Executor, Matrix};
//!
//! # fn main() -> Result<(), eyebolt_net::Error> {
//! // A plane of points, of which half are of another class.
//! let points_m: Vec<[f32; 3]> =
//!     (0..400).map(|i| [0.005 * (i % 20) as f32, 0.005 * (i / 20) as f32, 0.3]).collect();
//! let labels: Vec<u32> = (0..400).map(|i| u32::from(i % 20 < 10)).collect();
//!
//! // One feature, three classes; a small network to be quick here.
//! let mut description = MinkUNet::named("minkunet14a", 1, 3)?;
//! description.channels = [16, 16, 16, 16, 16, 16, 16, 16];
//! let graph = description.graph()?;
//!
//! let coordinates = voxelise(0, &points_m, 0.005)?;
//! let ones = Matrix::new(400, 1, vec![1.0; 400])?;
//! let batch = Batch::from_voxels(&graph, &coordinates, &ones)?;
//!
//! let mut cpu = Cpu::new();
//! let mut trainer = Trainer::new(&graph, Rule::adam(1e-4), Schedule::Constant { rate: 1e-2 }, 1);
//! let ignore = 255;
//! for _ in 0..5 {
//!     trainer.step(&mut cpu, &graph, &batch, |outputs| {
//!         Ok(vec![cross_entropy(&outputs[0], &labels, ignore, None)?])
//!     })?;
//! }
//! let logits = cpu.infer(&graph, trainer.parameters(), &batch)?;
//! assert_eq!((logits[0].rows(), logits[0].channels()), (400, 3));
//! # Ok(())
//! # }
//! ```
//!
//! # Where things are
//!
//! - [`coordinates`]: from points to voxels, and which voxel a weight of a kernel meets.
//! - [`graph`]: operations; [`models`]: the networks made of them, and `model.toml`.
//! - [`weights`]: safetensors, also of MinkowskiEngine.
//! - [`losses`], [`training`]: gradients, optimisers, checkpoints.
//! - [`sampling`]: points chosen and grouped, as PointNet++ does.
//!
//! # How it is fast
//!
//! Who meets whom is found once for each resolution. Output rows are cut into blocks; for each
//! block, panel of channels and offset of the kernel, an inner loop multiplies straight through the
//! list of pairs and adds to sums that stay in cache, which are written once, batch norm, addition
//! and activation included. Nothing is gathered, scattered or locked: the same input gives the
//! same bytes on any number of threads. Instructions (AVX-512, AVX2, NEON) are chosen at run time,
//! so bytes differ between kinds of processors.

mod batch;
pub mod coordinates;
mod cpu;
mod error;
pub mod executor;
pub mod graph;
mod identity;
pub mod losses;
mod matrix;
pub mod models;
mod parameters;
mod random;
pub mod reference;
mod row_map;
pub mod sampling;
mod simd;
pub mod training;
pub mod weights;

pub use batch::{Batch, Map, Sampling};
pub use cpu::Cpu;
pub use error::Error;
pub use executor::{Executor, Forward, Gradients, PassOptions};
pub use graph::{Graph, GraphBuilder};
pub use matrix::Matrix;
pub use parameters::Parameters;
pub use row_map::{RowMap, Runs};
pub use simd::Isa;

/// The examples of the README are tested as those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! Weights as safetensors: ours, and state dicts of MinkowskiEngine.
//!
//! Ours hold every parameter of the graph under its name, with its shape. Kernels are
//! `[offsets, inputs, outputs]`, offsets with z fastest; linear layers `[inputs, outputs]`.
//!
//! # Of MinkowskiEngine
//!
//! Its state dicts differ, which [`from_minkowski`] undoes:
//!
//! | | ours | MinkowskiEngine's |
//! |---|---|---|
//! | kernels | `conv0p1s1.kernel`, z fastest | the same name and shape, x fastest |
//! | of one voxel | `[1, inputs, outputs]` | or `[inputs, outputs]` |
//! | their biases | `[outputs]` | or `[1, outputs]` |
//! | batch norms | `bn0.weight` | `bn0.bn.weight`, and `bn0.bn.num_batches_tracked` |
//! | linear layers | `head.0.weight`, `[inputs, outputs]` | `head.0.linear.weight` or `head.0.weight`, `[outputs, inputs]` |
//!
//! Offsets themselves are the same: around the voxel where a kernel is odd, from the voxel on where
//! it is even, and back where it is transposed; tests hold whole networks and single operations of
//! MinkowskiEngine 0.5.4 against ours.
//!
//! A weight of two dimensions is always transposed, square or not, as PyTorch's own are; one
//! that is `[inputs, outputs]` already belongs into a file of our layout.
//!
//! Published weights are pickles of PyTorch, with or without `state_dict` around them and `module.`
//! before every name. This script, `convert_weights.py` beside this crate's `Cargo.toml`, makes
//! safetensors of them:
//!
//! ```python
#![doc = include_str!("../convert_weights.py")]
//! ```
//!
//! These lines then load them:
//!
//! ```no_run
//! use eyebolt_net::{models::MinkUNet, weights};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // Three features a voxel and twenty classes, as the weights have them.
//! let graph = MinkUNet::named("minkunet34c", 3, 20)?.graph()?;
//! let parameters = weights::from_minkowski(&graph, &std::fs::read("weights.safetensors")?)?;
//! # Ok(())
//! # }
//! ```
//!
//! With other classes, or the encoder alone, [`load_matching`] takes what fits.

mod complete;
mod entry;
mod layout;
mod matching;
mod names;
mod numbers;
mod tensors;
mod written;

pub use complete::{from_bytes, from_minkowski, to_bytes, to_half_bytes};
pub(crate) use entry::Entry;
pub use layout::Layout;
pub use matching::{Matching, OtherShape, load_matching};
pub(crate) use tensors::Tensors;
pub(crate) use written::{entries, serialise};

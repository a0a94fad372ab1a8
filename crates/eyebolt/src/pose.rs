//! Where the base may be: hypotheses for `camera_from_base`.

mod global_search;
mod patches;
mod proposer;

pub use global_search::GlobalSearch;
pub use proposer::{Hypothesis, PoseProposer};

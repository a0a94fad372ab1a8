//! A network as data: operations on rows of channels, in order.
//!
//! A graph knows neither sizes of inputs nor devices. What depends on the points at hand, who is
//! whose neighbour, comes with each [`Batch`](crate::Batch); numbers that are learned are
//! [`Parameters`](crate::Parameters).

mod builder;
mod check;
mod domain;
mod ids;
mod network;
mod op;
mod parameter;
mod rows;

pub use builder::GraphBuilder;
pub use check::MAX_PARAMETERS;
pub use domain::{Domain, MapSpec, SampleLevel, SampleScale, Source};
pub use ids::{MapId, NodeId, ParameterId};
pub use network::{Graph, Node};
pub use op::{BatchNorm, Op};
pub use parameter::{ParameterSpec, Role};

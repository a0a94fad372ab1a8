//! Depth cameras against the figures that were published of them.

mod edges;
mod faults;
mod spread;
mod wall;

//! Networks while they are taught.

mod learning;
mod runs;
mod small;

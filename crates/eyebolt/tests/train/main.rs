//! Networks while they are taught.

mod hand;
mod learning;
mod runs;
mod small;

//! Recordings that are written message by message, read back and copied.

mod description;
mod round_trip;
mod sample;
mod session;
mod streaming;
mod truth;
mod truth_errors;

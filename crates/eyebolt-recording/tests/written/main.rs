//! Recordings that are written message by message, read back and copied.

mod description;
mod round_trip;
mod sample;
mod streaming;
mod truth;
mod truth_errors;

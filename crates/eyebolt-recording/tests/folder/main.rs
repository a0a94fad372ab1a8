//! Recordings in folders, written by the tests and read back.

mod camera_info;
mod cloud_errors;
mod clouds;
mod damaged;
mod errors;
mod laws;
mod real;
mod sample;

//! Recordings in bags, written by the tests message by message and read back.

mod backgrounds;
mod cameras;
mod clocks;
mod clouds;
mod damaged;
mod empty;
mod joints;
mod motion;
mod pictures;
mod reader;
mod real;
mod sample;
mod topics;
mod writer;

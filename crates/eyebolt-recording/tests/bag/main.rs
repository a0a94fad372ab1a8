//! Recordings in bags, written by the tests message by message and read back.

mod backgrounds;
mod cameras;
mod choices;
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
mod second_publisher;
mod topics;
mod untold;
mod writer;

//! The program from outside: exit status, files and what it says.

mod answer;
mod batch;
mod convert;
mod demo;
mod desk;
mod evaluate;
mod export;
mod files;
mod good;
mod info;
mod label;
mod learned;
mod marker;
mod messages;
mod outcome;
mod pose;
mod program;
mod readme;
#[path = "../../../eyebolt/tests/newcomer/recording.rs"]
mod recording;
mod reproduce;
mod robots;
#[path = "../../../eyebolt/tests/newcomer/scene.rs"]
mod scene;
mod segment;
mod shell;
mod simulate;
mod simulate_flags;
mod study;
mod train;
mod viewer;
mod words;

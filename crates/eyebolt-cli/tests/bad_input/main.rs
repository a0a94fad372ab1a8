//! The table of bad inputs, seen from outside: a row is a test.
//!
//! Whatever is handed in, the program ends within a minute and 2 GB of memory, with one line that names
//! the file, the field and a remedy, and leaves every file that was there as it was.
#![cfg(unix)]

mod bag;
mod bag_files;
mod bag_topics;
mod compressed;
mod depth;
#[path = "../program/desk.rs"]
mod desk;
mod disk;
mod folder;
mod images;
mod interrupted;
mod joints;
mod label;
mod meshes;
mod mistakes;
mod npy;
mod outcome;
mod outputs;
#[path = "../../../eyebolt/tests/newcomer/recording.rs"]
mod recording;
mod run;
#[path = "../../../eyebolt/tests/newcomer/scene.rs"]
mod scene;
mod urdf;

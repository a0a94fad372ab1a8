//! Recordings in folders, written by the tests and read back.

mod backgrounds;
mod camera_info;
mod cloud_errors;
mod clouds;
mod damaged;
mod describe;
mod errors;
mod joint_errors;
mod joint_files;
mod laws;
mod pcl;
mod real;
mod sample;

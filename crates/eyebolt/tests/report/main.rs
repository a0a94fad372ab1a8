//! The page on a calibration: what it says, and that a browser shows it.

mod browser;
mod chromium;
mod page;
mod sample;
mod scene_data;
mod viewer;
mod wire;

#[path = "../newcomer/recording.rs"]
mod recording;
#[path = "../newcomer/run.rs"]
#[expect(dead_code, reason = "shared with tests of answers")]
mod run;
#[path = "../newcomer/scene.rs"]
mod scene;

//! Data sets: labels against the truth, and everything that a reader may meet.

mod filling;
mod frames;
mod made;
mod reading;
#[path = "../simulate/stage.rs"]
#[allow(dead_code, reason = "others need more of it")]
mod stage;
mod truth;

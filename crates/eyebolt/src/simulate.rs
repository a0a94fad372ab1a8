//! Recordings of an arm and a camera that are not there: to try eyebolt without a robot, and to
//! judge it where the truth is known.
//!
//! [`plan`] decides where everything is, and [`Plan::record`] writes what the camera sees of it as
//! an ordinary recording. The truth goes into a record of its own, for [`crate::evaluate`].

mod aftermath;
mod body;
mod configurations;
mod dress;
mod encoders;
mod error;
mod faults;
mod in_memory;
mod lab;
mod occlusion;
mod picture;
mod plan;
mod plate;
mod random_stream;
mod record;
mod rejected;
mod scenario;
mod scene;
mod second_arm;
mod solids;
mod stage;
mod static_frames;
mod surroundings;
mod table;
mod timeline;
mod true_arm;
mod true_view;
mod viewpoint;
mod with_marker;

pub(crate) use body::{ArmBody, placed_links, rests};
pub(crate) use configurations::{Onlooker, has_hand_in_view, shows_hand};
pub use error::SimulateError;
pub use faults::Faults;
pub use lab::{Lab, SecondArm};
pub use plan::{Plan, plan};
pub use rejected::Rejected;
pub use scenario::Scenario;
pub(crate) use scene::{clutter, room_of_any_size};
pub use solids::Solid;
pub use true_view::TrueView;
pub use viewpoint::{PRESETS, Preset, Ranges, Viewpoint};

//! Networks for an arm, from its description or from recordings.

mod actor;
mod checkpoint;
mod corrupt;
mod drawing;
mod end_effector;
mod error;
mod feed;
mod hand;
mod images;
mod invented;
mod keypoints;
mod lesson;
mod look;
mod preset;
mod rotation;
mod run;
mod scenery;
mod segmentation;
mod shot;
mod tensorboard;

pub use actor::{Actor, Pose};
pub use checkpoint::{Checkpoint, Progressed};
pub use end_effector::EndEffectorLesson;
pub use error::TrainError;
pub use feed::Feed;
pub use hand::{Hand, HandView};
pub use images::Images;
pub use invented::{invented_arm, urdf as invented_urdf};
pub use keypoints::{KeypointLesson, KeypointTarget};
pub use lesson::{Lesson, Plan};
pub use preset::Preset;
pub use rotation::RotationLesson;
pub use run::{Beginning, Keep, Report, pace, teach};
pub use segmentation::SegmentationLesson;
pub use shot::{At, Cast, Framing, Shot};
pub use tensorboard::events;

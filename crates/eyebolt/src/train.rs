//! Networks for an arm, from its description or from recordings.

mod actor;
mod checkpoint;
mod corrupt;
mod error;
mod feed;
mod invented;
mod lesson;
mod run;
mod scenery;
mod scores;
mod segmentation;
mod shot;

pub use actor::{Actor, Pose};
pub use checkpoint::{Checkpoint, Progressed};
pub use error::TrainError;
pub use feed::Feed;
pub use invented::{invented_arm, urdf as invented_urdf};
pub use lesson::{Lesson, Plan};
pub use run::{Keep, Report, teach};
pub use scores::{ClassScore, Confusion};
pub use segmentation::{SegmentationLesson, batch_of};
pub use shot::{Cast, Framing, IGNORE, Shot};

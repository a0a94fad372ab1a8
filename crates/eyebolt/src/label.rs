//! Which pixels are the arm.
//!
//! Before any pose is known: masks where the recording has them, else what stands before a
//! background that the frames themselves tell. Once a pose is known: what lies near the posed arm,
//! with a third answer, *ignore*, where nobody can say. [`FrameLabeller`] labels single frames for
//! others to learn from, with keypoints.

mod before_pose;
mod class;
mod frame;
mod labeller;
mod learned;
mod masks;
mod moving;
mod posed;

pub use before_pose::before_pose;
pub(crate) use class::class_of;
pub use frame::{Contradiction, FrameLabeller, LabelledFrame};
pub use labeller::{Labeller, Labelling};
pub use learned::Learned;
pub use masks::GivenMasks;
pub use moving::Motion;
pub use posed::{PosedModel, arm_points, labels_at};

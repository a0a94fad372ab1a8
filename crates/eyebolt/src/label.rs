//! Which pixels are the arm.
//!
//! Before any pose is known: masks where the recording has them, else what stands before a
//! background that the frames themselves tell. Once a pose is known: what lies near the posed arm,
//! with a third answer, *ignore*, where nobody can say.

mod moving;
mod posed;

pub use moving::moving_masks;
pub use posed::{arm_points, labels_at};

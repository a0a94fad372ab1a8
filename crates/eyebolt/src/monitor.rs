//! Whether a stored calibration is still true, frame by frame while the arm rests.
//!
//! [`Monitor`] takes frames one by one, from whatever source, and knows no time: how often views come is for the
//! caller to say ([`Rate`]). A view of each posture counts once, since its errors come again with it.

mod belief;
mod counted;
mod detector;
mod known;
mod moved;
mod recording;
mod report;
mod scene;
mod watch;

pub use belief::{Belief, Quadratic};
pub use detector::{Beliefs, Detector, Rate};
pub use known::Known;
pub use moved::{Moved, Suspect};
pub use recording::{Watched, look, watch};
pub use report::{Drift, ViewReport, WhyNot};
pub use watch::Monitor;

//! What is looked for: a tag, a grid of them, or a ChArUco board.

mod charuco;
mod described;
mod error;
mod find;
mod layout;
mod parse;
mod printed;

pub use described::Target;
pub use error::TargetError;
pub use find::{NotSeen, Sighting};
pub use layout::Layout;

//! From hypotheses to one exact pose, and what every configuration says of it.

mod agreement;
mod best;
mod camera_moved;
mod configuration;
mod known_background;
mod links;
mod pixels;
mod rounds;
mod shortlist;
mod workspace;

pub use agreement::{Agreement, agreement, total};
pub use best::{Found, Refined, refine_best};
pub use camera_moved::CameraMoved;
pub use configuration::{ConfigurationOutcome, Dropped};
pub(crate) use configuration::{misplaced, too_many_misplaced};
pub use links::{Misplaced, misplaced_link};
pub use pixels::PixelCounts;
pub use rounds::{CLOSING, OPENING, again, observe, observe_one, refine};
pub(crate) use shortlist::stands;
pub(crate) use workspace::Workspace;

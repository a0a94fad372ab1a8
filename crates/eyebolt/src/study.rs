//! Many simulated sessions, good and spoiled, calibrated from nothing: how often answers are right, how
//! often wrong ones are trusted and right ones refused, and whether errors are as large as expected.
//!
//! A [`Session`] is drawn from a seed and its number, run apart from all others, and told as an
//! [`Ending`]; a [`Summary`] counts them by [`Kind`].

mod chi_square;
mod ending;
mod kind;
mod quantile;
mod run;
mod session;
mod summary;
mod tampering;
mod trial;

pub use ending::{Answered, Ending, Refusal};
pub use kind::Kind;
pub use quantile::{LEVELS, quantile};
pub use run::{Study, StudyError, run};
pub use session::Session;
pub use summary::{Coverage, Summary, Tally};
pub use tampering::Tampering;
pub use trial::{SessionResult, try_session};

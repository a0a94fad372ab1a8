//! The page of a session, for a browser on this machine or on a telephone.
//!
//! One thread serves everybody, and the session never waits for it: what is new is left on a [`Board`], which keeps the latest
//! only, and a page asks for whatever is newer than what it has. A slow browser so sees less often what others see, and never
//! an old thing; nobody's number of browsers, and no browser's slowness, makes anything grow.

mod account;
mod address;
mod answers;
mod board;
mod coverage;
mod drawing;
mod next;
mod origin;
mod page;
mod picture;
mod server;
mod study;
mod unit;

pub use account::{Account, Phase, Quality};
pub use address::WebAddress;
pub use answers::Asked;
pub use board::Board;
pub use coverage::{Coverage, JointCoverage, LinkCoverage};
pub use next::{Next, NextJoint};
pub use server::{Web, WebError};
pub use study::{Finding, study};

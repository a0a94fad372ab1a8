//! What a pose is fitted to. Each kind of evidence is one file: its residual and Jacobian, its
//! robust scale, what it weighs, its nuisance parameter and how a report shows it.

mod kind;
mod kinds;
mod outlines;
mod posed;
mod surfaces;

pub(crate) use kind::{EvidenceKind, Factor};
pub use kind::{Presentation, Reach};
pub(crate) use kinds::KINDS;
pub use kinds::presentation;
pub(crate) use outlines::outline_jacobian;
pub(crate) use posed::{PosedArm, PosedView, moved_by_base};
pub(crate) use surfaces::{Spot, surface_jacobian};

#[cfg(test)]
mod tests;

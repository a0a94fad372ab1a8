//! Robust refinement of one pose over all configurations at once.

mod birge;
mod change_point;
mod clusters;
mod covariance;
mod doubts;
mod gather;
mod gauss_newton;
mod left_out;
mod offset_prior;
mod outcome;
mod predicted;
mod priors;
mod residuals;
mod settle;
mod start;
mod summary;
mod system;
mod view_evidence;

pub use birge::birge_ratio;
pub use change_point::{ChangePoint, change_point};
pub use doubts::Doubt;
pub use gauss_newton::refine;
pub use left_out::LeftOut;
pub use outcome::{Fit, Refinement, StopReason, ViewFit};
pub use predicted::{ExpectedNoise, PREDICTED, PredictedInformation, predicted_information};
pub use residuals::{Residual, residuals};
pub use settle::settle;
pub use start::{OffsetDeviations, OffsetPrior, RefineOptions, RefineView, Start, Trust};
pub use view_evidence::{SHIFTS, ShiftDeviations, ViewEvidence, view_evidence};

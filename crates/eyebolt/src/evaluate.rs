//! What was found against what is known: calibrations, labels and poses, as the tables of the paper have them.

mod calibration;
mod paper_figures;
mod pose_errors;
mod scores;
mod session;
mod table;
mod tables;
mod tag;

pub use calibration::{Evaluation, evaluate};
pub use pose_errors::{PoseErrors, Statistics};
pub use scores::{Calibrated, METHODS, Scores};
pub use session::{EvaluateError, Model, Reference, session};
pub use table::{Cell, Row, Table};
pub use tables::tables;
pub use tag::by_marker;

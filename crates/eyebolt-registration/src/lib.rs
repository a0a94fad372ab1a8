//! Registration of a posed arm to what a depth camera saw: distance fields, a global search that
//! needs no initial guess, and a robust refinement with an outcome.

mod arm;
mod bit_image;
mod cache;
mod decimate;
mod depth_margin;
mod distance_build;
mod distance_field;
mod evidence;
mod icp;
mod image_distance;
mod intrinsics_offset;
mod link_model;
mod normal_equations;
mod outward;
mod refine;
mod robust;
mod rotations;
mod search;
mod silhouette;
mod surface_sample;
mod triangle;
mod unknowns;
mod view;

pub use arm::{
    ArmJoint, ArmLink, ArmModel, JointAxis, JointOffsets, MOST_JOINTS, NearestSurface, Posture,
};
pub use cache::LinkCache;
pub use depth_margin::Margin;
pub use distance_field::{DistanceField, DistanceSample};
pub use evidence::{Presentation, Reach, presentation};
pub use icp::{
    Errors, Icp, IcpOptions, KdTree, PointToPoint, PointToPointOptions, clustered_covariance, icp,
    point_to_point,
};
pub use intrinsics_offset::{INTRINSICS, IntrinsicsOffset};
pub use link_model::LinkModel;
pub use normal_equations::NormalEquations;
pub use refine::{
    ChangePoint, Doubt, ExpectedNoise, Fit, LeftOut, OffsetDeviations, OffsetPrior, PREDICTED,
    PredictedInformation, RefineOptions, RefineView, Refinement, Residual, SHIFTS, ShiftDeviations,
    Start, StopReason, Trust, ViewEvidence, ViewFit, birge_ratio, change_point,
    predicted_information, refine, residuals, settle, view_evidence,
};
pub use robust::{geman_mcclure, median};
pub use rotations::spread_rotations;
pub use search::{Candidate, SearchView, search};
pub use silhouette::{Label, Labels, Silhouette};
pub use surface_sample::SurfacePoint;
pub use unknowns::{EVIDENCE_KINDS, OUTLINES, SURFACES};
pub use view::{Consistency, View};

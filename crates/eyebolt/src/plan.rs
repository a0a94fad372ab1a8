//! Which configurations to record next: those that tell most of where the camera is.

mod camera;
mod camera_file;
mod candidates;
mod choose;
mod document;
mod free;
mod gain;
mod movable;
mod next;
mod order;
mod path;
mod request;
mod ros;
mod route;
mod scene;
mod speed;
mod trajectory;
mod watcher;

pub use camera::{RoughCamera, USUAL_RANGE_M, assumed_cameras, told_range_m};
pub use camera_file::{CameraFile, CameraFileError};
pub use candidates::Drawn;
pub use document::{JointValue, PlanDocument, PlannedConfiguration, PlannedFor, SCHEMA};
pub use free::Blocked;
pub use gain::Known;
pub use movable::{MovableArm, PlannedJoint, Positions};
pub use next::{Plan, Planned, expected_with, free_and_in_view, middle_of, plan_next};
pub use request::{Calibrated, MOST_PLANNED, PlanRequest, Recorded};
pub use ros::{moveit, trajectory};
pub use speed::Speed;
pub use trajectory::TimedPoint;

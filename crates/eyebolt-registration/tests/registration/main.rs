//! Laws of the crate, against formulas and searches of their own.

mod cache;
mod distance_field;
mod facets;
mod icp;
mod interpolation;
mod joint_offsets;
mod left_out;
mod link_model;
mod posture;
mod refine;
mod rotations;
mod search;
mod shapes;
mod silhouette;
mod strategies;
mod synthetic_arm;

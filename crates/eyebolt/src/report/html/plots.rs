//! The plots of a page.

mod layout;
mod matrix;
mod panels;
mod rows;

pub(super) use matrix::matrix;
pub(super) use panels::{Panel, panels};
pub(super) use rows::{Row, rows};

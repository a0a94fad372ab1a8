//! A saved calibration in the forms that other programs read: each is read back by the rules of its
//! consumer, written here anew.

mod consumers;
mod formats;
mod hostile;
mod json;
mod names;
mod own_tree;
mod placements;
mod poses;
mod saved;
mod trees;

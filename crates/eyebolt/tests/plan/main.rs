//! Plans held against what must be true of them: by an independent library of collisions, by the forward kinematics, by
//! readers of what is written.

mod collisions;
mod known;
mod laws;
mod stage;
mod written;

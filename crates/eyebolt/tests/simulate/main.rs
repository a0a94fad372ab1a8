//! Recordings of an arm that is not there, held against what must be true of them: by the published
//! kinematics, by distances to plain shapes, and by what the readers of recordings make of them.

mod answers;
mod configurations;
mod description;
mod evaluation;
mod exchanged;
mod faults;
mod in_memory;
mod joint_offsets;
mod lab;
mod labels;
mod markers;
mod monitor;
mod motion;
mod other_unit;
mod presets;
mod recording;
mod robot;
mod secrets;
mod shapes;
mod stage;
mod stands;
mod surroundings;

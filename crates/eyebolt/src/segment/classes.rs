//! What a pixel is of.

/// Nothing, or something that is not the arm.
pub const BACKGROUND: u8 = 0;
/// The arm; without its end-effector, if the network tells that apart.
pub const ARM: u8 = 1;
/// The end-effector and every link below it.
pub const END_EFFECTOR: u8 = 2;
/// Nobody can say: there is no depth; or, in images to learn from, a tool that no description has.
pub const UNKNOWN: u8 = 255;

/// Names of the classes, in their order.
pub const CLASSES: [&str; 3] = ["background", "arm", "end_effector"];

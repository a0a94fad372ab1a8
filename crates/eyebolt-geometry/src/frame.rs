//! The frames that transforms run between.
//!
//! A frame is a type without values: it exists so that composing two transforms that do not meet
//! in the same frame does not compile.

/// A coordinate frame, named by a type.
pub trait CoordinateFrame: Copy + Send + Sync + 'static {
    /// What messages call the frame.
    const NAME: &'static str;
}

macro_rules! frames {
    ($($(#[$doc:meta])* $name:ident = $text:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name;
        impl CoordinateFrame for $name {
            const NAME: &'static str = $text;
        }
    )*};
}

frames! {
    /// The depth optical frame: x right, y down, z forward (REP 103).
    Camera = "camera";
    /// The root link of the arm.
    Base = "base";
    /// The end-effector link.
    EndEffector = "end_effector";
    /// Any link of the robot, where which one is known from the value beside it.
    Link = "link";
}

//! What is the matter with a session.

use std::fmt;

macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $name:literal, $spoiled:literal;)*) => {
        /// What is the matter with a session: nothing, something that honest labs have, or one thing that
        /// spoils it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Kind {
            $($(#[$doc])* $kind,)*
        }

        impl Kind {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// Its name.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$kind => $name,)* }
            }

            /// Whether a session of this kind is spoiled: then its answer may well be refused.
            pub const fn is_spoiled(self) -> bool {
                match self { $(Self::$kind => $spoiled,)* }
            }
        }
    };
}

kinds! {
    /// Nothing beyond what every lab has: depth scaled by a percent, joint zeros off by tenths of a
    /// degree.
    Plain = "plain", false;
    /// Part of the arm glosses.
    Gloss = "gloss", false;
    /// The walls are far away, and depth there is another in each configuration.
    FarRoom = "far-room", false;
    /// A tool, a cable or a cover on the arm that the description lacks.
    ExtraParts = "extra-parts", false;
    /// People and boxes are elsewhere in each configuration, and now and then so is the room.
    PassersBy = "passers-by", false;
    /// Another arm of the same kind stands beside.
    SecondArm = "second-arm", false;
    /// The camera is one or two percent long or short, and off in rings and bands.
    CameraPattern = "camera-pattern", false;
    /// The camera was bumped after half of the configurations.
    Bump = "bump", true;
    /// A link is longer than described.
    LinkLength = "link-length", true;
    /// The base is lower than described: another variant's.
    LowerBase = "lower-base", true;
    /// The focal length is not what is stated.
    FocalScale = "focal-scale", true;
    /// The principal point is not what is stated.
    PrincipalPoint = "principal-point", true;
    /// The gears have play.
    Backlash = "backlash", true;
    /// Only the last joints moved.
    WristOnly = "wrist-only", true;
    /// Depth is scaled by more than cameras that work are off by.
    DepthScale = "depth-scale", true;
    /// The description is of another robot, its joints named as in the recording.
    OtherRobot = "other-robot", true;
    /// Two joints go by each other's name.
    JointOrder = "joint-order", true;
    /// Depth is not in metres, or joints are not in radians.
    WrongUnit = "wrong-unit", true;
    /// A large box stands before the arm.
    Occlusion = "occlusion", true;
    /// The zero of one joint is off.
    JointZero = "joint-zero", true;
}

impl Kind {
    /// The kind called `name`.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// Those that are spoiled, or that are not.
    pub fn all(spoiled: bool) -> Vec<Self> {
        Self::ALL.iter().copied().filter(|kind| kind.is_spoiled() == spoiled).collect()
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

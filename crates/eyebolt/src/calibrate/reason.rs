//! Trusted, or why not.

use crate::joint_limits::OutsideLimits;
use eyebolt_robot::Input;

/// Trusted, or refused with reasons.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Use it; it is off by about as much as expected.
    Trusted,
    /// Do not use it.
    Refused(Vec<Reason>),
}

/// Why an answer is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Reason {
    /// Too few distinct configurations.
    #[error(
        "{used} distinct arm configurations could be used, {needed} are needed: record the arm in \
         more positions, far apart and turned differently"
    )]
    FewConfigurations {
        /// Configurations used.
        used: usize,
        /// Configurations needed.
        needed: usize,
    },
    /// The arm fits where depth is in another unit.
    #[error(
        "the arm fits if one of the integers of depth is {fitting_m} m, and the recording says {unit_m} m: \
         give {} {fitting_m}, or set depth_unit in recording.toml",
        Input::DEPTH_UNIT
    )]
    DepthUnit {
        /// What the recording says one of the integers is, metres.
        unit_m: f64,
        /// With what the arm fits, metres.
        fitting_m: f64,
    },
    /// No pose was found.
    #[error(
        "no camera pose explains what was seen: check that the robot description is this robot's \
         and that the arm is in view and moves between the configurations"
    )]
    NothingFound,
    /// The robot in the recording is not the robot described.
    #[error("the recording does not fit the robot: {problem}")]
    OtherRobot {
        /// What does not fit.
        problem: String,
    },
    /// Nothing that was seen can be held against the posed arm.
    #[error(
        "nothing was seen where the posed arm would be: check that the arm is in view and that the \
         depth images are not empty there"
    )]
    OutOfView,
    /// The evidence leaves the pose open.
    #[error("the data do not determine the pose: record the arm in positions farther apart")]
    Underdetermined,
    /// The refinement did not settle.
    #[error(
        "the refinement was still moving by {translation_mm:.1} mm and {rotation_deg:.2} degrees \
         when it was stopped"
    )]
    NotSettled {
        /// Last step, millimetres.
        translation_mm: f64,
        /// Last step, degrees.
        rotation_deg: f64,
    },
    /// A joint was recorded where the robot description does not let it be.
    #[error("{0}")]
    OutsideLimits(OutsideLimits),
    /// Links are not where the joints put them in too many configurations.
    #[error(
        "in {misplaced} of {judged} configurations a link is not where the joints put it: check \
         that joint names and order, joint zeros and the robot description are this arm's"
    )]
    Misplaced {
        /// Configurations with a misplaced link.
        misplaced: usize,
        /// Configurations looked at.
        judged: usize,
    },
    /// The answer takes a joint to be farther off than zeros are.
    #[error(
        "joint {joint:?} would have to stand {offset_deg:+.1} degrees from where it says (at most \
         {limit_deg:.1} are trusted): check that joint names and order, joint zeros and the robot \
         description are this arm's"
    )]
    JointOff {
        /// Name of the joint.
        joint: String,
        /// How much farther it stands than it says, degrees.
        offset_deg: f64,
        /// Allowed, either way, degrees.
        limit_deg: f64,
    },
    /// What never moves is not where the description has it.
    #[error(
        "what never moves of the arm fits best {shift_mm:.0} mm from where the description has it (at most \
         {limit_mm:.0} are trusted): check that the robot description is of this variant of the arm"
    )]
    BaseElsewhere {
        /// How far, millimetres.
        shift_mm: f64,
        /// Allowed, millimetres.
        limit_mm: f64,
    },
    /// The arm fits better with two joints exchanged.
    #[error(
        "the arm fits better with the positions of joints {:?} and {:?} exchanged: check that joint names \
         and order are this arm's", joints[0], joints[1]
    )]
    JointsExchanged {
        /// Their names.
        joints: [String; 2],
    },
    /// The camera sees through the posed arm.
    #[error(
        "{percent:.0} % of the posed arm's pixels show the scene behind it, or lie outside its mask (at \
         most {limit:.0} % are trusted): the robot description or the joints are not this arm's"
    )]
    Contradicted {
        /// Percent of the pixels.
        percent: f64,
        /// Percent allowed.
        limit: f64,
    },
    /// Another pose explains the data nearly as well.
    #[error(
        "another camera pose explains the data nearly as well: record the arm in positions that \
         tell its sides apart"
    )]
    Ambiguous,
    /// The expected error is too large.
    #[error(
        "the expected error is {translation_mm:.1} mm and {rotation_deg:.2} degrees, more than the \
         {limit_mm:.1} mm and {limit_deg:.2} degrees allowed: record more configurations, nearer \
         to the camera"
    )]
    Inaccurate {
        /// Expected error, millimetres.
        translation_mm: f64,
        /// Expected error, degrees.
        rotation_deg: f64,
        /// Allowed, millimetres.
        limit_mm: f64,
        /// Allowed, degrees.
        limit_deg: f64,
    },
}

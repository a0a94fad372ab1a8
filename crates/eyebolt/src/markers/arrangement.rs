//! Which of camera and marker the hand carries.

use eyebolt_geometry::{Base, CoordinateFrame, EndEffector, Transform};
use std::fmt::Debug;

/// Which of camera and marker the hand carries, as a type: the frames of the unknowns depend on it.
pub trait Arrangement {
    /// What the camera stands on.
    type Root: CoordinateFrame + Debug + PartialEq;
    /// What carries the marker.
    type Carrier: CoordinateFrame + Debug + PartialEq;
    /// Its name in files.
    const NAME: &'static str;

    /// Where the robot has the carrier.
    fn root_from_carrier(
        base_from_end_effector: &Transform<Base, EndEffector>,
    ) -> Transform<Self::Root, Self::Carrier>;
}

/// The camera stands still, and sees a marker on the hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EyeToHand;

/// The camera is on the hand, and sees a marker that stands still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EyeInHand;

impl Arrangement for EyeToHand {
    type Root = Base;
    type Carrier = EndEffector;
    const NAME: &'static str = "eye_to_hand";

    fn root_from_carrier(
        base_from_end_effector: &Transform<Base, EndEffector>,
    ) -> Transform<Base, EndEffector> {
        *base_from_end_effector
    }
}

impl Arrangement for EyeInHand {
    type Root = EndEffector;
    type Carrier = Base;
    const NAME: &'static str = "eye_in_hand";

    fn root_from_carrier(
        base_from_end_effector: &Transform<Base, EndEffector>,
    ) -> Transform<EndEffector, Base> {
        base_from_end_effector.inverse()
    }
}

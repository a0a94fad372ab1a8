//! Random choices that do not change each other.

use eyebolt_render::Random;

/// Which stream of random numbers decides what: what is added later changes nothing else.
#[derive(Clone, Copy)]
pub(super) enum RandomStream {
    Viewpoint = 1,
    Configurations,
    Room,
    Clutter,
    Specimen,
    Frames,
    Encoders,
    Bump,
    Link,
    Occlusion,
    PassersBy,
    OtherRooms,
    SecondArm,
    Dress,
    Gloss,
    Wander,
    FixedPattern,
    Pictures,
}

impl RandomStream {
    pub(super) fn of(self, seed: u64) -> Random {
        Random::new(seed).at(self as u64)
    }
}

//! Why a topic of depth was taken that nobody named.

/// Why one of several topics of depth was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthChoice {
    /// By its name, it is what the camera measured, and the others were made of it.
    Raw,
    /// Nothing tells them apart.
    First,
}

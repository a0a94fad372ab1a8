//! A place where a base may be.

use nalgebra::Vector3;

/// Another place of the links that never move, and what speaks for it: by how much the logarithm of the likelihood grows
/// there, beyond what it grows by within a centimetre of where the description has them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elsewhere {
    /// How far it is from where the description has them, base frame, metres.
    pub shift_m: Vector3<f64>,
    /// Since less of the links is seen through; nothing near the place described, where cameras are wrong at edges.
    pub seen_through: f64,
    /// Since depth is nearer to their surfaces; minus infinity where too little of them would be seen.
    pub nearer: f64,
    /// Since more of what is seen lies on their surfaces, and less stands before them; never more than what often looks
    /// like it without being it.
    pub more: f64,
}

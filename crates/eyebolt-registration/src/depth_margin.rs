//! By how much depth that was seen may differ from depth that was expected.

/// What a difference of depth has to exceed to count, in multiples of one noise model.
///
/// The noise of stereo and of structured light grows with the square of the distance (disparity is
/// quantised; Khoshelham and Elberink, Sensors 2012), on top of what shapes and joints are off by
/// before a pose is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Margin {
    /// On the surface of a refined pose, which has to fit better than one that is searched for.
    Refined,
    /// Near the surface of a pose that is still being refined: labels are made of it.
    Label,
    /// About where the surface of a pose is that is centimetres off.
    Search,
    /// Clearly before what was seen at another time.
    Moved,
    /// Close to the surface without being of it: the table at the foot of the arm, a tool.
    Beside,
}

/// The noise model: at the camera, and for each square metre of distance, metres.
const AT_CAMERA_M: f32 = 0.03;
const PER_SQUARE_METRE_M: f32 = 0.01;

impl Margin {
    /// The margin at `depth_m`, metres.
    pub fn at_m(self, depth_m: f32) -> f32 {
        self.multiple() * (AT_CAMERA_M + PER_SQUARE_METRE_M * depth_m * depth_m)
    }

    fn multiple(self) -> f32 {
        match self {
            Self::Refined => 0.6,
            Self::Label => 0.8,
            Self::Search => 1.0,
            Self::Moved => 1.5,
            Self::Beside => 2.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Margin;

    #[test]
    fn margins_are_in_order_and_grow_with_the_square_of_the_distance() {
        use Margin::{Beside, Label, Moved, Refined, Search};
        let rising = [Refined, Label, Search, Moved, Beside];
        for pair in rising.windows(2) {
            assert!(pair[0].at_m(1.3) < pair[1].at_m(1.3));
        }
        assert!((Search.at_m(1.0) - 0.04).abs() < 1e-6);
        let grown = |z: f32| Search.at_m(z) - Search.at_m(0.0);
        assert!((grown(4.0) - 4.0 * grown(2.0)).abs() < 1e-6);
    }
}

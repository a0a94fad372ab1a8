//! Joint positions by name.

use std::collections::BTreeMap;

/// Positions of joints (radians, metres for prismatic joints), found by name, never by place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointPositions(BTreeMap<String, f64>);

impl JointPositions {
    /// Position of joint `name`, if there is one.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.0.get(name).copied()
    }

    /// Names and positions, in the order of the names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(name, position)| (name.as_str(), *position))
    }

    /// How many joints there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are no joints at all.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl FromIterator<(String, f64)> for JointPositions {
    fn from_iter<I: IntoIterator<Item = (String, f64)>>(pairs: I) -> Self {
        Self(pairs.into_iter().collect())
    }
}

//! The models by their names.

use super::model::Sensor;
use std::fmt;
use std::str::FromStr;

impl Sensor {
    /// The names of all models.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::ALL.iter().map(|sensor| sensor.name)
    }
}

impl FromStr for Sensor {
    type Err = UnknownSensor;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let found = Self::ALL.iter().find(|sensor| sensor.name == name);
        found.copied().ok_or_else(|| UnknownSensor(name.to_owned()))
    }
}

/// There is no model of that name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownSensor(pub String);

impl fmt::Display for UnknownSensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = Sensor::names().collect();
        write!(f, "sensor {:?} is not known; use one of {}", self.0, names.join(", "))
    }
}

impl std::error::Error for UnknownSensor {}

//! When a session has enough.

use eyebolt::calibrate::Deviation;
use std::fmt;
use std::str::FromStr;

/// The expected error with which a session ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal(pub Deviation);

impl Default for Goal {
    fn default() -> Self {
        Self(Deviation { translation_m: 2e-3, rotation_rad: 0.1_f64.to_radians() })
    }
}

impl Goal {
    /// Whether an error of `expected` is enough.
    pub fn is_met(&self, expected: &Deviation) -> bool {
        expected.translation_m <= self.0.translation_m
            && expected.rotation_rad <= self.0.rotation_rad
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Deviation { translation_m, rotation_rad } = self.0;
        write!(f, "{}mm,{}deg", round(1e3 * translation_m), round(rotation_rad.to_degrees()))
    }
}

/// Without what the change of units left behind.
fn round(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

impl FromStr for Goal {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is no goal: write 2mm,0.1deg");
        let (translation, rotation) = text.split_once(',').ok_or_else(wrong)?;
        let number = |text: &str, unit: &str| {
            let number = text.trim().strip_suffix(unit)?.trim_end().parse::<f64>().ok()?;
            (number.is_finite() && number > 0.0).then_some(number)
        };
        let (mm, deg) = number(translation, "mm").zip(number(rotation, "deg")).ok_or_else(wrong)?;
        Ok(Self(Deviation { translation_m: 1e-3 * mm, rotation_rad: deg.to_radians() }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_goal_is_read_as_it_is_written(mm in 1..10_000_u32, deg in 1..10_000_u32) {
            let written = format!("{}mm,{}deg", f64::from(mm) / 100.0, f64::from(deg) / 1000.0);
            prop_assert_eq!(written.parse::<Goal>().unwrap().to_string(), written);
        }
    }

    #[test]
    fn what_is_no_goal_is_refused() {
        for text in
            ["", "2mm", "2mm,0.1", "2,0.1deg", "0mm,1deg", "-1mm,1deg", "nanmm,1deg", "1deg,2mm"]
        {
            assert!(text.parse::<Goal>().unwrap_err().contains("2mm,0.1deg"), "{text}");
        }
    }

    #[test]
    fn both_numbers_count() {
        let goal = Goal::default();
        let at = |mm: f64, deg: f64| Deviation {
            translation_m: 1e-3 * mm,
            rotation_rad: deg.to_radians(),
        };
        assert!(goal.is_met(&at(1.9, 0.09)));
        assert!(!goal.is_met(&at(2.1, 0.09)) && !goal.is_met(&at(1.9, 0.11)));
    }
}

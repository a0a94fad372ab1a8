//! Units that depth is stored in.

use std::fmt;

/// What one of the numbers that depth is stored in is, metres.
///
/// Drivers store whole millimetres (most), tenths of them (RealSense D405), quarters (L515), or
/// 1/5000 m (TUM's data sets).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthUnit(f64);

/// Units that depth cameras have lie between these, metres.
const SMALLEST_M: f64 = 1e-6;
const LARGEST_M: f64 = 1.0;

impl DepthUnit {
    /// Metres.
    pub const METRES: Self = Self(1.0);
    /// Millimetres.
    pub const MILLIMETRES: Self = Self(1e-3);
    /// What can be written for one, for messages.
    pub(crate) const WAYS: &str = "\"m\" (metres), \"mm\" (millimetres) or the metres of one, as in \
                                   0.0001 or \"1/5000\"";

    /// The unit of so many metres; `None` if it is none: not between a micrometre and a metre.
    pub fn of_metres(metres: f64) -> Option<Self> {
        (SMALLEST_M..=LARGEST_M).contains(&metres).then_some(Self(metres))
    }

    /// The unit that `text` names: `m`, `mm`, or its metres as a number or a fraction.
    ///
    /// ```
    /// use eyebolt_recording::DepthUnit;
    ///
    /// assert_eq!(DepthUnit::parse("1/5000"), DepthUnit::of_metres(0.0002));
    /// assert_eq!(DepthUnit::parse("mm"), Some(DepthUnit::MILLIMETRES));
    /// assert_eq!(DepthUnit::parse("cm"), None);
    /// ```
    pub fn parse(text: &str) -> Option<Self> {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        match text.trim() {
            "m" => Some(Self::METRES),
            "mm" => Some(Self::MILLIMETRES),
            text => match text.split_once('/') {
                Some((above, below)) => Self::of_metres(number(above)? / number(below)?),
                None => Self::of_metres(number(text)?),
            },
        }
    }

    /// Metres of one.
    pub fn metres(self) -> f64 {
        self.0
    }

    /// Whether `other` is the same, but for rounding.
    pub(crate) fn is_about(self, other: Self) -> bool {
        (self.0 - other.0).abs() <= 1e-6 * self.0
    }
}

/// As [`DepthUnit::parse`] reads it.
impl fmt::Display for DepthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::METRES => write!(f, "m"),
            Self::MILLIMETRES => write!(f, "mm"),
            Self(metres) => write!(f, "{metres}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_written_is_read(metres in 1e-6..1.0_f64) {
            let unit = DepthUnit::of_metres(metres).unwrap();
            prop_assert_eq!(DepthUnit::parse(&unit.to_string()), Some(unit));
        }

        #[test]
        fn a_fraction_is_a_number(below in 1_u32..1_000_000) {
            let unit = DepthUnit::parse(&format!("1/{below}"));
            prop_assert_eq!(unit, DepthUnit::of_metres(1.0 / f64::from(below)));
        }
    }

    #[test]
    fn what_is_no_unit() {
        for text in ["cm", "", "0", "-0.001", "nan", "inf", "1/0", "0/0", "2", "1e-9", "1/2/3"] {
            assert_eq!(DepthUnit::parse(text), None, "{text}");
        }
    }
}

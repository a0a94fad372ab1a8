//! How large steps are.

use crate::Error;
use serde::{Deserialize, Serialize};

/// More than any rate of use, and less than what would throw weights beyond 32 bits.
const LARGEST: f64 = 1e6;

/// The learning rate over the steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Schedule {
    /// Always the same.
    Constant {
        /// Learning rate.
        rate: f64,
    },
    /// Times `factor` after every `every` steps.
    Steps {
        /// At the start.
        rate: f64,
        /// Steps between two changes.
        every: u64,
        /// Below one.
        factor: f64,
    },
    /// Rising in a line over `warm_up` steps, then falling along half a cosine to zero at `total`
    /// (Loshchilov and Hutter, *SGDR*, ICLR 2017, without restarts).
    Cosine {
        /// The highest.
        rate: f64,
        /// Steps to get there.
        warm_up: u64,
        /// Steps in all.
        total: u64,
    },
}

impl Schedule {
    /// That every rate is a number.
    ///
    /// # Errors
    /// If the rate or its factor is negative, not finite, or so large that steps would leave 32 bits.
    pub fn check(self) -> Result<(), Error> {
        let (rate, factor) = match self {
            Self::Constant { rate } | Self::Cosine { rate, .. } => (rate, 1.0),
            Self::Steps { rate, factor, .. } => (rate, factor),
        };
        for (name, value) in [("rate", rate), ("factor", factor)] {
            if !(0.0..=LARGEST).contains(&value) {
                let problem = format!("{value} is not from 0 to {LARGEST}");
                return Err(Error::input(name, problem));
            }
        }
        Ok(())
    }

    /// The rate of a step, counted from 0.
    pub fn rate(self, step: u64) -> f64 {
        match self {
            Self::Constant { rate } => rate,
            Self::Steps { rate, every, factor } => {
                let changes = (step / every.max(1)).min(i32::MAX as u64);
                rate * factor.powi(changes as i32)
            }
            Self::Cosine { rate, warm_up, .. } if step < warm_up => {
                rate * (step + 1) as f64 / warm_up as f64
            }
            Self::Cosine { rate, warm_up, total } => {
                let done = (step - warm_up) as f64 / total.saturating_sub(warm_up).max(1) as f64;
                rate * 0.5 * (1.0 + (std::f64::consts::PI * done.min(1.0)).cos())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Schedule;

    #[test]
    fn rates_at_known_steps() {
        let steps = Schedule::Steps { rate: 1.0, every: 10, factor: 0.5 };
        assert_eq!([0, 9, 10, 25].map(|step| steps.rate(step)), [1.0, 1.0, 0.5, 0.25]);
        let cosine = Schedule::Cosine { rate: 2.0, warm_up: 4, total: 14 };
        assert_eq!([0, 3, 4].map(|step| cosine.rate(step)), [0.5, 2.0, 2.0]);
        assert!((cosine.rate(9) - 1.0).abs() < 1e-12);
        assert!(cosine.rate(14).abs() < 1e-12 && cosine.rate(99).abs() < 1e-12);
        assert_eq!(Schedule::Constant { rate: 0.1 }.rate(7), 0.1);
    }
}

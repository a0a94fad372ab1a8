//! Joints that messages name without a position that can be used.

use crate::words::counted;
use std::collections::BTreeMap;

/// How often each joint was named without a usable position, and why first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Untold(BTreeMap<String, (u64, Why)>);

/// Why a joint that is named has no usable position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Why {
    /// It is not a number, or beyond all measure.
    NoPosition(f64),
    /// It is named twice, with different positions.
    Twice,
    /// There are fewer positions than names.
    ListEnds,
}

/// Joints kept.
const MOST: usize = 1000;

impl Untold {
    pub(super) fn add(&mut self, name: &str, why: Why) {
        if let Some((count, _)) = self.0.get_mut(name) {
            *count += 1;
        } else if self.0.len() < MOST {
            self.0.insert(name.to_owned(), (1, why));
        }
    }

    /// Each joint, with what is wrong in how many of the `messages` of the topic.
    pub(crate) fn reasons(&self, messages: u64) -> impl Iterator<Item = (&str, String)> {
        self.0.iter().map(move |(name, (count, why))| {
            let often = match *count >= messages {
                true => format!("all {}", counted(messages, "message")),
                false => format!("{count} of {}", counted(messages, "message")),
            };
            let reason = match why {
                Why::NoPosition(position) => format!("the position of {name} is {position}"),
                Why::Twice => format!("{name} stands there twice, at different positions,"),
                Why::ListEnds => format!("the list of positions ends before {name}"),
            };
            (name.as_str(), format!("{reason} in {often}"))
        })
    }
}

//! What publishers offer, and what to ask of all of them.

/// Of the quality of service of a publisher, what decides whether a subscriber hears it: one hears who
/// offers at least what it asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Whether lost messages are sent again.
    pub reliable: bool,
    /// Whether those who come late get the last messages (`transient_local`).
    pub latched: bool,
}

impl Offer {
    /// The most that can be asked for so that all of these publishers are heard; `None` of none.
    pub fn of_all(offers: impl IntoIterator<Item = Self>) -> Option<Self> {
        offers.into_iter().reduce(|a, b| Self {
            reliable: a.reliable && b.reliable,
            latched: a.latched && b.latched,
        })
    }

    /// Whether a publisher with this offer is heard by who asks for `wanted`.
    pub fn suffices(self, wanted: Self) -> bool {
        (self.reliable || !wanted.reliable) && (self.latched || !wanted.latched)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Everybody is heard, and nothing more could be asked for.
        #[test]
        fn all_are_heard_and_no_more_can_be_asked_for(offers in proptest::collection::vec(any::<(bool, bool)>(), 1..9)) {
            let offers: Vec<Offer> = offers.into_iter().map(|(reliable, latched)| Offer { reliable, latched }).collect();
            let asked = Offer::of_all(offers.iter().copied()).unwrap();
            prop_assert!(offers.iter().all(|offer| offer.suffices(asked)));
            for more in [Offer { reliable: true, ..asked }, Offer { latched: true, ..asked }] {
                prop_assert!(more == asked || !offers.iter().all(|offer| offer.suffices(more)));
            }
        }
    }
}

//! Which views count: of each posture the first, and again when it shows something else.
//!
//! The errors of a view (of shapes, of depth at edges, of joints) are those of its posture, and come again with it: the
//! same view twice is no more evidence than once. But that it differs from before tells of a change, since what the two
//! have in common is in both.

use super::belief::Quadratic;
use eyebolt_geometry::{Base, Link, Transform};

/// Links nearer to each other than this are in the same place, metres and radians: as frames of one configuration are.
const SAME_M: f64 = 5e-3;
const SAME_RAD: f64 = 1e-2;
/// By how many squared standard deviations two views of a posture differ that show different things: chi-square of six
/// degrees of freedom, exceeded once in a thousand; and errors that both have make it smaller.
const DIFFERENT: f64 = 22.46;
/// Of the sum of the information, so that what neither view sees stays where it is, 1/m^2 and 1/rad^2.
const LITTLE: f64 = 100.0;
/// Postures that are remembered.
const MOST: usize = 256;

/// A view that counted, and where the links were.
#[derive(Clone, Debug)]
struct Counted {
    links: Vec<Transform<Base, Link>>,
    pose: Quadratic,
}

/// The views that counted, in order of time.
#[derive(Clone, Debug, Default)]
pub(super) struct CountedViews {
    views: Vec<Counted>,
}

impl CountedViews {
    /// Whether a view with the links there counts, that says `pose`.
    pub fn is_new(&self, links: &[Transform<Base, Link>], pose: &Quadratic) -> bool {
        let last = self.views.iter().rev().find(|view| same_place(&view.links, links));
        last.is_none_or(|last| different(&last.pose, pose))
    }

    pub fn push(&mut self, links: &[Transform<Base, Link>], pose: Quadratic) {
        if self.views.len() >= MOST {
            self.views.remove(0);
        }
        self.views.push(Counted { links: links.to_vec(), pose });
    }
}

fn same_place(a: &[Transform<Base, Link>], b: &[Transform<Base, Link>]) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| {
            let (metres, radians) = a.distance_to(b);
            metres <= SAME_M && radians <= SAME_RAD
        })
}

fn different(a: &Quadratic, b: &Quadratic) -> bool {
    let best = |q: &Quadratic| -> Option<f64> {
        let mut information = q.information.clone();
        (0..information.nrows()).for_each(|i| information[(i, i)] += LITTLE);
        Some(q.vector.dot(&information.cholesky()?.solve(&q.vector)))
    };
    let apart = || Some(best(a)? + best(b)? - best(&a.plus(b))?);
    apart().is_some_and(|apart| apart > DIFFERENT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    fn at(shift_m: f64) -> Quadratic {
        let information = DMatrix::identity(6, 6) * 2e-3f64.powi(-2);
        let vector = &information * DVector::from_element(6, shift_m);
        Quadratic { information, vector }
    }

    #[test]
    fn the_same_again_is_not_different_and_another_is() {
        assert!(!different(&at(0.004), &at(0.004)));
        assert!(!different(&at(0.0), &at(0.001)));
        assert!(different(&at(0.0), &at(0.01)));
        assert!(!different(&at(0.01), &Quadratic::nothing(6)));
    }
}

//! Ways in joint space that are free.

use super::candidates::anywhere;
use super::free::Surroundings;
use super::movable::{MovableArm, Positions};
use eyebolt_render::Random;
use nalgebra::Point3;

/// Checks and finds ways.
pub(super) struct Roads<'a> {
    arm: &'a MovableArm,
    surroundings: &'a Surroundings,
    /// How far any point of the arm moves at most for each radian or metre of each joint, metres.
    levers_m: Vec<f64>,
}

/// Between two places that are checked, no point of the arm moves farther, metres: less than the clearance.
const STEP_M: f64 = 0.012;
/// A way about an obstacle grows by this at a time, metres of motion.
const STRIDE_M: f64 = 0.15;
/// Places that are tried for a way about obstacles, and for a shorter one.
const TRIES: u64 = 150;
const SHORTCUTS: u64 = 30;

impl<'a> Roads<'a> {
    pub(super) fn new(arm: &'a MovableArm, surroundings: &'a Surroundings) -> Self {
        Self { arm, surroundings, levers_m: levers_m(arm) }
    }

    /// Bound on how far any point of the arm moves on the straight way, metres.
    fn length_m(&self, from: &[f64], to: &[f64]) -> f64 {
        let joints = from.iter().zip(to).zip(&self.levers_m);
        joints.map(|((from, to), lever)| (to - from).abs() * lever).sum()
    }

    /// Whether the arm has room at `positions`.
    pub(super) fn is_free(&self, positions: &[f64]) -> bool {
        let posture = self.arm.posture(positions);
        posture.is_some_and(|posture| self.surroundings.check(self.arm, &posture).is_ok())
    }

    /// Whether all of the straight way between two places is free that are free themselves.
    pub(super) fn is_straight_free(&self, from: &[f64], to: &[f64]) -> bool {
        let parts = (self.length_m(from, to) / STEP_M).ceil().max(1.0) as usize;
        // The middle first, then the middles of the halves: obstacles are wide.
        let levels = usize::BITS - parts.leading_zeros();
        let mut strides = (0..levels).rev().map(|level| 1usize << level);
        strides.all(|stride| {
            let odd = (stride..parts).step_by(2 * stride);
            odd.into_iter().all(|part| self.is_free(&between(from, to, part as f64 / parts as f64)))
        })
    }

    /// A free way, both ends included: the straight one, or else one that two trees find which grow towards each other
    /// (Kuffner and LaValle, "RRT-Connect", ICRA 2000), made shorter where that is free. `None` if none was found.
    pub(super) fn way(&self, from: &[f64], to: &[f64], random: Random) -> Option<Vec<Positions>> {
        if self.is_straight_free(from, to) {
            return Some(vec![from.to_vec(), to.to_vec()]);
        }
        let way = self.about(from, to, random)?;
        Some(self.shortened(way, random.at(u64::MAX)))
    }

    fn about(&self, from: &[f64], to: &[f64], random: Random) -> Option<Vec<Positions>> {
        let mut trees = [Tree::new(from), Tree::new(to)];
        for place in 0..TRIES {
            let [growing, other] = &mut trees;
            let sample = anywhere(self.arm, &mut random.at(place));
            if let Some(new) = self.grow(growing, &sample) {
                let target = growing.places[new].clone();
                if let Some(met) = self.connect(other, &target) {
                    let (mut there, mut back) = (growing.to_root(new), other.to_root(met));
                    there.reverse();
                    // Both trees have the place where they meet.
                    back.remove(0);
                    there.extend(back);
                    if place % 2 == 1 {
                        there.reverse();
                    }
                    return Some(there);
                }
            }
            trees.swap(0, 1);
        }
        None
    }

    /// One stride from the nearest place of `tree` toward `target`; the new place.
    fn grow(&self, tree: &mut Tree, target: &[f64]) -> Option<usize> {
        let near = (0..tree.places.len()).min_by(|a, b| {
            let far = |place: &usize| self.length_m(&tree.places[*place], target);
            far(a).total_cmp(&far(b))
        })?;
        let length = self.length_m(&tree.places[near], target);
        let part = (STRIDE_M / length.max(1e-9)).min(1.0);
        let new = match part < 1.0 {
            true => between(&tree.places[near], target, part),
            false => target.to_vec(),
        };
        let free = self.is_free(&new) && self.is_straight_free(&tree.places[near], &new);
        free.then(|| tree.push(new, near))
    }

    /// Grows `tree` as far as it goes toward `target`; the place that it reaches it with.
    fn connect(&self, tree: &mut Tree, target: &[f64]) -> Option<usize> {
        loop {
            let new = self.grow(tree, target)?;
            if tree.places[new] == target {
                return Some(new);
            }
        }
    }

    fn shortened(&self, mut way: Vec<Positions>, random: Random) -> Vec<Positions> {
        for place in 0..SHORTCUTS {
            if way.len() < 3 {
                break;
            }
            let mut random = random.at(place);
            let (a, b) = (random.index(way.len()), random.index(way.len()));
            let (first, last) = (a.min(b), a.max(b));
            if last > first + 1 && self.is_straight_free(&way[first], &way[last]) {
                way.drain(first + 1..last);
            }
        }
        way
    }
}

/// Places with the place that each was reached from.
struct Tree {
    places: Vec<Positions>,
    from: Vec<usize>,
}

impl Tree {
    fn new(root: &[f64]) -> Self {
        Self { places: vec![root.to_vec()], from: vec![0] }
    }

    fn push(&mut self, place: Positions, from: usize) -> usize {
        self.places.push(place);
        self.from.push(from);
        self.places.len() - 1
    }

    /// The places from `place` to the root.
    fn to_root(&self, mut place: usize) -> Vec<Positions> {
        let mut way = vec![self.places[place].clone()];
        while place != 0 {
            place = self.from[place];
            way.push(self.places[place].clone());
        }
        way
    }
}

/// The place `part` of the way.
pub(super) fn between(from: &[f64], to: &[f64], part: f64) -> Positions {
    from.iter().zip(to).map(|(from, to)| from + part * (to - from)).collect()
}

/// How far from the axis of each joint the arm reaches, over random postures and a little more, metres; 1 of those that
/// slide.
fn levers_m(arm: &MovableArm) -> Vec<f64> {
    const POSTURES: u64 = 64;
    const MORE: f64 = 1.1;
    const STEP: usize = 16;
    let mut levers: Vec<f64> = vec![0.0; arm.joints().len()];
    let random = Random::new(0);
    for place in 0..POSTURES {
        let Some(posture) = arm.posture_with_axes(&anywhere(arm, &mut random.at(place))) else {
            continue;
        };
        for (joint, axis) in arm.model.joints().iter().zip(posture.axes()) {
            let Some(at) = arm.joints().iter().position(|own| own.name == joint.name) else {
                continue;
            };
            let far = |point: Point3<f32>| {
                axis.along_in_base.cross(&(point.cast::<f64>() - axis.through_in_base)).norm()
            };
            let carried = (0..joint.carries.len()).filter(|link| joint.carries[*link]);
            let points =
                carried.flat_map(|link| arm.body.link_surface(&posture, link).step_by(STEP));
            levers[at] = points.map(far).fold(levers[at], f64::max);
        }
    }
    levers.into_iter().map(|lever| if lever > 0.0 { MORE * lever } else { 1.0 }).collect()
}

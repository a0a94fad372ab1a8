//! Laws of what the disagreement of kinds of evidence adds, after Birge, and of what remains in doubt.

use super::*;
use crate::made_up;
use nalgebra::UnitQuaternion;

/// What the disagreement of `alone` adds to the answer of `both`.
fn disagreement(both: &Refinement, alone: &[Refinement]) -> Matrix6<f64> {
    by_disagreement(both, birge(both, alone))
}

fn pose() -> Transform<Camera, Base> {
    let turn = UnitQuaternion::from_euler_angles(0.4, -0.7, 0.2);
    Transform::from_parts(Vector3::new(0.2, -0.1, 1.3), turn)
}

/// Information of one kind of evidence, whose directions are not the axes.
fn information(sigmas: [f64; 6], turn: f64) -> Matrix6<f64> {
    let along = Matrix6::from_fn(|r, c| f64::sin(turn * (1.0 + (7 * r + 3 * c) as f64))).qr().q();
    along
        * Matrix6::from_diagonal(&Vector6::from(sigmas).map(|sigma| sigma.powi(-2)))
        * along.transpose()
}

fn surfaces() -> Matrix6<f64> {
    information([0.001, 0.002, 0.004, 0.002, 0.003, 0.001], 0.7)
}

fn outlines() -> Matrix6<f64> {
    information([0.003, 0.001, 0.002, 0.001, 0.005, 0.002], 1.9)
}

/// The answer of one kind that knows `information` and is `off` from the answer of both: the
/// translation in metres alone, so that being twice as far off is twice that.
fn kind(information: Matrix6<f64>, off: Vector3<f64>) -> Refinement {
    let delta = Vector6::new(off.x, off.y, off.z, 0.0, 0.0, 0.0);
    Refinement { information, ..made_up::refinement(pose().retract(&delta)) }
}

/// What two kinds add that are `apart` and each know what they know.
fn added(apart: Vector3<f64>) -> Matrix6<f64> {
    let both = Refinement { information: surfaces() + outlines(), ..made_up::refinement(pose()) };
    disagreement(&both, &[kind(surfaces(), 0.3 * apart), kind(outlines(), -0.7 * apart)])
}

fn deviation(covariance: &Matrix6<f64>) -> Deviation {
    expected(covariance, &pose(), &Point3::new(0.3, 0.1, 0.4))
}

/// By how many standard deviations of their difference two kinds that are `apart` differ.
fn sigmas(apart: Vector3<f64>) -> f64 {
    let [a, b] = [surfaces(), outlines()].map(|i| i.try_inverse().unwrap());
    let apart = Vector6::new(apart.x, apart.y, apart.z, 0.0, 0.0, 0.0);
    apart.dot(&((a + b).try_inverse().unwrap() * apart)).sqrt()
}

const APART: Vector3<f64> = Vector3::new(0.004, -0.002, 0.003);

#[test]
fn kinds_that_agree_add_nothing() {
    assert!(added(Vector3::zeros()).amax() < 1e-15);
}

#[test]
fn kinds_that_agree_within_their_information_add_no_more_than_its_noise() {
    let noise = (surfaces() + outlines()).try_inverse().unwrap();
    // Of six numbers each off by its standard deviation the sum of squares is six.
    let within = APART * (6f64.sqrt() / sigmas(APART));
    for share in [0.1, 0.5, 1.0] {
        let added = added(share * within);
        assert!((added - noise * (share * share)).amax() < 1e-9 * noise.amax(), "{added}");
    }
    assert!(deviation(&added(1.1 * within)).translation_m > deviation(&noise).translation_m);
}

#[test]
fn kinds_that_are_farther_apart_add_in_proportion() {
    let once = deviation(&added(APART));
    assert!(once.translation_m > 1e-4 && once.rotation_rad > 1e-5);
    for factor in [0.25, 2.0, 7.0] {
        let scaled = deviation(&added(factor * APART));
        assert!((scaled.translation_m - factor * once.translation_m).abs() < 1e-9);
        assert!((scaled.rotation_rad - factor * once.rotation_rad).abs() < 1e-9);
    }
}

/// How far from the answer of both each kind is says nothing: only how far they are from each other.
#[test]
fn kinds_that_moved_together_disagree_as_much() {
    let both = Refinement { information: surfaces() + outlines(), ..made_up::refinement(pose()) };
    let of = |shift: Vector3<f64>| {
        disagreement(&both, &[kind(surfaces(), APART + shift), kind(outlines(), shift)])
    };
    let (here, there) = (of(Vector3::zeros()), of(Vector3::new(0.01, 0.02, -0.01)));
    assert!((here - there).amax() < 1e-9 * here.amax());
}

/// Outlines hardly tell how far away the arm is, and surfaces that slide along themselves not where.
#[test]
fn where_one_kind_says_nothing_it_may_be_anywhere() {
    let blind = |axis: usize| {
        Matrix6::from_diagonal(&Vector6::from_fn(|i, _| if i == axis { 0.0 } else { 1e6 }))
    };
    let (first, second) = (blind(0), blind(2));
    let both = Refinement { information: first + second, ..made_up::refinement(pose()) };
    let of = |off_m: f64| {
        let kinds = [Vector3::x(), Vector3::z()].map(|axis| off_m * axis);
        disagreement(&both, &[kind(first, kinds[0]), kind(second, kinds[1])])
    };
    assert!(of(0.5).amax() < 1e-15);
    let seen = kind(second, Vector3::new(0.0, 0.005, 0.0));
    assert!(disagreement(&both, &[kind(first, Vector3::zeros()), seen]).amax() > 1e-7);
}

#[test]
fn a_pose_that_no_kind_determines_is_infinitely_uncertain() {
    let nothing = Refinement { information: Matrix6::zeros(), ..made_up::refinement(pose()) };
    let alone = [kind(Matrix6::zeros(), APART), kind(Matrix6::zeros(), -APART)];
    assert!(disagreement(&nothing, &alone).iter().all(|value| value.is_infinite()));
}

/// What a shift of 3 cm adds for which so much speaks, metres.
fn doubt(log_evidence: f64) -> f64 {
    let shift = Vector6::new(0.0, 0.03, 0.0, 0.0, 0.0, 0.0);
    by_doubts(&[Doubt { log_evidence, mean_square: shift * shift.transpose() }]).m22.sqrt()
}

#[test]
fn a_doubt_counts_as_much_as_speaks_for_it() {
    let all = [f64::NEG_INFINITY, -2.0, 0.0, 3.0, 9.0, 1e3].map(doubt);
    assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
    assert!(all[0] == 0.0 && all[5] == 0.03);
    assert!((all[2] - 0.03 * OFF.sqrt()).abs() < 1e-9);
}

//! The test against views whose errors are what it takes them to be, and views that are not.

use super::*;
use eyebolt_render::Random;
use nalgebra::{DMatrix, DVector};

/// Standard deviations of the stored calibration and of one view, metres and radians.
const STORED: [f64; 6] = [1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3];
const VIEW: [f64; 6] = [4e-3, 3e-3, 2e-3, 3e-3, 2e-3, 4e-3];
/// Of what moved, and of views that are spoilt.
const FAR: [f64; 6] = [3e-2; 6];

fn view(shift: &DVector<f64>, random: &mut Random) -> Quadratic {
    let information = DMatrix::from_diagonal(&DVector::from_fn(6, |i, _| VIEW[i].powi(-2)));
    let seen = DVector::from_fn(6, |i, _| shift[i] + VIEW[i] * random.normal());
    let vector = &information * seen;
    Quadratic { information, vector }
}

fn drawn(deviations: &[f64; 6], random: &mut Random) -> DVector<f64> {
    DVector::from_fn(6, |i, _| deviations[i] * random.normal())
}

fn detector_at(rate: &Rate) -> Detector {
    let [far, near] = [1.0, 0.3].map(|by| Belief::about_zero(&FAR.map(|far| by * far)));
    // Whatever moved, or along the first axis alone.
    let along =
        Belief::about_zero(&[FAR[0], STORED[1], STORED[2], STORED[3], STORED[4], STORED[5]]);
    let unmoved = Belief::about_zero(&STORED);
    let suspects = Suspects { pose: vec![far, near], others: vec![along] };
    Detector::new(Beliefs { unmoved, suspects }, rate)
}

fn detector() -> Detector {
    detector_at(&Rate::default())
}

#[test]
fn no_false_alarm_in_ten_thousand_views_of_many_calibrations() {
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let (mut detector, stored) = (detector(), drawn(&STORED, &mut random));
        for _ in 0..100 {
            // One in a hundred is spoilt.
            let spoilt = random.uniform() < 0.01;
            let shift = if spoilt { drawn(&FAR, &mut random) } else { stored.clone() };
            detector.count(&view(&shift, &mut random));
            assert!(!detector.alarms(), "seed {seed}");
        }
    }
}

/// With a low limit the average number of views to a false alarm can be counted.
#[test]
fn false_alarms_are_no_more_often_than_stated() {
    let rate = Rate { views_per_hour: 20.0, false_alarms_per_hour: 1.0 };
    let (mut views, mut alarms) = (0, 0);
    for seed in 0..200 {
        let mut random = Random::new(1000 + seed);
        let mut detector = detector_at(&rate);
        let stored = drawn(&STORED, &mut random);
        for _ in 0..60 {
            views += 1;
            detector.count(&view(&stored, &mut random));
            if detector.alarms() {
                alarms += 1;
                break;
            }
        }
    }
    assert!(f64::from(views) >= 20.0 * f64::from(alarms), "{alarms} in {views} views");
}

#[test]
fn what_moved_is_found_in_three_views_and_its_drift_within_its_uncertainty() {
    let shift = DVector::from_row_slice(&[0.006, -0.006, 0.006, 0.01, -0.01, 0.01]);
    let (mut late, mut far) = (0, 0);
    for seed in 0..200 {
        let mut random = Random::new(2000 + seed);
        let (mut detector, stored) = (detector(), drawn(&STORED, &mut random));
        for _ in 0..20 {
            detector.count(&view(&stored, &mut random));
        }
        let moved = &stored + &shift;
        let found = (0..3).any(|_| {
            detector.count(&view(&moved, &mut random));
            detector.alarms()
        });
        late += usize::from(!found);
        let moment = detector.moment().unwrap();
        let (_, belief) = moment.pose().unwrap();
        let off = &belief.mean - &moved;
        let inverse = belief.covariance.clone().try_inverse().unwrap();
        // Chi-square of six, exceeded once in a thousand.
        far += usize::from(off.dot(&(inverse * &off)) > 22.46);
    }
    assert!(late <= 2 && far <= 2, "late {late}, far {far}");
}

#[test]
fn views_that_say_nothing_change_nothing_and_one_view_is_no_alarm() {
    let mut random = Random::new(5);
    let mut quiet = detector();
    for _ in 0..5 {
        quiet.count(&view(&DVector::zeros(6), &mut random));
    }
    let before = quiet.log_evidence();
    let mut blind = quiet.clone();
    blind.count(&Quadratic::nothing(6));
    // A moment more, whose ratio is one.
    assert!((blind.log_evidence() - log_sum(before, -blind.log_limit)).abs() < 1e-9);
    let along = |detector: &Detector| {
        let moment = detector.moment().unwrap();
        let Suspects { pose, others } = &moment.suspects;
        others[0].0 - log_sum(pose[0].0, pose[1].0)
    };
    let mut slid = quiet.clone();
    let shift = DVector::from_row_slice(&[0.03, 0.0, 0.0, 0.0, 0.0, 0.0]);
    (0..3).for_each(|_| slid.count(&view(&shift, &mut random)));
    // Whoever needs fewer numbers is believed.
    assert!(slid.alarms() && along(&slid) > 3.0);
    quiet.count(&view(&DVector::from_element(6, 0.05), &mut random));
    assert!(!quiet.alarms());
    let mut absent = detector();
    absent.count_absent();
    assert!(!absent.alarms());
    (0..2).for_each(|_| absent.count_absent());
    assert!(absent.alarms());
}

use crate::strategies::config;
use eyebolt_registration::{Label, Labels, Silhouette};
use nalgebra::{Point2, Vector2};
use proptest::prelude::*;

/// Labels of 80 x 60 pixels: the arm where `signed_px` is negative.
fn labels(signed_px: impl Fn(&Point2<f32>) -> f32) -> Labels {
    Labels::from_fn(10..90, 20..80, |u, v| {
        let inside = signed_px(&Point2::new(u as f32, v as f32)) < 0.0;
        if inside { Label::Arm } else { Label::Background }
    })
}

fn pixel() -> impl Strategy<Value = Point2<f32>> {
    (11.0..88.0_f32, 21.0..78.0_f32).prop_map(|(u, v)| Point2::new(u, v))
}

fn pixels() -> impl Strategy<Value = Vec<Point2<f32>>> {
    prop::collection::vec(pixel(), 200)
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn beside_an_upright_edge_the_distance_is_exact(edge in 20..80_usize, pixels in pixels()) {
        let silhouette = Silhouette::new(&labels(|p| p.x - edge as f32));
        for p in pixels {
            let (distance, gradient) = silhouette.sample(&p).unwrap();
            // Between the last column of the arm, edge - 1, and the first beyond.
            prop_assert!((distance - (p.x - edge as f32 + 0.5)).abs() < 1e-4);
            prop_assert!((gradient - Vector2::x()).norm() < 1e-4);
        }
    }

    #[test]
    fn beside_a_straight_edge_the_distance_is_right_to_less_than_a_pixel(
        angle in 0.0..std::f32::consts::TAU, offset in -10.0..10.0_f32, pixels in pixels(),
    ) {
        let normal = Vector2::new(angle.cos(), angle.sin());
        let signed = |p: &Point2<f32>| normal.dot(&(p - Point2::new(50.0, 50.0))) - offset;
        let silhouette = Silhouette::new(&labels(signed));
        for p in pixels {
            // Near the corners of the image the nearest pixel of the edge may lie beyond it.
            let foot = p - normal * signed(&p);
            if !(15.0..85.0).contains(&foot.x) || !(25.0..75.0).contains(&foot.y) {
                continue;
            }
            let (distance, gradient) = silhouette.sample(&p).unwrap();
            let away = distance - signed(&p);
            prop_assert!(away.abs() < 0.8, "{away}");
            // The pixels' stairs turn it right beside the edge.
            let along = gradient.dot(&normal);
            let beside = signed(&p).abs() < 2.0;
            prop_assert!((along - 1.0).abs() < if beside { 0.7 } else { 0.4 }, "{along}");
        }
    }

    #[test]
    fn about_a_disc_the_distance_is_right_to_less_than_a_pixel(
        u in 40.0..60.0_f32, v in 40.0..60.0_f32, radius in 6.0..14.0_f32, pixels in pixels(),
    ) {
        let centre = Point2::new(u, v);
        let signed = |p: &Point2<f32>| (p - centre).norm() - radius;
        let silhouette = Silhouette::new(&labels(signed));
        for p in pixels {
            let (distance, gradient) = silhouette.sample(&p).unwrap();
            let away = distance - signed(&p);
            prop_assert!(away.abs() < 0.9, "{away}");
            if signed(&p) > -0.5 * radius {
                let along = gradient.dot(&(p - centre).normalize());
                prop_assert!(along > 0.4, "{along}");
            }
        }
    }

    #[test]
    fn the_outline_is_unknown_where_something_ignored_is_nearer(
        u in 10..90_usize, v in 20..80_usize, edge in 30..70_usize,
    ) {
        let silhouette = Silhouette::new(&Labels::from_fn(10..90, 20..80, |x, y| match () {
            () if (x, y) == (u, v) => Label::Ignore,
            () if x < edge => Label::Arm,
            () => Label::Background,
        }));
        for p in (11..88).flat_map(|x| (21..78).map(move |y| Point2::new(x as f32, y as f32))) {
            let outline = (p.x - edge as f32 + 0.5).abs();
            let ignored = (p - Point2::new(u as f32, v as f32)).norm();
            let known = silhouette.sample(&p).is_some();
            // A pixel on either side may be the nearest of the arm or the background.
            prop_assert!(!known || ignored > outline + 2.0, "{p:?}");
            prop_assert!(known || ignored < outline + 6.0, "{p:?}");
        }
    }

    #[test]
    fn opening_keeps_what_discs_of_the_label_cover(
        set in prop::collection::vec(prop::bool::weighted(0.9), 14 * 11),
        radius in prop_oneof![Just(0.5_f32), Just(1.2), Just(2.1), Just(2.6)],
    ) {
        let at = |u: usize, v: usize| set[(v - 3) * 14 + (u - 5)];
        let labels = Labels::from_fn(5..19, 3..14, |u, v| match at(u, v) {
            true => Label::Ignore,
            false => Label::Arm,
        });
        let all: Vec<(usize, usize)> = (3..14).flat_map(|v| (5..19).map(move |u| (u, v))).collect();
        let within = |a: &(usize, usize), b: &(usize, usize)| {
            let (du, dv) = (a.0.abs_diff(b.0) as f32, a.1.abs_diff(b.1) as f32);
            du.hypot(dv) <= radius
        };
        let is_core = |c: &&(usize, usize)| all.iter().all(|p| !within(c, p) || at(p.0, p.1));
        let cores: Vec<_> = all.iter().filter(is_core).collect();
        let expected: Vec<bool> =
            all.iter().map(|p| cores.iter().any(|core| within(core, p))).collect();
        prop_assert_eq!(labels.opened(Label::Ignore, radius), expected);
    }

    #[test]
    fn labels_are_what_they_were_made_of(set in prop::collection::vec(0..3_u8, 7 * 5)) {
        let label = |u: usize, v: usize| match set[(v - 2) * 7 + (u - 4)] {
            0 => Label::Arm,
            1 => Label::Background,
            _ => Label::Ignore,
        };
        let labels = Labels::from_fn(4..11, 2..7, label);
        for (u, v) in (0..14).flat_map(|u| (0..10).map(move |v| (u, v))) {
            let inside = (4..11).contains(&u) && (2..7).contains(&v);
            prop_assert_eq!(labels.at(u, v), inside.then(|| label(u, v)));
        }
        prop_assert_eq!(labels.count(Label::Arm), set.iter().filter(|s| **s == 0).count());
        let (to, out_of) = (labels.distance_to(Label::Arm), labels.distance_out_of(Label::Arm));
        for (at, (to, out_of)) in to.iter().zip(&out_of).enumerate() {
            prop_assert_eq!(*to == 0.0, set[at] == 0);
            prop_assert_eq!(*out_of == 0.0, set[at] != 0);
        }
    }
}

#[test]
fn where_nothing_is_labelled_no_outline_is_known() {
    let empty = Labels::from_fn(5..5, 3..3, |_, _| Label::Arm);
    assert!(Silhouette::new(&empty).sample(&Point2::new(5.0, 3.0)).is_none());
    assert!(empty.opened(Label::Arm, 2.0).is_empty());
    let only_arm = Silhouette::new(&labels(|_| -1.0));
    assert!(only_arm.sample(&Point2::new(50.0, 50.0)).is_none());
    let beyond = Silhouette::new(&labels(|p| p.x - 50.0));
    assert!(beyond.sample(&Point2::new(9.0, 50.0)).is_none());
    assert!(beyond.sample(&Point2::new(f32::NAN, 50.0)).is_none());
}

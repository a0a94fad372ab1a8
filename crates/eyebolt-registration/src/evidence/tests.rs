//! Jacobians against central differences.

use super::PosedArm;
use super::outlines::outline_factor;
use super::surfaces::surface_factor;
use crate::arm::{ArmJoint, ArmLink, ArmModel, JointAxis, JointOffsets, Posture};
use crate::distance_field::DistanceField;
use crate::intrinsics_offset::IntrinsicsOffset;
use crate::link_model::LinkModel;
use crate::silhouette::{Label, Labels, Silhouette};
use crate::unknowns::{EVIDENCE_KINDS, OUTLINES, SURFACES, State, Unknowns};
use eyebolt_geometry::{Base, Distortion, Link, PinholeCamera, Transform};
use eyebolt_render::ContourPoint;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point2, Point3, Unit, UnitQuaternion, Vector2, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use std::sync::Arc;

fn config() -> Config {
    let rng_seed = RngSeed::Fixed(7);
    Config { cases: 200, rng_seed, failure_persistence: None, ..Config::default() }
}

fn vector(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-limit..limit, -limit..limit, -limit..limit].prop_map(Vector3::from)
}

fn unmoved() -> State {
    let (camera_from_base, joint_offsets) = (Transform::identity(), JointOffsets::default());
    let (nuisances, intrinsics) = ([0.0; EVIDENCE_KINDS], IntrinsicsOffset::default());
    State { camera_from_base, nuisances, joint_offsets, intrinsics }
}

fn state() -> impl Strategy<Value = State> {
    let intrinsics = [-0.03..0.03_f64, -0.01..0.01, -0.01..0.01];
    let unknowns = (vector(1.5), vector(1.8), -0.02..0.02_f64, -2.0..2.0_f64, intrinsics);
    unknowns.prop_map(|(t, r, scale, px, intrinsics)| {
        let camera_from_base = Transform::from_parts(t, UnitQuaternion::new(r));
        let joint_offsets = JointOffsets::default();
        let intrinsics = IntrinsicsOffset::from_numbers(intrinsics);
        State { camera_from_base, nuisances: [scale, px], joint_offsets, intrinsics }
    })
}

/// Central differences of `residual` by all unknowns about `state`.
fn numeric(state: &State, residual: impl Fn(&State) -> f64) -> Unknowns {
    let h = 1e-3;
    Unknowns::from_fn(|unknown, _| {
        let step = Unknowns::ith(unknown, h);
        (residual(&state.stepped(&step)) - residual(&state.stepped(&-step))) / (2.0 * h)
    })
}

/// An arm of one link whose surface is a plane through its origin, on the second and the third of
/// three joints.
fn plane(normal: Vector3<f32>) -> ArmModel {
    let origin = Point3::new(-0.2, -0.2, -0.2);
    let field = DistanceField::from_fn(origin, 0.05, [9; 3], 0.26, |p| normal.dot(&p.coords));
    let mesh = TriangleMesh::default();
    let model = Arc::new(LinkModel { field, surface: Vec::new(), mesh });
    let joint = |carries| ArmJoint {
        name: "joint".to_owned(),
        carries: vec![carries],
        defines_base: false,
    };
    ArmModel::new(vec![ArmLink { name: "plane".to_owned(), model }])
        .with_joints([false, true, true].map(joint).to_vec())
}

fn axes() -> impl Strategy<Value = Vec<JointAxis>> {
    let axis = (vector(0.5), vector(1.0)).prop_filter_map("no direction", |(through, along)| {
        let along_in_base = Unit::try_new(along, 0.1)?;
        Some(JointAxis { through_in_base: through.into(), along_in_base })
    });
    prop::collection::vec(axis, 3)
}

fn posed<'a>(arm: &'a ArmModel, posture: &'a Posture, state: &'a State) -> PosedArm<'a> {
    PosedArm { arm, posture, state }
}

fn ray() -> impl Strategy<Value = Vector3<f64>> {
    (-0.5..0.5_f64, -0.4..0.4_f64).prop_map(|(x, y)| Vector3::new(x, y, 1.0))
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_surface_jacobian_is_the_derivative(
        state in state(), ray in ray(), depth in 0.4..2.0_f64, normal in vector(1.0),
        in_link in vector(0.1), link_turn in vector(1.8), axes in axes(),
    ) {
        let seen = ray * depth;
        let Some(normal) = normal.try_normalize(0.1) else { return Ok(()) };
        // Facing the camera, and not at a grazing angle that the steps could turn away.
        let cosine = normal.dot(&ray.normalize());
        prop_assume!(cosine.abs() > 0.1);
        let normal_in_camera = normal * -cosine.signum();
        let rotation = UnitQuaternion::new(link_turn);
        let base_from_camera = state.camera_from_base.inverse();
        let point = seen * (1.0 + state.nuisances[SURFACES]);
        let point = state.intrinsics.true_point(&point.into());
        let origin = base_from_camera.point(&point).coords - rotation * in_link;
        let base_from_link = Transform::<Base, Link>::from_parts(origin, rotation);
        let normal = rotation.inverse() * base_from_camera.direction(&normal_in_camera);
        let arm = plane(normal.cast());
        let posture = Posture::new(&arm, vec![base_from_link]).with_axes(axes);
        let at = |s: &State| {
            let moved = posture.moved(&arm, &s.joint_offsets);
            surface_factor(&posed(&arm, &moved, s), &Point3::from(seen).cast(), 0)
        };
        let factor = at(&state).expect("a surface that faces the camera");
        prop_assert!((factor.residual - normal.dot(&in_link)).abs() < 2e-5);
        prop_assert_eq!(factor.link, 0);
        let numeric = numeric(&state, |s| at(s).unwrap().residual);
        let away = (numeric - factor.jacobian).amax();
        prop_assert!(away < 2e-3, "{away}: {numeric} and {}", factor.jacobian);
    }

    #[test]
    fn the_outline_jacobian_is_the_derivative(
        state in state(), u in 10.0..54.0_f64, v in 10.0..38.0_f64, depth in 0.4..2.0_f64,
        upright in any::<bool>(), k1 in -0.1..0.1_f64, p1 in -0.01..0.01_f64,
        axes in axes(),
    ) {
        let lens = Distortion::plumb_bob([k1, 0.02, p1, 0.002, 0.0]);
        let camera = PinholeCamera::new(64, 48, 60.0, 62.0, 31.0, 24.0, lens).unwrap();
        let silhouette = Silhouette::new(&Labels::from_fn(0..64, 0..48, |u, v| {
            let arm = if upright { u < 30 } else { v < 20 };
            if arm { Label::Arm } else { Label::Background }
        }));
        let outward = if upright { Vector2::x() } else { Vector2::y() };
        // Where it is in truth that the camera sees it there.
        let as_stated = Point3::from(camera.ray(&Point2::new(u, v)).unwrap() * depth);
        let seen = state.intrinsics.true_point(&as_stated);
        let in_base = state.camera_from_base.inverse().point(&seen);
        let arm = plane(Vector3::z());
        let pose = Transform::from_parts(in_base.coords, UnitQuaternion::identity());
        let posture = Posture::new(&arm, vec![pose]).with_axes(axes);
        // The point of the surface moves along with the base and the link.
        let at = |s: &State| {
            let moved = posture.moved(&arm, &s.joint_offsets);
            let in_base = moved.base_from_link()[0].point(&Point3::origin());
            let point = s.camera_from_base.point(&in_base);
            let contour = ContourPoint {
                pixel: camera.project(&point).unwrap().cast(),
                point_in_camera: point.cast(),
                outward,
                link: 0,
                behind_m: None,
            };
            outline_factor(&posed(&arm, &moved, s), &camera, &silhouette, &contour).unwrap()
        };
        let factor = at(&state);
        let true_px = if upright { u - 29.5 } else { v - 19.5 } + state.nuisances[OUTLINES];
        prop_assert!((factor.residual - true_px).abs() < 1e-4);
        prop_assert_eq!(factor.link, 0);
        let numeric = numeric(&state, |s| at(s).residual);
        let away = (numeric - factor.jacobian).amax();
        // Pixels in single precision, a thousandth apart in metres.
        prop_assert!(away < 0.02 + 2e-3 * numeric.amax(), "{away}: {numeric}");
    }
}

#[test]
fn an_outline_turned_the_other_way_is_another_edge() {
    let camera = PinholeCamera::new(64, 48, 60.0, 60.0, 31.0, 24.0, Distortion::None).unwrap();
    let silhouette = Silhouette::new(&Labels::from_fn(0..64, 0..48, |u, _| {
        if u < 30 { Label::Arm } else { Label::Background }
    }));
    let state = unmoved();
    let arm = plane(Vector3::z());
    let posture = Posture::new(&arm, vec![Transform::identity()]);
    let factor = |outward: Vector2<f32>| {
        let contour = ContourPoint {
            pixel: Point2::new(25.0, 20.0),
            point_in_camera: Point3::new(-0.1, -0.1, 1.0),
            outward,
            link: 0,
            behind_m: None,
        };
        outline_factor(&posed(&arm, &posture, &state), &camera, &silhouette, &contour)
    };
    assert!(factor(Vector2::x()).is_some());
    assert!(factor(-Vector2::x()).is_none());
    assert!(factor(Vector2::y()).is_none());
}

#[test]
fn a_surface_that_faces_away_was_not_seen() {
    let state = unmoved();
    let pose = Transform::from_parts(Vector3::z(), UnitQuaternion::identity());
    for (towards_camera, seen) in [(-Vector3::z(), true), (Vector3::z(), false)] {
        let arm = plane(towards_camera);
        let posture = Posture::new(&arm, vec![pose]);
        let point = Point3::new(0.01, 0.02, 0.95);
        let factor = surface_factor(&posed(&arm, &posture, &state), &point, 0);
        assert_eq!(factor.is_some(), seen);
    }
}

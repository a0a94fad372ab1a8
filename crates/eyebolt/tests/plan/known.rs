//! Plans that go on from a recording: what the camera saw is kept clear of, and what is known counts.

use crate::stage::{ARM, CACHE, request};
use eyebolt::calibrate::Deviation;
use eyebolt::observations::Observations;
use eyebolt::plan::{
    Calibrated, Plan, PlanRequest, Recorded, RoughCamera, plan_next, told_range_m,
};
use eyebolt::record::{RecordOptions, observe};
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, Preset, Scenario, Viewpoint, plan as simulated};
use eyebolt_registration::{Posture, Start};
use eyebolt_render::Sensor;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Matrix6, Point3};
use std::sync::LazyLock;

struct Seen {
    observations: Observations,
    camera: RoughCamera,
    /// Points all over what stands about, base frame.
    things: Vec<Point3<f32>>,
    start: Vec<f64>,
}

/// Points on a mesh, two centimetres apart.
fn sampled(mesh: &TriangleMesh) -> Vec<Point3<f32>> {
    let mut points = Vec::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| mesh.vertices[corner as usize]);
        let longest = (b - a).norm().max((c - a).norm());
        let steps = (longest / 0.02).ceil().max(1.0) as usize;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let [u, v] = [i, j].map(|step| step as f32 / steps as f32);
                points.push(a + u * (b - a) + v * (c - a));
            }
        }
    }
    points
}

static SEEN: LazyLock<Seen> = LazyLock::new(|| {
    let robot = BuiltIn::named("shackle").unwrap();
    let arm = robot.arm();
    let scenario = Scenario {
        arm: &arm,
        urdf: robot.urdf,
        sensor: "kinect-v1".parse::<Sensor>().unwrap(),
        viewpoint: Viewpoint::Preset(Preset::named("paper-test-p2").unwrap()),
        configurations: 3,
        frames: 1,
        moving_frames: 0,
        backgrounds: 0,
        clutter: 8,
        faults: Faults::default(),
        seed: 3,
    };
    let planned = simulated(scenario, &CACHE).unwrap();
    let source = planned.in_memory().unwrap();
    let observations = observe(&source, &arm, &CACHE, &RecordOptions::default()).unwrap();
    let is_thing = |name: &str| !["table", "floor", "leg", "wall"].contains(&name);
    let things = planned.solids().iter().filter(|solid| is_thing(solid.name));
    use eyebolt_recording::FrameSource;
    let last = source.read_joints(source.frame_names().len() - 1).unwrap();
    Seen {
        camera: RoughCamera {
            camera: observations.camera.clone(),
            camera_from_base: planned.sought_camera_from_base(),
            range_m: told_range_m(&observations),
        },
        things: things.flat_map(|solid| sampled(&solid.mesh)).collect(),
        start: ARM.positions_of(&last).unwrap(),
        observations,
    }
});

fn going_on(change: impl FnOnce(&mut PlanRequest<'_>)) -> Plan {
    let cameras = [SEEN.camera.clone()];
    let at = Start::from(SEEN.camera.camera_from_base);
    let mut request = request(&cameras);
    request.recorded = Some(Recorded { observations: &SEEN.observations, at });
    request.start = Some(SEEN.start.clone());
    change(&mut request);
    plan_next(&request)
}

static NEXT: LazyLock<Plan> = LazyLock::new(|| going_on(|request| request.count = 4));

#[test]
fn nothing_that_stands_about_is_touched() {
    assert!(SEEN.things.len() > 500 && NEXT.configurations.len() == 4);
    let model = &SEEN.observations.arm;
    let robot = ARM.arm().robot();
    let places = NEXT.trajectory.windows(2).flat_map(|pair| {
        let (from, to) = (&pair[0].positions, &pair[1].positions);
        (0..6).map(move |part| {
            let along = f64::from(part) / 6.0;
            from.iter().zip(to).map(|(a, b)| a + along * (b - a)).collect::<Vec<f64>>()
        })
    });
    for positions in places {
        let poses = ARM.arm().link_poses(&ARM.all_joints(&positions)).unwrap();
        let links = model.links().iter().map(|link| poses[robot.link_index(&link.name).unwrap()]);
        let posture = Posture::new(model, links.map(Option::unwrap).collect());
        for point in &SEEN.things {
            let inside = posture.nearest_within(model, point, 0.0, 0);
            assert!(inside.is_none(), "{point} is in {inside:?}");
        }
    }
}

#[test]
fn what_is_recorded_counts() {
    let before = NEXT.before.unwrap();
    let first = NEXT.configurations[0].expected;
    assert!(first.translation_m < before.translation_m);
    assert!(NEXT.from_start && NEXT.trajectory[0].positions == SEEN.start);
    for planned in &NEXT.configurations {
        assert!((0.0..0.9).contains(&planned.unseen_share.unwrap()));
    }
}

#[test]
fn the_error_is_that_of_the_calibration_and_goes_down_from_there() {
    let expected = Deviation { translation_m: 0.004, rotation_rad: 0.003 };
    let planned = going_on(|request| {
        request.count = 2;
        request.calibrated = Some(Calibrated {
            expected,
            covariance: Matrix6::identity() * 1e-6,
            workspace_in_base: SEEN.observations.workspace(),
        });
    });
    let before = planned.before.unwrap();
    assert!((before.translation_m - 0.004).abs() < 1e-12);
    assert!((before.rotation_rad - 0.003).abs() < 1e-12);
    assert!(planned.configurations[1].expected.translation_m < 0.004);
}

#[test]
fn only_where_it_was_seen_is_less_room() {
    let seen = going_on(|request| {
        request.count = 1;
        request.seen_only = true;
    });
    assert!(seen.drawn.unseen > 0 && NEXT.drawn.unseen == 0);
    for planned in &seen.configurations {
        assert!(planned.unseen_share.unwrap() <= 0.05, "{:?}", planned.unseen_share);
    }
}

/// A calibration without its recording is what is known of the pose.
#[test]
fn a_better_camera_gains_less() {
    let with = |sigma: f64| {
        let cameras = [SEEN.camera.clone()];
        let mut request = request(&cameras);
        request.count = 2;
        request.calibrated = Some(Calibrated {
            expected: Deviation { translation_m: sigma, rotation_rad: sigma },
            covariance: Matrix6::identity() * sigma.powi(2),
            workspace_in_base: Point3::new(0.5, 0.0, 0.3),
        });
        let planned = plan_next(&request);
        let after = planned.configurations.last().unwrap().expected.translation_m;
        (planned.before.unwrap().translation_m, after)
    };
    let [(good_before, good), (bad_before, bad)] = [1e-3, 2e-2].map(with);
    assert!(good_before < bad_before && good < bad);
    assert!(good_before - good < bad_before - bad);
}

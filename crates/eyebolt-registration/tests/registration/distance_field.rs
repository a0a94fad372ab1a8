use crate::facets::Facets;
use crate::shapes::{cuboid, half_flipped, joined, moved, soup, star};
use crate::strategies::{config, isometry, point, vector};
use eyebolt_registration::DistanceField;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Isometry3, Point3, Vector3};
use proptest::prelude::*;

const VOXEL_M: f32 = 0.005;
/// The resolution that a distance is stored with.
const STEP_M: f64 = 0.26 / 32767.0;

fn field(mesh: &TriangleMesh) -> DistanceField {
    DistanceField::build(mesh, VOXEL_M, 0.04, usize::MAX)
}

/// A closed surface of 512 triangles with bumps and hollows, somewhere.
fn blob() -> impl Strategy<Value = TriangleMesh> {
    let wave = || (-0.25..0.25_f32, point(3.0));
    let shape = [wave(), wave()];
    (0.05..0.09_f32, shape, isometry(0.3)).prop_map(|(size, waves, pose)| {
        let radius = |d: &Vector3<f32>| {
            let bumps = waves.iter().map(|(height, k)| height * k.coords.dot(d).sin());
            size * (1.0 + bumps.sum::<f32>())
        };
        moved(&star(3, radius), &pose)
    })
}

/// A box of at least 4 cm with random proportions and its signed distance, in its own frame.
fn sides() -> impl Strategy<Value = [f32; 3]> {
    [0.04..0.14_f32, 0.04..0.14_f32, 0.04..0.14_f32]
}

fn box_distance(sides: &[f32; 3], p: &Point3<f64>) -> f64 {
    let q = Vector3::from([0, 1, 2].map(|i| p[i].abs() - 0.5 * f64::from(sides[i])));
    q.map(|v| v.max(0.0)).norm() + q.max().min(0.0)
}

/// About `count` of the grid points, spread over the grid.
fn grid_points(field: &DistanceField, count: usize) -> impl Iterator<Item = Point3<f32>> + use<> {
    let [nx, ny, nz] = field.size();
    let (low, voxel) = (field.bounds().0, field.voxel_m());
    // A stride that shares no factor with the size of any usual grid.
    let stride = (nx * ny * nz / count).max(1) | 1;
    (0..nx * ny * nz).step_by(stride).map(move |at| {
        let cell = [at % nx, at / nx % ny, at / (nx * ny)];
        low + Vector3::from(cell.map(|n| n as f32)) * voxel
    })
}

proptest! {
    #![proptest_config(config(6))]

    #[test]
    fn grid_points_hold_the_distance_to_the_nearest_triangle(mesh in blob()) {
        let (field, facets) = (field(&mesh), Facets::of(&mesh));
        for p in grid_points(&field, 1500) {
            let (found, true_m) = (field.nearest(&p).unwrap(), facets.distance(&p.cast()));
            let away = (f64::from(found.abs()) - true_m).abs();
            // Carried from neighbour to neighbour, the nearest triangle is at times the next best.
            let allowed = if true_m < 0.01 { STEP_M } else { 3e-4 };
            prop_assert!(away < allowed, "{found} at {p:?}, not {true_m}");
        }
    }

    #[test]
    fn the_sign_is_right_farther_than_half_a_voxel_from_the_surface(mesh in blob()) {
        let (field, facets) = (field(&mesh), Facets::of(&mesh));
        for p in grid_points(&field, 1500) {
            let found = field.nearest(&p).unwrap();
            if found.abs() > 0.51 * VOXEL_M {
                prop_assert_eq!(found < 0.0, facets.is_inside(&p.cast()), "{} at {:?}", found, p);
            }
        }
    }

    #[test]
    fn the_way_round_of_triangles_does_not_matter(mesh in blob()) {
        let (straight, mixed) = (field(&mesh), field(&half_flipped(&mesh)));
        prop_assert_eq!(straight.size(), mixed.size());
        for p in grid_points(&straight, 1 << 22) {
            let (a, b) = (straight.nearest(&p).unwrap(), mixed.nearest(&p).unwrap());
            // Rounding may tell which side a point is on that lies on the surface.
            let (a, b) = if a.abs() < 2e-5 { (a.abs(), b.abs()) } else { (a, b) };
            let allowed = if a.abs() < 0.01 { 1.5 * STEP_M } else { 3e-4 };
            prop_assert!(f64::from((a - b).abs()) < allowed, "{a} and {b} at {p:?}");
        }
    }

    #[test]
    fn what_lies_inside_does_not_count(outer in sides(), pose in isometry(0.2)) {
        let outer = outer.map(|side| side.max(0.06));
        let inner = outer.map(|side| side - 0.04);
        let shell = moved(&cuboid(outer, [0.0; 3]), &pose);
        let filled = joined(&[shell.clone(), moved(&cuboid(inner, [0.0; 3]), &pose)]);
        prop_assert_eq!(field(&filled), field(&shell));
    }

    #[test]
    fn parts_that_run_into_each_other_are_as_far_as_the_nearer(
        long in sides(), across in sides(), shift in vector(0.03), pose in isometry(0.2),
    ) {
        // Large triangles whose middles the other part may cover.
        let shift = shift.cast::<f32>();
        let parts = [cuboid(long, [0.0; 3]), cuboid(across, shift.into())];
        let field = field(&moved(&joined(&parts), &pose));
        for p in grid_points(&field, 4000) {
            let found = f64::from(field.nearest(&p).unwrap());
            let in_parts = pose.inverse_transform_point(&p.cast());
            let first = box_distance(&long, &in_parts);
            let second = box_distance(&across, &(in_parts - shift.cast()));
            let true_m = first.min(second);
            let limit = if true_m < 0.01 { 2e-5 } else { 3e-4 };
            // Inside, a side that the other part covers may be the nearest.
            let right = match true_m {
                // Too near the surface, probes may take the wrong side in a corner.
                d if d >= 0.0 && d < 0.51 * f64::from(VOXEL_M) => (found.abs() - d).abs() < limit,
                d if d >= 0.0 => (found - d).abs() < limit,
                d if d > -2.5 * f64::from(VOXEL_M) => found < 0.51 * f64::from(VOXEL_M),
                _ => found < 0.0,
            };
            prop_assert!(right, "{found} at {in_parts:?}, not {true_m}");
        }
    }

    #[test]
    fn a_sheet_is_as_far_as_it_is_and_its_front_is_outside(
        side in 0.05..0.15_f32, pose in isometry(0.2),
    ) {
        let corner = |u: f32, v: f32| Vector3::new(u * side, v * side, 0.0);
        let [a, b, c, d] = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let sheet = moved(&soup(&[[a, b, c], [a, c, d]]), &pose);
        let (field, facets) = (field(&sheet), Facets::of(&sheet));
        for p in grid_points(&field, 4000) {
            let found = f64::from(field.nearest(&p).unwrap());
            prop_assert!((found.abs() - facets.distance(&p.cast())).abs() < 1e-4);
            let above = pose.inverse_transform_point(&p.cast()).z;
            prop_assert!(found >= 0.0 || above < 1e-4, "{found}, {above} before the sheet");
            let sample = field.sample(&p);
            prop_assert!(sample.distance_m.is_finite());
            prop_assert!(sample.gradient.iter().all(|g| g.is_finite()));
        }
    }

    #[test]
    fn a_box_has_the_distances_of_a_box(
        sides in sides(), pose in isometry(0.2), points in prop::collection::vec(point(0.13), 400),
    ) {
        let field = field(&moved(&cuboid(sides, [0.0; 3]), &pose));
        for in_box in points {
            let p: Point3<f32> = (pose * in_box.cast::<f64>()).cast();
            let true_m = box_distance(&sides, &in_box.cast());
            let away = (f64::from(field.sample(&p).distance_m) - true_m).abs();
            // Linear about the middle of a face, and so exact; rounded off about edges.
            let half = sides.map(|side| 0.5 * side);
            let beside = (0..3).filter(|i| in_box[*i].abs() > half[*i] - 2.0 * VOXEL_M).count();
            let before_a_face = beside == 1 && true_m.abs() < 0.006;
            let allowed = if before_a_face { 1e-4 } else { 0.5 * f64::from(VOXEL_M) };
            let on_grid = field.nearest(&p).is_some();
            prop_assert!(!on_grid || away < allowed, "{away} at {in_box:?}, {true_m}");
        }
    }

    #[test]
    fn a_ball_has_the_distances_of_a_ball(
        radius in 0.04..0.08_f32, points in prop::collection::vec(point(0.1), 400),
    ) {
        let field = field(&star(5, |_| radius));
        for p in points {
            let from_centre = f64::from(p.coords.norm());
            let (low, high) = field.bounds();
            let on_grid = (0..3).all(|i| (low[i]..high[i]).contains(&p[i]));
            if from_centre < 0.02 || !on_grid {
                continue;
            }
            let sample = field.sample(&p);
            let away = (f64::from(sample.distance_m) - (from_centre - f64::from(radius))).abs();
            // An eighth of the squared voxel by each of the two curvatures.
            let bent = f64::from(VOXEL_M * VOXEL_M) / 4.0 / (from_centre - 0.009);
            prop_assert!(away < 1e-4 + bent, "{away} at {p:?}");
            let outward = sample.gradient.normalize().dot(&p.coords.normalize());
            prop_assert!(outward > 0.96, "{outward}");
        }
    }

    #[test]
    fn beyond_the_grid_distances_grow_and_are_over_by_no_more_than_at_its_border(
        mesh in blob(), direction in point(1.0),
    ) {
        let (field, facets) = (field(&mesh), Facets::of(&mesh));
        let (low, high) = field.bounds();
        let middle = nalgebra::center(&low, &high);
        let Some(direction) = direction.coords.try_normalize(0.1) else { return Ok(()) };
        let inside = |p: &Point3<f32>| (0..3).all(|i| (low[i]..=high[i]).contains(&p[i]));
        let mut before = 0.0;
        for step in 1..60 {
            let p = middle + direction * (0.02 * step as f32);
            if inside(&p) {
                continue;
            }
            let found = field.sample(&p).distance_m;
            prop_assert!(found > before, "{found} after {before}");
            before = found;
            let border = Point3::from(p.coords.zip_zip_map(&low.coords, &high.coords, f32::clamp));
            let over = f64::from(found) - facets.distance(&p.cast());
            let most = facets.distance(&border.cast()) + 1e-3;
            prop_assert!((-1e-3..most).contains(&over), "{over} over, {most}");
        }
    }
}

#[test]
fn a_mesh_without_triangles_is_infinitely_far() {
    let field = field(&TriangleMesh::default());
    let distance = field.sample(&Point3::new(0.1, 0.2, 0.3)).distance_m;
    assert!(distance > 0.2, "{distance}");
}

#[test]
fn turning_the_mesh_turns_the_field() {
    let mesh = cuboid([0.1, 0.06, 0.14], [0.02, 0.0, 0.05]);
    let turn = Isometry3::rotation(Vector3::z() * std::f64::consts::FRAC_PI_2);
    let (straight, turned) = (field(&mesh), field(&moved(&mesh, &turn)));
    for p in grid_points(&straight, 5000) {
        let q: Point3<f32> = (turn * p.cast::<f64>()).cast();
        let (a, b) = (straight.sample(&p).distance_m, turned.sample(&q).distance_m);
        assert!((a - b).abs() < 0.5 * VOXEL_M, "{a} and {b} at {p:?}");
    }
}

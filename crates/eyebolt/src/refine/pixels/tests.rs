//! What pixels say of a box that stands elsewhere in each of three configurations, before a wall.

use super::*;
use crate::made_up::{self, BOX};
use crate::observations::Background;
use eyebolt_geometry::{Base, Camera, DepthImage, Transform};
use eyebolt_registration::Posture;
use nalgebra::{UnitQuaternion, Vector3};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 240;
/// Where the box is, metres to the right: in the image farther apart than scenes keep clear of arms.
const PLACES_M: [f64; 3] = [-0.38, 0.0, 0.38];
/// The box stands in the middle in this one.
const OWN: usize = 1;
const WALL_M: f32 = 2.5;
/// What a camera tells of what is out of its range.
const OUT_OF_RANGE: f32 = 0.0;

fn camera_from_base() -> Transform<Camera, Base> {
    Transform::from_parts(Vector3::new(0.0, 0.0, 1.0), UnitQuaternion::identity())
}

fn posture(place_m: f64) -> Posture {
    let translation = Vector3::new(place_m, 0.0, 0.0);
    Posture::new(&BOX, vec![Transform::from_parts(translation, UnitQuaternion::identity())])
}

fn drawn(posture: &Posture) -> Raster {
    let camera = made_up::camera(WIDTH, HEIGHT, 200.0);
    let mut raster = Raster::new(&camera);
    raster.draw(&camera, &posture.meshes(&BOX, &camera_from_base()));
    raster
}

/// The box at each of `places_m`, seen without error before a scene all of which is `scene_m` away.
fn scene(places_m: &[f64], scene_m: f32) -> Observations {
    let seen = places_m.iter().map(|place_m| {
        let posture = posture(*place_m);
        let depth = drawn(&posture).to_depth_image().into_depth_m().into_iter();
        let depth = depth.map(|z| if z > 0.0 { z } else { scene_m }).collect();
        (posture, DepthImage::new(WIDTH, HEIGHT, depth).unwrap())
    });
    made_up::observations(made_up::camera(WIDTH, HEIGHT, 200.0), &BOX, seen.collect())
}

/// The box's pixels in configuration `own`, and those of them clear of its outline.
fn pixels(observations: &Observations, own: usize) -> (Vec<usize>, Vec<usize>) {
    let raster = drawn(&observations.configurations[own].posture);
    let all: Vec<usize> = raster.pixels().collect();
    let inner = box_mask(&all).eroded(RIM_PX);
    let clear = all.iter().copied().filter(|at| inner.as_slice()[*at]).collect();
    (all, clear)
}

fn box_mask(pixels: &[usize]) -> Mask {
    let mut set = vec![false; (WIDTH * HEIGHT) as usize];
    pixels.iter().for_each(|at| set[*at] = true);
    Mask::new(WIDTH, HEIGHT, set).unwrap()
}

/// `at` is seen at `depth_m` in configuration `own`.
fn show(observations: &mut Observations, own: usize, at: &[usize], depth_m: f32) {
    let depth = &mut observations.configurations[own].depth;
    let mut seen = depth.depth_m().to_vec();
    at.iter().for_each(|at| seen[*at] = depth_m);
    *depth = DepthImage::new(WIDTH, HEIGHT, seen).unwrap();
}

fn count(observations: &Observations, own: usize) -> PixelCounts {
    let views = observations.views();
    let rasters: Vec<Raster> =
        observations.configurations.iter().map(|c| drawn(&c.posture)).collect();
    let background = KnownBackground::new(observations, &views, &rasters);
    let counts = count_pixels(observations, &views[own], &rasters[own], &background, own);
    let [counts] = counts[..] else { panic!("the box is one link") };
    let all = counts.agree + counts.ambiguous + counts.contradict + counts.unknown;
    assert_eq!(all, rasters[own].pixels().count(), "{counts:?}");
    counts
}

#[test]
fn an_arm_in_its_place_agrees_before_any_scene() {
    for scene_m in [WALL_M, OUT_OF_RANGE] {
        let observations = scene(&PLACES_M, scene_m);
        for own in 0..PLACES_M.len() {
            let counts = count(&observations, own);
            let agree = pixels(&observations, own).0.len();
            assert!(agree > 3000);
            assert_eq!(counts, PixelCounts { agree, ..PixelCounts::default() });
        }
    }
}

#[test]
fn a_hole_or_a_wrong_match_on_the_arm_contradicts_nothing() {
    // Behind the arm, but neither where the wall is nor beyond all that was ever seen; and beyond it.
    for wrong_m in [OUT_OF_RANGE, 1.2, 2.0, 4.0] {
        let mut observations = scene(&PLACES_M, WALL_M);
        let (all, _) = pixels(&observations, OWN);
        let (spoiled, rest) = all.split_at(all.len() / 2);
        show(&mut observations, OWN, spoiled, wrong_m);
        let counts = count(&observations, OWN);
        let (agree, unknown) = (rest.len(), spoiled.len());
        assert_eq!(counts, PixelCounts { agree, unknown, ..counts }, "{wrong_m} m");
        assert_eq!(counts.contradicted_share(), 0.0, "{wrong_m} m");
    }
}

#[test]
fn the_known_scene_in_the_arms_place_contradicts_also_out_of_range() {
    for scene_m in [WALL_M, OUT_OF_RANGE] {
        // One more configuration has seen the arm there: nothing stands too near to the camera.
        let places: Vec<_> = PLACES_M.into_iter().chain([PLACES_M[OWN]]).collect();
        let mut observations = scene(&places, scene_m);
        let (all, clear) = pixels(&observations, OWN);
        show(&mut observations, OWN, &all, scene_m);
        let counts = count(&observations, OWN);
        let (contradict, unknown) = (clear.len(), all.len() - clear.len());
        assert!(contradict > 0 && unknown > 0);
        assert_eq!(counts, PixelCounts { contradict, unknown, ..PixelCounts::default() });
        assert_eq!(counts.contradicted_share(), 1.0);
        // Of the arm as it stands in the others nothing is known any better or worse.
        assert_eq!(count(&observations, 0).contradict, 0);
    }
}

/// Something nearer than the camera sees may stand there.
#[test]
fn where_nobody_ever_saw_anything_nothing_is_contradicted() {
    let mut observations = scene(&PLACES_M, OUT_OF_RANGE);
    let (all, _) = pixels(&observations, OWN);
    show(&mut observations, OWN, &all, OUT_OF_RANGE);
    assert_eq!(count(&observations, OWN).unknown, all.len());
}

/// Nothing tells a wall from a wrong match if no other configuration has seen it.
#[test]
fn a_scene_that_nobody_knows_contradicts_nothing_until_frames_without_the_arm_show_it() {
    let mut observations = scene(&PLACES_M[OWN..=OWN], WALL_M);
    let (all, clear) = pixels(&observations, 0);
    show(&mut observations, 0, &all, WALL_M);
    assert_eq!(count(&observations, 0).unknown, all.len());
    let wall = DepthImage::new(WIDTH, HEIGHT, vec![WALL_M; (WIDTH * HEIGHT) as usize]).unwrap();
    observations.background = Background::Seen(wall);
    assert_eq!(count(&observations, 0).contradict, clear.len());
}

/// Where the arm is drawn in another configuration too, that one's depth is the arm's, not the scene's.
#[test]
fn other_configurations_tell_the_scene_only_clear_of_their_arm() {
    let mut observations = scene(&[0.0, 0.04, 0.38], WALL_M);
    let (all, _) = pixels(&observations, 2);
    show(&mut observations, 2, &all, 0.9);
    let views = observations.views();
    let rasters: Vec<Raster> =
        observations.configurations.iter().map(|c| drawn(&c.posture)).collect();
    let background = KnownBackground::new(&observations, &views, &rasters);
    let middle = (HEIGHT / 2 * WIDTH + WIDTH / 2) as usize;
    // Only the third one is clear of the arm there, and it saw the wall.
    assert_eq!(background.behind(0, middle, WALL_M), Behind::Same);
    assert_eq!(background.behind(0, middle, 0.85), Behind::Farther);
    assert_eq!(background.behind(0, middle, OUT_OF_RANGE), Behind::Farther);
    assert_eq!(background.behind(2, middle, 0.85), Behind::Unknown);
    assert_eq!(background.behind(2, middle, WALL_M), Behind::Unknown);
}

#[test]
fn what_stands_before_the_arm_hides_it() {
    let mut observations = scene(&PLACES_M, WALL_M);
    let (all, _) = pixels(&observations, OWN);
    show(&mut observations, OWN, &all, 0.6);
    assert_eq!(count(&observations, OWN).unknown, all.len());
}

#[test]
fn depth_that_may_as_well_be_the_scene_neither_agrees_nor_contradicts() {
    // A board just behind the face of the box that is turned to the camera.
    let observations = scene(&PLACES_M, 0.86);
    let counts = count(&observations, OWN);
    assert_eq!(counts.ambiguous, pixels(&observations, OWN).0.len());
}

#[test]
fn within_the_mask_depth_contradicts_nothing_and_outside_of_it_everything_does() {
    let mut observations = scene(&PLACES_M, WALL_M);
    let (all, clear) = pixels(&observations, OWN);
    observations.configurations[OWN].mask = Some(box_mask(&all));
    assert_eq!(count(&observations, OWN).agree, all.len());
    // Glass, as the wall behind it: the mask knows better.
    show(&mut observations, OWN, &all, WALL_M);
    assert_eq!(count(&observations, OWN).unknown, all.len());
    // The arm is where the mask is not, whatever is seen there.
    let nowhere = Mask::new(WIDTH, HEIGHT, vec![false; (WIDTH * HEIGHT) as usize]).unwrap();
    observations.configurations[OWN].mask = Some(nowhere);
    for seen_m in [WALL_M, OUT_OF_RANGE, 0.85] {
        show(&mut observations, OWN, &all, seen_m);
        let counts = count(&observations, OWN);
        assert_eq!((counts.contradict, counts.agree), (clear.len(), 0), "{seen_m} m");
    }
}

/// A mask that is drawn a little too narrow says nothing.
#[test]
fn masks_are_trusted_to_a_few_pixels() {
    let mut observations = scene(&PLACES_M, WALL_M);
    let (all, _) = pixels(&observations, OWN);
    observations.configurations[OWN].mask = Some(box_mask(&all).eroded(MASK_RIM_PX));
    assert_eq!(count(&observations, OWN).contradict, 0);
    observations.configurations[OWN].mask = Some(box_mask(&all).eroded(3 * MASK_RIM_PX));
    assert!(count(&observations, OWN).contradict > 0);
}

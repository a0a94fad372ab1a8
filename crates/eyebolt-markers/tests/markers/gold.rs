//! Photographs of others, with the corners that OpenCV's own test expects.

use crate::shared::{picture, shared};
use eyebolt_geometry::{Distortion, PinholeCamera};
use eyebolt_markers::{Detection, Dictionary, Target, detect, planar_poses};
use nalgebra::Point2;
use serde_json::Value;
use std::path::Path;

/// The markers that the gold names, by number.
fn expected(folder: &Path, name: &str) -> Vec<(u32, [Point2<f64>; 4])> {
    let text = std::fs::read_to_string(folder.join("expected_corners.json")).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    let marker = |marker: &Value| {
        let corners: [[f64; 2]; 4] = serde_json::from_value(marker["corners"].clone()).unwrap();
        (marker["id"].as_u64().unwrap() as u32, corners.map(Point2::from))
    };
    let mut markers: Vec<_> = all[name]["markers"].as_array().unwrap().iter().map(marker).collect();
    markers.sort_by_key(|(id, _)| *id);
    markers
}

/// The dictionary of one picture, as OpenCV writes it.
fn of_tutorial(folder: &Path) -> Dictionary {
    let text = std::fs::read_to_string(folder.join("tutorial_dict.yml")).unwrap();
    let words = text.lines().filter(|line| line.starts_with("marker_"));
    let word = |line: &str| u64::from_str_radix(line.split('"').nth(1).unwrap(), 2).unwrap();
    Dictionary::custom(6, words.map(word).collect(), 2).unwrap()
}

/// Distances of corners from the gold's, sorted, pixels.
fn distances(
    found: &[Detection],
    wanted: &[(u32, [Point2<f64>; 4])],
    corners: impl Fn(&Detection) -> [Point2<f64>; 4],
) -> Vec<f64> {
    let pairs = found.iter().zip(wanted);
    let each = pairs.flat_map(|(found, (_, gold))| {
        corners(found).into_iter().zip(*gold).map(|(a, b)| (a - b).norm()).collect::<Vec<_>>()
    });
    let mut all: Vec<f64> = each.collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Half a pixel inward along both sides: from a marker's edge to the centres of its outermost pixels, of which
/// the gold is made.
fn inward(marker: &Detection) -> [Point2<f64>; 4] {
    let corners = marker.corners_px;
    [0, 1, 2, 3].map(|i| {
        let to = |k: usize| (corners[(i + k) % 4] - corners[i]).normalize();
        corners[i] + (to(1) + to(3)) * 0.5
    })
}

#[test]
fn photographs_show_what_opencv_finds() {
    let Some(data) = shared("photographs_show_what_opencv_finds") else { return };
    let folder = data.join("markers/opencv_aruco");
    let known = Dictionary::named("6x6_250").unwrap();
    for (name, dictionary) in [
        ("singlemarkersoriginal.jpg", &known),
        ("choriginal.jpg", &known),
        ("chocclusion_original.jpg", &known),
        ("gboriginal.jpg", &of_tutorial(&folder)),
    ] {
        let wanted = expected(&folder, name);
        let found = detect(&picture(&folder.join(name)), dictionary);
        let ids = |all: &mut dyn Iterator<Item = u32>| all.collect::<Vec<_>>();
        assert_eq!(
            ids(&mut found.iter().map(|m| m.id)),
            ids(&mut wanted.iter().map(|m| m.0)),
            "{name}"
        );
        let outline = distances(&found, &wanted, |marker| marker.outline_px);
        let fine = distances(&found, &wanted, inward);
        let middle = |all: &[f64]| all[all.len() / 2];
        let largest = |all: &[f64]| all[all.len() - 1];
        // The gold is of whole pixels, and the same version of OpenCV that finds it in the others is 1.41 px off
        // in the last picture.
        let limit = if name == "gboriginal.jpg" { 1.5 } else { 0.5 };
        assert!(largest(&outline) <= limit && middle(&outline) <= 0.5, "{name}: {outline:?}");
        // A fraction of a pixel lies anywhere about a whole one; the last picture is of tags of two pixels a cell.
        assert!(middle(&fine) < 0.65 && largest(&fine) < limit + 0.5, "{name}: {fine:?}");
    }
}

#[test]
fn other_photographs_have_their_markers_and_no_others() {
    let Some(data) = shared("other_photographs_have_their_markers_and_no_others") else { return };
    let folder = data.join("markers/opencv_aruco");
    let known = Dictionary::named("6x6_250").unwrap();
    for number in 0..4 {
        let image = picture(&folder.join(format!("img_0{number}.jpg")));
        let ids: Vec<u32> = detect(&image, &known).iter().map(|m| m.id).collect();
        assert_eq!(ids, (0..17).collect::<Vec<_>>(), "img_0{number}");
    }
    let pictures = [
        "singlemarkersoriginal",
        "choriginal",
        "chocclusion_original",
        "gboriginal",
        "img_00",
        "img_01",
        "img_02",
        "img_03",
    ];
    for name in pictures {
        let image = picture(&folder.join(format!("{name}.jpg")));
        // 4x4 and 16h5 have so few bits that anything may be one; the others would be mistakes.
        for other in ["5x5_1000", "7x7_1000", "36h11", "25h9"] {
            let found = detect(&image, &Dictionary::named(other).unwrap());
            assert_eq!(found, [], "{name} has no {other}");
        }
    }
}

#[test]
fn boards_are_seen_whole() {
    let Some(data) = shared("boards_are_seen_whole") else { return };
    let folder = data.join("handeye/moveit_calibration");
    let image = picture(&folder.join("test_aruco_marker_detection.png"));
    let target: Target = "grid:4x4_250:3x4:0.0256:0.0066".parse().unwrap();
    let sighting = target.sighting(&image, &target.detect(&image)).unwrap();
    assert_eq!(sighting.ids, (0..12).collect::<Vec<_>>());
    let camera =
        PinholeCamera::new(640, 480, 618.6, 619.11, 321.984, 241.146, Distortion::None).unwrap();
    let poses = planar_poses(&sighting.points, &camera);
    // OpenCV's corners leave 0.78 px, refined in any of its ways 0.47 to 0.82: the sheet is not quite flat.
    assert!(poses[0].rms_px < 0.6, "{poses:?}");

    let image = picture(&folder.join("test_charuco_board_detection.jpg"));
    let square_m = 0.1971 / 7.0;
    let target: Target = format!("charuco:5x5_250:5x7:{square_m}:0.0176").parse().unwrap();
    let sighting = target.sighting(&image, &target.detect(&image)).unwrap();
    assert_eq!(sighting.ids.len(), 17);
    assert_eq!(sighting.points.len(), 24);
    let lens =
        Distortion::plumb_bob([0.154_054_98, -0.249_168_42, 0.003_507_91, -0.001_100_41, 0.0]);
    let camera = PinholeCamera::new(640, 480, 590.697, 592.847, 322.331, 247.4, lens).unwrap();
    let poses = planar_poses(&sighting.points, &camera);
    // OpenCV's corners leave 0.26 px.
    assert!(poses[0].rms_px < 0.3, "{poses:?}");
}

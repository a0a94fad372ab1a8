//! The clouds that the page holds are those that the camera saw.

use crate::sample::{GOOD, PAGE};
use nalgebra::Point3;
use serde_json::Value;

/// RFC 4648, read by its letters' places.
fn decoded(text: &Value) -> Vec<u8> {
    const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = text.as_str().unwrap().chars().filter_map(|letter| LETTERS.find(letter));
    let digits: Vec<usize> = digits.collect();
    let bytes = digits.chunks(4).flat_map(|group| {
        let bits = group.iter().fold(0, |bits, digit| bits << 6 | digit);
        let bits = bits << (6 * (4 - group.len()));
        (0..group.len() - 1).map(move |place| (bits >> (16 - 8 * place)) as u8)
    });
    bytes.collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn each_point_lies_where_its_pixel_saw_it() {
    let (_, rest) = PAGE.split_once("id=\"scene-data\">").unwrap();
    let data: Value = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    let observations = GOOD.outcome.observations.as_ref().unwrap();
    let refinement = GOOD.outcome.calibration.refinement.as_ref().unwrap();
    let (low, size) = (numbers(&data["bounds"]["low"]), numbers(&data["bounds"]["size"]));
    let configurations = data["configurations"].as_array().unwrap();
    assert_eq!(configurations.len(), observations.configurations.len());
    for (seen, configuration) in configurations.iter().zip(&observations.configurations) {
        let bytes = decoded(&seen["points"]);
        let words: Vec<u16> =
            bytes.chunks(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
        let count = seen["count"].as_u64().unwrap() as usize;
        assert!((5_000..=60_000).contains(&count), "{count} points");
        assert_eq!(words.len(), 3 * count);
        assert_eq!(decoded(&seen["labels"]).len(), count);
        assert_eq!(decoded(&seen["behind_mm"]).len(), count);
        for word in words.chunks(3) {
            let at = |axis: usize| low[axis] + size[axis] * f64::from(word[axis]) / 65535.0;
            let point = refinement.camera_from_base.point(&Point3::new(at(0), at(1), at(2)));
            let pixel = observations.camera.project(&point).unwrap();
            let (u, v) = (pixel.x.round(), pixel.y.round());
            assert!((pixel.x - u).abs() < 0.1 && (pixel.y - v).abs() < 0.1, "{pixel}");
            let seen_m = f64::from(configuration.depth.at(u as u32, v as u32));
            let scaled_m = seen_m * (1.0 + refinement.depth_scale());
            assert!((point.z - scaled_m).abs() < 3e-4, "{} {scaled_m}", point.z);
        }
    }
}

#[test]
fn the_arms_points_are_near_its_surface_and_dropped_configurations_are_marked() {
    let (_, rest) = PAGE.split_once("id=\"scene-data\">").unwrap();
    let data: Value = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    for (index, seen) in data["configurations"].as_array().unwrap().iter().enumerate() {
        assert_eq!(seen["dropped"], index == 2);
        let pairs = decoded(&seen["labels"]).into_iter().zip(decoded(&seen["behind_mm"]));
        let arm: Vec<i8> =
            pairs.filter(|(label, _)| *label == 1).map(|(_, mm)| mm.cast_signed()).collect();
        assert!(arm.len() > 1000, "{}", arm.len());
        assert!(arm.iter().all(|mm| mm.abs() <= 60), "what is taken for the arm is near it");
    }
}

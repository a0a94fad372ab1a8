//! How runs end, and which files they leave.

use crate::desk::{Desk, text};
use crate::good::{GOOD, parsed};
use crate::program::Ended;
use crate::scene::CAMERA;
use serde_json::Value;
use std::fs;

#[test]
fn trusted_ends_with_0_and_says_only_the_summary() {
    let Ended { code, out, err } = &GOOD.ended;
    assert_eq!(*code, Some(0), "out: {out}\nerr: {err}");
    assert!(out.starts_with("TRUSTED (5 of 5 frames used)\n"), "{out}");
    assert!(
        out.contains("mm") && out.contains("degrees") && out.contains("translation_m"),
        "{out}"
    );
    assert!(out.contains(&format!("written to {}\n", text(&GOOD.desk.file("calibration.json")))));
    assert_eq!(err, "", "no progress bar where there is no terminal");
    assert_eq!(GOOD.desk.names(), ["calibration.json", "pictures", "report.html"]);
}

#[test]
fn the_bytes_are_the_same_on_any_number_of_threads() {
    let desk = Desk::new();
    let ended = desk.calibrate(&["--threads", "2"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(fs::read(desk.file("calibration.json")).unwrap() == GOOD.json.as_bytes());
}

#[test]
fn the_page_tells_of_this_run_and_is_the_same_on_any_number_of_threads() {
    let report = GOOD.desk.file("report.html");
    assert!(GOOD.ended.out.contains(&format!("\nreport in {}", text(&report))));
    let page = fs::read_to_string(report).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("Trusted"));
    let pose = &parsed()["base_from_camera"]["translation_m"];
    assert!(page.contains(&format!("--x {}", pose[0])), "{pose}");
    assert_eq!(page.matches("data:image/png;base64,").count(), 5);
    let desk = Desk::new();
    desk.calibrate(&["--threads", "2", "--report", text(&desk.file("report.html"))]);
    assert!(fs::read_to_string(desk.file("report.html")).unwrap() == page);
}

#[test]
fn pictures_are_of_the_cameras_size() {
    let pictures = GOOD.desk.file("pictures");
    assert!(GOOD.ended.out.contains(&format!("5 pictures in {}", text(&pictures))));
    assert_eq!(fs::read_dir(&pictures).unwrap().count(), 5);
    for frame in 0..5 {
        let file = fs::read(pictures.join(format!("overlay_{frame}.png"))).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (CAMERA.width(), CAMERA.height()));
        assert_eq!(info.color_type, png::ColorType::Rgb);
    }
}

#[test]
fn refused_ends_with_3_and_goes_to_another_file() {
    let desk = Desk::new();
    let ended = desk.calibrate(&["--max-error-mm", "0.001"]);
    assert_eq!(ended.code, Some(3), "out: {}\nerr: {}", ended.out, ended.err);
    assert!(ended.out.starts_with("REFUSED"), "{}", ended.out);
    assert!(ended.out.contains("written to") && ended.out.contains("calibration.rejected.json"));
    assert!(!ended.out.contains("translation_m"), "no pose to copy by mistake: {}", ended.out);
    assert_eq!(ended.err, "");
    assert_eq!(desk.names(), ["calibration.rejected.json"]);
    let text = fs::read_to_string(desk.file("calibration.rejected.json")).unwrap();
    let rejected: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(rejected["verdict"], "refused");
    let reason = rejected["reasons"][0].as_str().unwrap();
    assert!(reason.contains("0.0 mm") && reason.contains("allowed"), "{reason}");
    // All but the verdict is as it was.
    let mut good = parsed();
    (good["verdict"], good["reasons"]) = (rejected["verdict"].clone(), rejected["reasons"].clone());
    assert_eq!(good, rejected);
}

#[test]
fn timing_is_added_on_request() {
    let desk = Desk::new();
    assert_eq!(desk.calibrate_stranger(&["--timing"]).code, Some(3));
    let text = fs::read_to_string(desk.file("calibration.rejected.json")).unwrap();
    let rejected: Value = serde_json::from_str(&text).unwrap();
    let timing = rejected["timing_ms"].as_object().unwrap();
    let ms = |name: &str| timing[name].as_f64().unwrap();
    let stages: f64 = timing.keys().filter(|name| *name != "total").map(|name| ms(name)).sum();
    assert!(timing.contains_key("record") && timing.values().all(|ms| ms.as_f64() >= Some(0.0)));
    assert!((ms("total") - stages).abs() < 1e-6);
}

#[test]
fn of_more_configurations_than_wanted_the_rest_is_said_to_be_spare() {
    let desk = Desk::new();
    let ended = desk.calibrate(&["--max-configurations", "4"]);
    let file = if ended.code == Some(0) { "calibration.json" } else { "calibration.rejected.json" };
    let answer: Value = serde_json::from_slice(&fs::read(desk.file(file)).unwrap()).unwrap();
    assert_eq!(answer["spare_configurations"], 1);
    assert_eq!(answer["configurations"].as_array().unwrap().len(), 4);
    assert!(ended.out.contains("1 more configuration not needed"), "{}", ended.out);
}

//! Damaged and hostile files: an error, or something harmless, and never much memory.

use crate::json::{calibration, example};
use crate::trees::ECHO;
use eyebolt::export::{MAX_CALIBRATION_BYTES, MAX_TREE_BYTES, SavedCalibration, StaticTree};
use eyebolt_robot::PackageRoots;
use std::fs;
use std::path::Path;

#[test]
fn every_prefix_of_a_calibration_is_an_error() {
    let whole = serde_json::to_string_pretty(&calibration(&example())).unwrap();
    assert!(SavedCalibration::parse("c.json", &whole).is_ok());
    for end in 0..whole.len() {
        let error = SavedCalibration::parse("c.json", &whole[..end]).unwrap_err().to_string();
        assert!(error.starts_with("c.json: line "), "{error}");
        assert!(error.contains("as `eyebolt calibrate` wrote it"), "{error}");
    }
}

#[test]
fn every_prefix_of_transforms_is_an_error_or_a_tree() {
    let mut errors = 0;
    for end in 0..ECHO.len() {
        match StaticTree::from_tf_message("tf.yaml", &ECHO[..end]) {
            Ok(tree) => assert!(!tree.is_empty()),
            Err(error) => {
                assert!(error.to_string().starts_with("tf.yaml: "), "{error}");
                errors += 1;
            }
        }
    }
    assert!(errors > ECHO.len() / 2, "{errors}");
}

#[test]
fn every_byte_may_be_another_one() {
    let json = serde_json::to_string(&calibration(&example())).unwrap();
    for whole in [json.as_str(), ECHO] {
        for at in 0..whole.len() {
            for other in [0, b'\n', b'"', b'-', b'9', b'{', b'&', b'*'] {
                let mut bytes = whole.as_bytes().to_vec();
                bytes[at] = other;
                let Ok(text) = std::str::from_utf8(&bytes) else { continue };
                // Whatever comes of it, it comes without a panic.
                let _ = SavedCalibration::parse("c.json", text);
                let _ = StaticTree::from_tf_message("tf.yaml", text);
            }
        }
    }
}

#[test]
fn deep_and_multiplying_text_is_an_error() {
    let deep = "[".repeat(1 << 19);
    let bomb: String = (0..12)
        .map(|level| match level {
            0 => "a0: &a0 [x, x, x, x, x, x, x, x, x]\n".to_owned(),
            _ => {
                let alias = format!("*a{}, ", level - 1).repeat(9);
                format!("a{level}: &a{level} [{alias}]\n")
            }
        })
        .collect();
    let many = format!("transforms: [{}]", "{},".repeat(300_000));
    let documents = "---\ntransforms: []\n".repeat(20_000);
    for text in [&deep, &bomb, &many, &documents] {
        assert!(SavedCalibration::parse("c.json", text).is_err());
        assert!(StaticTree::from_tf_message("tf.yaml", text).is_err());
    }
    // What is deep and not looked at is no better.
    let json = calibration(&example()).to_string();
    let hidden = json.replacen('{', &format!("{{\"more\": {deep},"), 1);
    assert!(SavedCalibration::parse("c.json", &hidden).is_err());
}

#[test]
fn files_are_read_up_to_their_limit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large");
    fs::write(&path, " ".repeat(usize::try_from(MAX_CALIBRATION_BYTES).unwrap() + 1)).unwrap();
    let error = SavedCalibration::read(&path).unwrap_err().to_string();
    assert!(error.contains("larger than 16 MiB"), "{error}");
    fs::write(&path, "#".repeat(usize::try_from(MAX_TREE_BYTES).unwrap() + 1)).unwrap();
    let error =
        StaticTree::read(&path, &PackageRoots::new(), Path::new(".")).unwrap_err().to_string();
    assert!(error.contains("larger than 1 MiB"), "{error}");
    fs::write(&path, b"transforms: \xff").unwrap();
    let error =
        StaticTree::read(&path, &PackageRoots::new(), Path::new(".")).unwrap_err().to_string();
    assert!(error.contains("byte 12 is not UTF-8"), "{error}");
    fs::write(&path, "<robot").unwrap();
    let error =
        StaticTree::read(&path, &PackageRoots::new(), Path::new(".")).unwrap_err().to_string();
    assert!(error.contains("not plain XML"), "{error}");
    let nowhere = SavedCalibration::read(Path::new("no/such.json")).unwrap_err().to_string();
    assert!(nowhere.contains("no/such.json") && nowhere.contains("Check"), "{nowhere}");
}

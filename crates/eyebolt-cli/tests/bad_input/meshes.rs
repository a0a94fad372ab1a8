//! Meshes that are not there, not allowed, or too much.

use crate::desk::text;
use crate::folder::Recorded;
use crate::outcome::{assert_not_calibrated, assert_unusable};
use crate::run::eyebolt;
use std::fs::File;
use std::io::Write;
use std::path::Path;

/// A recording whose hand is a mesh at `url`.
fn with_mesh(url: &str) -> Recorded {
    let recorded = Recorded::two();
    let mesh = format!("<mesh filename=\"{url}\"/>");
    recorded.replace("arm.urdf", "<cylinder radius=\"0.04\" length=\"0.03\"/>", &mesh);
    recorded
}

#[test]
fn a_mesh_that_is_not_there() {
    for (url, remedy) in [
        ("package://arm/meshes/hand.stl", "--package-path arm=FOLDER"),
        ("hand.stl", "put the file there"),
        ("file:///no/such/hand.stl", "correct the path"),
    ] {
        let recorded = with_mesh(url);
        let words = ["arm.urdf, link `hand`", url, "not found", remedy];
        assert_not_calibrated(recorded.path(), &[], &words);
        // Whoever looks at a recording needs no shapes, but is told.
        let info = eyebolt(&["info", text(recorded.path())]);
        assert_eq!((info.code, info.err.as_str()), (Some(3), ""));
        assert!(words.iter().all(|word| info.out.contains(word)), "{}", info.out);
    }
}

#[test]
fn a_mesh_outside_its_package() {
    for url in ["package://arm/../../../etc/hand.stl", "package://../../etc/hand.stl"] {
        let recorded = with_mesh(url);
        assert_unusable(recorded.path(), &["arm.urdf, link `hand`", url, "write package://NAME"]);
    }
}

/// Binary STL of `claimed` triangles and as many bytes as `written` have. Only the header is on the
/// disk: the file system makes zeros of the rest.
fn write_stl(path: &Path, claimed: u32, written: u64) {
    let mut file = File::create(path).unwrap();
    file.write_all(&[0; 80]).unwrap();
    file.write_all(&claimed.to_le_bytes()).unwrap();
    file.set_len(84 + 50 * written).unwrap();
}

#[test]
fn a_mesh_of_ten_million_triangles() {
    let recorded = with_mesh("hand.stl");
    write_stl(&recorded.path().join("hand.stl"), 10_000_000, 10_000_000);
    let words = ["link hand", "hand.stl", "more than 5000000 triangles", "decimate the mesh"];
    assert_not_calibrated(recorded.path(), &[], &words);
}

#[test]
fn a_mesh_that_claims_more_triangles_than_it_has() {
    for claimed in [10_000_000, u32::MAX] {
        let recorded = with_mesh("hand.stl");
        write_stl(&recorded.path().join("hand.stl"), claimed, 12);
        let number = claimed.to_string();
        let words = ["link hand", "hand.stl: triangle count", &number, "export the mesh again"];
        assert_not_calibrated(recorded.path(), &[], &words);
    }
}

#[test]
fn a_mesh_of_many_gigabytes() {
    let recorded = with_mesh("hand.stl");
    write_stl(&recorded.path().join("hand.stl"), u32::MAX, u64::from(u32::MAX));
    let words = ["link hand", "hand.stl", "a mesh file may have", "decimate the mesh"];
    assert_not_calibrated(recorded.path(), &[], &words);
}

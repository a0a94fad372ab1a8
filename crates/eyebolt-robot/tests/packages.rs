//! Where mesh URLs lead.
#![allow(clippy::unwrap_used)]

use eyebolt_robot::{Input, PackageRoots, ResolveError, Robot, RobotError, Shape};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes an empty file and the folders above it.
fn touch(path: PathBuf) -> PathBuf {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, "").unwrap();
    path
}

const URL: &str = "package://arm_description/meshes/a.stl";

#[test]
fn a_package_is_found_in_every_kind_of_root() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let file = touch(root.join("src/arm_description/meshes/a.stl"));
    let ament = touch(root.join("install/share/arm_description/meshes/a.stl"));
    let text = |path: &str| root.join(path).display().to_string();
    let found = |roots: PackageRoots| roots.resolve(URL, None).unwrap();
    assert_eq!(found(PackageRoots::new().with_directory(root.join("src"))), file);
    assert_eq!(found(PackageRoots::new().with_directory(root.join("src/arm_description"))), file);
    let named = format!("arm_description={}", text("src/arm_description"));
    assert_eq!(found(PackageRoots::new().with_argument(&named)), file);
    assert_eq!(found(PackageRoots::new().with_argument(&text("src"))), file);
    let ros = std::env::join_paths([text("nowhere"), text("src")]).unwrap();
    assert_eq!(found(PackageRoots::from_environment(ros.to_str(), None)), file);
    let prefix = text("install");
    let environment = PackageRoots::from_environment(Some(""), Some(&prefix));
    assert_eq!(found(environment.clone()), ament);
    assert_eq!(found(PackageRoots::new().with_argument(&named).then(environment)), file);
    // Above the URDF, without any root.
    let urdf_folder = root.join("src/arm_description/urdf/deep");
    assert_eq!(PackageRoots::new().resolve(URL, Some(&urdf_folder)).unwrap(), file);
}

#[test]
fn file_urls_and_paths() {
    let folder = tempfile::tempdir().unwrap();
    let file = touch(folder.path().join("meshes/a b.stl"));
    let roots = PackageRoots::new();
    let url = format!("file://{}", file.display()).replace(' ', "%20");
    let elsewhere = Some(Path::new("/nowhere"));
    assert_eq!(roots.resolve(&url, elsewhere).unwrap(), file);
    assert_eq!(roots.resolve(file.to_str().unwrap(), elsewhere).unwrap(), file);
    assert!(roots.resolve("../meshes/a b.stl", Some(&folder.path().join("meshes"))).is_ok());
    let error = roots.resolve("meshes/a b.stl", None).unwrap_err();
    assert!(error.to_string().contains("without a folder"), "{error}");
    for url in [
        "http://example.org/a.stl",
        "package://",
        "package://arm",
        "package:///a.stl",
        "",
        "file:///a%zz",
    ] {
        let error = roots.resolve(url, Some(Path::new("."))).unwrap_err();
        assert!(matches!(error, ResolveError::Unsupported { .. }), "{url}: {error}");
    }
}

#[test]
fn a_description_without_a_folder_finds_its_meshes_in_those_given() {
    let folder = tempfile::tempdir().unwrap();
    let file = touch(folder.path().join("meshes/a.stl"));
    let roots = PackageRoots::new().with_argument(folder.path().to_str().unwrap());
    assert_eq!(roots.resolve("meshes/a.stl", None).unwrap(), file);
    // A copy of the URDF elsewhere, too.
    assert_eq!(roots.resolve("meshes/a.stl", Some(Path::new("/nowhere"))).unwrap(), file);
    let inner = PackageRoots::new().with_directory(folder.path().join("meshes"));
    let error = inner.resolve("../meshes/a.stl", None).unwrap_err();
    assert!(matches!(error, ResolveError::Escapes { .. }), "{error}");
    let error = roots.resolve("meshes/b.stl", None).unwrap_err();
    assert_eq!(error.input(), Some(Input::PACKAGE_PATH));
    let text = error.to_string();
    assert!(text.contains("`package_path`") && text.contains("`robot`"), "{text}");
}

#[test]
fn paths_stay_in_their_package() {
    let folder = tempfile::tempdir().unwrap();
    touch(folder.path().join("secret.stl"));
    touch(folder.path().join("arm_description/a.stl"));
    let roots = PackageRoots::new().with_directory(folder.path());
    for path in [
        "../secret.stl",
        "arm_description/../secret.stl",
        "arm_description/x/../../secret.stl",
        "arm_description//secret.stl",
    ] {
        let error = roots.resolve(&format!("package://{path}"), None).unwrap_err();
        assert!(matches!(error, ResolveError::Escapes { .. }), "{path}: {error}");
        assert!(error.to_string().contains("without leaving"));
    }
    assert!(roots.resolve("package://arm_description/meshes/../a.stl", None).is_err());
    fs::create_dir(folder.path().join("arm_description/meshes")).unwrap();
    assert!(roots.resolve("package://arm_description/meshes/../a.stl", None).is_ok());
}

#[test]
fn what_is_not_found_lists_places_and_the_input() {
    let urdf = format!(
        r#"<robot><link name="hand"><visual><geometry><mesh filename="{URL}"/></geometry></visual></link></robot>"#
    );
    let roots = PackageRoots::from_environment(Some("/nowhere/src"), Some("/nowhere/install"));
    let error = Robot::from_urdf_str(&urdf, None, &roots).unwrap_err();
    let text = error.to_string();
    for word in [
        "robot description, link `hand`",
        URL,
        "/nowhere/src/arm_description/meshes/a.stl",
        "/nowhere/install/share/arm_description/meshes/a.stl",
        "`package_path` arm_description=FOLDER",
    ] {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
    assert!(matches!(error, RobotError::Mesh { .. }));
    assert_eq!(error.input(), Some(Input::PACKAGE_PATH));
}

#[test]
fn reading_a_urdf_reads_no_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = touch(folder.path().join("broken.stl"));
    let urdf = r#"<robot><link name="a"><visual><geometry>
        <mesh filename="broken.stl" scale="0.001 0.001 -0.001"/></geometry></visual></link></robot>"#;
    let path = folder.path().join("arm.urdf");
    fs::write(&path, urdf).unwrap();
    let robot = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap();
    let expected = Shape::Mesh { path: mesh, scale: [0.001, 0.001, -0.001] };
    assert_eq!(robot.links[0].visuals[0].shape, expected);
}

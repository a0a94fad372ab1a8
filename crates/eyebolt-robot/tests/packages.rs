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
        r#"<robot><link name="hand"><visual><geometry><mesh filename="{URL}"/></geometry></visual></link>
        <link name="tip"/><joint name="j" type="continuous"><parent link="hand"/><child link="tip"/></joint></robot>"#
    );
    let roots = PackageRoots::from_environment(Some("/nowhere/src"), Some("/nowhere/install"));
    let arm = Robot::from_urdf_str(&urdf, None, &roots).and_then(|robot| robot.arm(None, None));
    let error = arm.unwrap_err();
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

/// What `xacro` wrote on another machine: the package is the folder below `share`, or one that is
/// given by its name.
#[test]
fn absolute_paths_of_another_machine_are_looked_up_as_packages() {
    let folder = tempfile::tempdir().unwrap();
    let file = touch(folder.path().join("src/arm_description/meshes/a.stl"));
    let search = PackageRoots::new().with_directory(folder.path().join("src"));
    let named = PackageRoots::new()
        .with_package("arm_description", folder.path().join("src/arm_description"));
    let prefix = touch(folder.path().join("install/share/arm_description/meshes/a.stl"));
    let install = folder.path().join("install").display().to_string();
    let ament = PackageRoots::from_environment(None, Some(&install));
    let installed = "/opt/ros/nowhere/share/arm_description/meshes/a.stl";
    for directory in [None, Some(Path::new("/nowhere"))] {
        for url in [installed.to_owned(), format!("file://{installed}")] {
            assert_eq!(search.resolve(&url, directory).unwrap(), file);
            assert_eq!(named.resolve(&url, directory).unwrap(), file);
            assert_eq!(ament.resolve(&url, directory).unwrap(), prefix);
            let error = PackageRoots::new().resolve(&url, directory).unwrap_err();
            assert_eq!(error.input(), Some(Input::PACKAGE_PATH));
            let text = error.to_string();
            assert!(text.contains("`package_path` arm_description=FOLDER"), "{text}");
        }
        // In a workspace that was never installed, the name that is given tells.
        let source = "file:///home/someone/ws/src/arm_description/meshes/a.stl";
        assert_eq!(named.resolve(source, directory).unwrap(), file);
        // Nothing is left by climbing.
        let climbing = "file:///x/share/arm_description/../../../secret.stl";
        assert!(search.resolve(climbing, directory).is_err());
    }
}

#[test]
fn a_path_that_climbs_is_looked_for_where_its_rest_begins() {
    let folder = tempfile::tempdir().unwrap();
    let file = touch(folder.path().join("arm_description/meshes/a.stl"));
    let package = folder.path().join("arm_description").display().to_string();
    let roots = PackageRoots::new().with_argument(&package);
    for directory in [None, Some(Path::new("/nowhere/urdf/robots"))] {
        assert_eq!(roots.resolve("../../meshes/a.stl", directory).unwrap(), file);
        let error = PackageRoots::new().resolve("../../meshes/a.stl", directory).unwrap_err();
        assert_eq!(error.input(), Some(Input::PACKAGE_PATH));
        let text = error.to_string();
        assert!(text.contains("`package_path`") && text.contains("`robot`"), "{text}");
        assert!(!text.contains("package://NAME"), "{text}");
    }
}

#[test]
fn without_any_folder_that_is_said_in_a_sentence() {
    let error = PackageRoots::new().resolve(URL, None).unwrap_err().to_string();
    let words = "not found: no folder of packages is known; give the folder with";
    assert!(error.contains(words), "{error}");
}

#[test]
fn descriptions_that_are_installed_are_found_by_the_robots_name() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let own = touch(root.join("install/share/lifter_description/urdf/lifter.urdf.xacro"));
    let plain = touch(root.join("install/share/lifter_description/urdf/lifter.urdf"));
    let among = touch(root.join("src/zoo_description/robots/crane.urdf"));
    let prefix = root.join("install").display().to_string();
    let source = root.join("src").display().to_string();
    let roots = PackageRoots::from_environment(Some(&source), Some(&prefix));
    assert_eq!(roots.descriptions("lifter"), [plain, own]);
    assert_eq!(roots.descriptions("crane"), std::slice::from_ref(&among));
    let package = PackageRoots::new().with_directory(root.join("src/zoo_description"));
    assert_eq!(package.descriptions("crane"), [among]);
    for nothing in ["", "..", "../zoo", "zoo_description/robots/crane", "nobody"] {
        assert!(roots.descriptions(nothing).is_empty(), "{nothing}");
    }
}

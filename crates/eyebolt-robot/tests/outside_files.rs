//! Which files a description that came with a recording may name.
#![allow(clippy::unwrap_used)]

use eyebolt_robot::{Arm, Input, PackageRoots, ResolveError, Robot, RobotError, Shape};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder with a package `arm` among others in `src`, and a file that belongs to none.
struct Disk {
    folder: tempfile::TempDir,
    mesh: PathBuf,
    secret: PathBuf,
}

impl Disk {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        // Folders for temporary files are symbolic links on some systems.
        let root = folder.path().canonicalize().unwrap();
        let (mesh, secret) = (root.join("src/arm/meshes/a.stl"), root.join("secret.stl"));
        fs::create_dir_all(mesh.parent().unwrap()).unwrap();
        fs::write(&mesh, "").unwrap();
        fs::write(&secret, "").unwrap();
        Self { folder, mesh, secret }
    }

    fn source(&self) -> PathBuf {
        self.folder.path().join("src")
    }

    fn roots(&self) -> PackageRoots {
        PackageRoots::new().with_directory(self.source())
    }

    /// URLs of files outside the package folder.
    fn outside(&self) -> [String; 4] {
        let climbing = self.source().join("arm/../../secret.stl");
        [
            format!("file://{}", self.secret.display()),
            format!("file://localhost{}", self.secret.display()),
            self.secret.display().to_string(),
            format!("file://{}", climbing.display()),
        ]
    }
}

fn urdf(url: &str) -> String {
    format!(
        r#"<robot><link name="hand"><visual><geometry><mesh filename="{url}"/></geometry></visual></link>
        <link name="tip"/><joint name="j" type="continuous"><parent link="hand"/><child link="tip"/></joint></robot>"#
    )
}

/// The arm of a description that came with a recording.
fn arm(url: &str, roots: &PackageRoots) -> Result<Arm, RobotError> {
    Robot::from_urdf_str(&urdf(url), None, roots)?.arm(None, None)
}

fn mesh_of(robot: &Robot) -> &Path {
    match &robot.links[0].visuals[0].shape {
        Shape::Mesh { path, .. } => path,
        other => panic!("{other:?} is no mesh"),
    }
}

#[test]
fn a_recording_names_no_file_outside_the_package_folders() {
    let disk = Disk::new();
    for url in disk.outside() {
        for roots in [PackageRoots::new(), disk.roots()] {
            let error = arm(&url, &roots).unwrap_err();
            assert_eq!(error.input(), Some(Input::PACKAGE_PATH), "{url}: {error}");
            let text = error.to_string();
            let secret = disk.secret.display().to_string();
            for word in ["`hand`", &url, &secret, "`package_path`", "`robot`", "`outside_files`"] {
                assert!(text.contains(word), "`{word}` is not in: {text}");
            }
            let RobotError::Mesh { source: ResolveError::Outside { path, .. }, .. } = error else {
                panic!("{url}: {error}");
            };
            assert_eq!(path, disk.secret);
        }
    }
}

#[test]
fn packages_are_not_left_by_climbing() {
    let disk = Disk::new();
    for url in ["package://arm/../../secret.stl", "package://../secret.stl", "../secret.stl"] {
        let error = disk.roots().resolve(url, None).unwrap_err();
        assert!(matches!(error, ResolveError::Escapes { .. }), "{url}: {error}");
        let free = disk.roots().with_outside_files(true).resolve(url, None).unwrap_err();
        assert_eq!(free, error);
    }
}

/// A link inside a package does not make what it points at part of the package.
#[cfg(unix)]
#[test]
fn symbolic_links_lead_nowhere_else() {
    let disk = Disk::new();
    let file = disk.source().join("arm/meshes/link.stl");
    std::os::unix::fs::symlink(&disk.secret, &file).unwrap();
    let folder = disk.source().join("arm/up");
    std::os::unix::fs::symlink(disk.folder.path(), folder).unwrap();
    let same = disk.source().join("arm/same.stl");
    std::os::unix::fs::symlink(&disk.mesh, same).unwrap();
    for url in
        ["package://arm/meshes/link.stl", "arm/meshes/link.stl", "package://arm/up/secret.stl"]
    {
        let error = disk.roots().resolve(url, None).unwrap_err();
        let expected = ResolveError::Outside { url: url.to_owned(), path: disk.secret.clone() };
        assert_eq!(error, expected);
        let free = disk.roots().with_outside_files(true);
        assert!(free.resolve(url, None).is_ok(), "{url}");
        // Of a URDF that the user named, as ever.
        assert!(disk.roots().resolve(url, Some(Path::new("/nowhere"))).is_ok(), "{url}");
    }
    assert_eq!(disk.roots().resolve("package://arm/same.stl", None), Ok(disk.mesh.clone()));
    // Where the link leads is a package folder too.
    let both = disk.roots().with_directory(disk.folder.path());
    assert_eq!(both.resolve("package://arm/meshes/link.stl", None), Ok(disk.secret));
}

#[test]
fn files_inside_are_found_by_any_url() {
    let disk = Disk::new();
    let path = disk.mesh.display().to_string();
    let climbing = disk.source().join("other/../arm/meshes/a.stl");
    fs::create_dir(disk.source().join("other")).unwrap();
    for url in [
        format!("file://{path}"),
        format!("file://{}", climbing.display()),
        path,
        "package://arm/meshes/a.stl".to_owned(),
        "arm/meshes/a.stl".to_owned(),
    ] {
        let robot = Robot::from_urdf_str(&urdf(&url), None, &disk.roots()).unwrap();
        assert_eq!(mesh_of(&robot), disk.mesh, "{url}");
    }
}

/// Installed packages lie in `share` of a prefix; what else is there is none.
#[test]
fn a_prefix_holds_packages_in_share() {
    let disk = Disk::new();
    let prefix = disk.folder.path().canonicalize().unwrap().join("install");
    let installed = prefix.join("share/arm/a.stl");
    fs::create_dir_all(installed.parent().unwrap()).unwrap();
    fs::write(&installed, "").unwrap();
    fs::write(prefix.join("b.stl"), "").unwrap();
    let roots = PackageRoots::from_environment(None, prefix.to_str());
    let url = format!("file://{}", installed.display());
    assert_eq!(roots.resolve(&url, None), Ok(installed));
    let error = roots.resolve(&format!("file://{}/b.stl", prefix.display()), None).unwrap_err();
    assert!(matches!(error, ResolveError::Outside { .. }), "{error}");
}

#[test]
fn files_outside_are_read_where_that_is_allowed() {
    let disk = Disk::new();
    let allowed = PackageRoots::new().with_outside_files(true);
    // Also by roots that others follow.
    let followed = PackageRoots::new().then(allowed.clone());
    for url in disk.outside() {
        for roots in [&allowed, &followed] {
            let robot = Robot::from_urdf_str(&urdf(&url), None, roots).unwrap();
            assert_eq!(mesh_of(&robot).canonicalize().unwrap(), disk.secret, "{url}");
        }
        let forbidden = allowed.clone().with_outside_files(false);
        assert!(arm(&url, &forbidden).is_err());
    }
}

#[test]
fn a_urdf_that_the_user_named_names_any_file() {
    let disk = Disk::new();
    let path = disk.folder.path().join("arm.urdf");
    for url in disk.outside() {
        fs::write(&path, urdf(&url)).unwrap();
        let robot = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap();
        assert_eq!(mesh_of(&robot).canonicalize().unwrap(), disk.secret, "{url}");
    }
}

#[test]
fn what_a_recording_names_elsewhere_is_looked_for_there() {
    let url = "file:///nowhere/meshes/a.stl";
    let error = PackageRoots::new().resolve(url, None).unwrap_err();
    assert!(matches!(error, ResolveError::NotFound { .. }), "{error}");
    assert_eq!(error.input(), Some(Input::ROBOT));
    assert!(error.to_string().contains("`robot`"), "{error}");
}

//! Robot descriptions that are installed for ROS, by the robot's name.

use crate::packages::PackageRoots;
use std::path::{Path, PathBuf};

/// What files of descriptions are called, after the robot's name.
const ENDINGS: [&str; 4] = [".urdf", ".urdf.xacro", "_robot.urdf.xacro", ".xacro"];
/// Where in a package they lie.
const FOLDERS: [&str; 5] = ["urdf", "robots", "robot", "xacro", ""];
/// How packages that hold descriptions end.
const PACKAGES: [&str; 4] = ["_description", "_support", "_descriptions", ""];

impl PackageRoots {
    /// Files that describe robot `name`, the likeliest first: in its own package (`NAME_description`,
    /// `NAME_support` or `NAME`), then in packages of descriptions of several robots.
    pub fn descriptions(&self, name: &str) -> Vec<PathBuf> {
        let is_name = !name.is_empty()
            && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'))
            && !name.starts_with('.');
        if !is_name {
            return Vec::new();
        }
        let own = PACKAGES.iter().flat_map(|ending| {
            let package = format!("{name}{ending}");
            self.roots_of(&package, None).collect::<Vec<_>>()
        });
        let mut folders: Vec<PathBuf> = own.collect();
        folders.extend(self.description_packages());
        let mut found: Vec<PathBuf> = Vec::new();
        for folder in folders {
            for file in files_in(&folder, name).filter(|file| file.is_file()) {
                if !found.contains(&file) {
                    found.push(file);
                }
            }
        }
        found
    }

    /// All folders that are called as packages of descriptions are, in the order of their names.
    fn description_packages(&self) -> Vec<PathBuf> {
        let shares = self.ament.iter().map(|prefix| prefix.join("share"));
        let roots = self.search.iter().cloned().chain(shares);
        let mut all = Vec::new();
        for root in roots {
            let entries = std::fs::read_dir(&root).into_iter().flatten().flatten();
            let mut inside: Vec<PathBuf> = entries
                .map(|entry| entry.path())
                .chain([root.clone()])
                .filter(|path| {
                    let name = path.file_name().unwrap_or_default().to_string_lossy();
                    let mut endings = PACKAGES.iter().filter(|ending| !ending.is_empty());
                    endings.any(|ending| name.ends_with(ending))
                })
                .collect();
            inside.sort();
            all.extend(inside);
        }
        all.extend(self.named.iter().map(|(_, folder)| folder.clone()));
        all
    }
}

fn files_in<'f>(folder: &'f Path, name: &'f str) -> impl Iterator<Item = PathBuf> + 'f {
    FOLDERS.iter().flat_map(move |inner| {
        ENDINGS.iter().map(move |ending| folder.join(inner).join(format!("{name}{ending}")))
    })
}

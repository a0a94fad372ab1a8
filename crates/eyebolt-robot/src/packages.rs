//! Where mesh URLs of a URDF lead.

mod error;
mod path;
mod places;
mod remedy;

pub use error::ResolveError;
pub use remedy::Remedy;

pub(crate) use path::{percent_decoded, stays_inside};

use path::{climbed, is_called, packages_in};
use places::Places;
use std::path::{Path, PathBuf};

/// Folders in which `package://name/...` is looked up, in this order: packages given by name,
/// search folders, ament prefixes, then the folders above the URDF that are called `name`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PackageRoots {
    pub(crate) named: Vec<(String, PathBuf)>,
    pub(crate) search: Vec<PathBuf>,
    pub(crate) ament: Vec<PathBuf>,
    /// Whether a description that came with a recording may name files elsewhere.
    outside_files: bool,
}

impl PackageRoots {
    /// No roots: only relative paths, `file://` and packages above the URDF are found, and nothing
    /// that a recording's description names.
    pub fn new() -> Self {
        Self::default()
    }

    /// Roots from the values of `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`.
    pub fn from_environment(
        ros_package_path: Option<&str>,
        ament_prefix_path: Option<&str>,
    ) -> Self {
        let split = |value: Option<&str>| {
            std::env::split_paths(value.unwrap_or_default())
                .filter(|path| !path.as_os_str().is_empty())
                .collect::<Vec<_>>()
        };
        Self { search: split(ros_package_path), ament: split(ament_prefix_path), ..Self::default() }
    }

    /// Adds package `name`, whose files lie in `directory`.
    #[must_use]
    pub fn with_package(mut self, name: impl Into<String>, directory: impl Into<PathBuf>) -> Self {
        self.named.push((name.into(), directory.into()));
        self
    }

    /// Adds a folder that holds packages, or is one.
    #[must_use]
    pub fn with_directory(mut self, directory: impl Into<PathBuf>) -> Self {
        self.search.push(directory.into());
        self
    }

    /// Adds `NAME=FOLDER` or `FOLDER`, as [`Input::PACKAGE_PATH`](crate::Input::PACKAGE_PATH) has it.
    #[must_use]
    pub fn with_argument(self, argument: &str) -> Self {
        match argument.split_once('=') {
            Some((name, directory)) if !name.is_empty() && !name.contains('/') => {
                self.with_package(name, directory)
            }
            _ => self.with_directory(argument),
        }
    }

    /// These roots first, then `other`'s. Files outside are allowed where either allows them.
    #[must_use]
    pub fn then(mut self, other: Self) -> Self {
        self.named.extend(other.named);
        self.search.extend(other.search);
        self.ament.extend(other.ament);
        self.outside_files |= other.outside_files;
        self
    }

    /// Whether a description that came with a recording may name files outside these folders. It may
    /// not, unless this says so: whoever made the recording could otherwise have any file of this
    /// machine read.
    #[must_use]
    pub fn with_outside_files(mut self, allowed: bool) -> Self {
        self.outside_files = allowed;
        self
    }

    /// The file that `url` means: `package://`, `model://`, `file://`, or a path, which is relative
    /// to `directory`, the folder of the URDF, or to a folder given. The file exists; nothing of it is read.
    ///
    /// Without a `directory` the description came with a recording: unless
    /// [`Self::with_outside_files`] allows others, the file lies inside one of the folders, `..` and
    /// symbolic links resolved.
    ///
    /// # Errors
    /// See [`ResolveError`].
    pub fn resolve(&self, url: &str, directory: Option<&Path>) -> Result<PathBuf, ResolveError> {
        let places = self.places(url, directory)?;
        if directory.is_some() || self.outside_files {
            return places.first(url);
        }
        // Of a prefix, only what holds packages.
        let shares: Vec<PathBuf> = self.ament.iter().map(|prefix| prefix.join("share")).collect();
        let named = self.named.iter().map(|(_, directory)| directory);
        places.first_inside(url, named.chain(&self.search).chain(&shares).map(PathBuf::as_path))
    }

    /// The folder of package `name`, if it is there; `directory` as for [`Self::resolve`].
    pub(crate) fn package(&self, name: &str, directory: Option<&Path>) -> Option<String> {
        if name.is_empty() || name.contains(['/', '\\']) || name.starts_with('.') {
            return None;
        }
        let found = self.roots_of(name, directory).find(|root| root.is_dir())?;
        // Whoever includes a file of it does so from another folder.
        let found = std::path::absolute(&found).unwrap_or(found);
        Some(found.display().to_string())
    }

    fn places(&self, url: &str, directory: Option<&Path>) -> Result<Places, ResolveError> {
        let unsupported = |problem| ResolveError::Unsupported { url: url.to_owned(), problem };
        if url.trim().is_empty() {
            return Err(unsupported("no file name"));
        }
        match url.split_once("://") {
            Some(("package" | "model", path)) => self.package_places(url, path, directory),
            Some(("file", path)) => {
                let path = percent_decoded(path.strip_prefix("localhost/").unwrap_or(path))
                    .ok_or_else(|| unsupported("bad %-escape"))?;
                let path = Path::new("/").join(path.trim_start_matches('/'));
                Ok(self.of_other_machine(absolute(path, directory), directory))
            }
            Some(_) => Err(unsupported("only package://, model:// and file:// are read")),
            None if Path::new(url).is_absolute() => {
                let places = absolute(PathBuf::from(url), directory);
                Ok(self.of_other_machine(places, directory))
            }
            None => self.path_places(url, directory),
        }
    }

    /// With the places of the package that an absolute path lies in on the machine that it was made
    /// on: the folder below `share`, or one that is given by name.
    fn of_other_machine(&self, mut places: Places, directory: Option<&Path>) -> Places {
        let Some(path) = places.paths.first().cloned() else { return places };
        for (installed, name, rest) in packages_in(&path) {
            if installed {
                places.paths.extend(self.roots_of(&name, directory).map(|root| root.join(&rest)));
                places.remedy = Remedy::GivePackage(name);
            } else {
                let given = self.named.iter().filter(|(given, _)| *given == name);
                places.paths.extend(given.map(|(_, directory)| directory.join(&rest)));
            }
        }
        places
    }

    /// A relative path: from the folder of the URDF, else from the folders given, where a description
    /// from a topic or a copied one has its meshes.
    fn path_places(&self, url: &str, directory: Option<&Path>) -> Result<Places, ResolveError> {
        let mut paths: Vec<PathBuf> = directory.map(|d| d.join(url)).into_iter().collect();
        let remedy = match climbed(url) {
            0 if directory.is_some() => Remedy::GiveFolder,
            0 => Remedy::GiveFolderOrUrdf,
            _ => Remedy::GiveFolderAbove,
        };
        // Of `../../meshes`, what is left where a package's own folder is given.
        let inside = path::without_climbing(url);
        if stays_inside(&inside) {
            let named = self.named.iter().map(|(_, directory)| directory);
            paths.extend(named.chain(&self.search).map(|root| root.join(&inside)));
        }
        if directory.is_none() && !paths.iter().any(|path| path.is_file()) && !stays_inside(url) {
            return Err(ResolveError::Escapes { url: url.to_owned(), remedy });
        }
        Ok(Places { paths, remedy })
    }

    fn package_places(
        &self,
        url: &str,
        path: &str,
        directory: Option<&Path>,
    ) -> Result<Places, ResolveError> {
        let (name, rest) = path.split_once('/').unwrap_or((path, ""));
        if name == ".." || !stays_inside(rest) {
            let remedy = Remedy::StayInside;
            return Err(ResolveError::Escapes { url: url.to_owned(), remedy });
        }
        if matches!(name, "" | ".") || rest.is_empty() {
            let problem = "a package and a path in it are needed";
            return Err(ResolveError::Unsupported { url: url.to_owned(), problem });
        }
        let mut paths: Vec<PathBuf> = Vec::new();
        for place in self.roots_of(name, directory).map(|root| root.join(rest)) {
            if !paths.contains(&place) {
                paths.push(place);
            }
        }
        Ok(Places { paths, remedy: Remedy::GivePackage(name.to_owned()) })
    }

    /// Where package `name` may lie.
    pub(crate) fn roots_of(
        &self,
        name: &str,
        directory: Option<&Path>,
    ) -> impl Iterator<Item = PathBuf> {
        let mut roots: Vec<PathBuf> = Vec::new();
        let given = self.named.iter().filter(|(given, _)| given == name);
        roots.extend(given.map(|(_, directory)| directory.clone()));
        for root in &self.search {
            roots.push(root.join(name));
            roots.extend(is_called(root, name).then(|| root.clone()));
        }
        roots.extend(self.ament.iter().map(|prefix| prefix.join("share").join(name)));
        for above in directory.into_iter().flat_map(Path::ancestors) {
            roots.extend(is_called(above, name).then(|| above.to_owned()));
            roots.push(above.join(name));
        }
        roots.into_iter()
    }
}

/// The one place of an absolute path.
fn absolute(path: PathBuf, directory: Option<&Path>) -> Places {
    let remedy = match directory {
        Some(_) => Remedy::CorrectPath,
        None => Remedy::GiveCorrected,
    };
    Places { paths: vec![path], remedy }
}

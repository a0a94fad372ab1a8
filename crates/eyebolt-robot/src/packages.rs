//! Where mesh URLs of a URDF lead.

mod error;
mod path;
mod places;
mod remedy;

pub use error::ResolveError;
pub use remedy::Remedy;

use path::{is_called, percent_decoded, stays_inside};
use places::Places;
use std::path::{Path, PathBuf};

/// Folders in which `package://name/...` is looked up, in this order: packages given by name,
/// search folders, ament prefixes, then the folders above the URDF that are called `name`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PackageRoots {
    named: Vec<(String, PathBuf)>,
    search: Vec<PathBuf>,
    ament: Vec<PathBuf>,
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
                Ok(absolute(path, directory))
            }
            Some(_) => Err(unsupported("only package://, model:// and file:// are read")),
            None if Path::new(url).is_absolute() => Ok(absolute(PathBuf::from(url), directory)),
            None => self.path_places(url, directory),
        }
    }

    /// A relative path: from the folder of the URDF, else from the folders given, where a description
    /// from a topic or a copied one has its meshes.
    fn path_places(&self, url: &str, directory: Option<&Path>) -> Result<Places, ResolveError> {
        let mut paths: Vec<PathBuf> = directory.map(|d| d.join(url)).into_iter().collect();
        if stays_inside(url) {
            let named = self.named.iter().map(|(_, directory)| directory);
            paths.extend(named.chain(&self.search).map(|root| root.join(url)));
        } else if directory.is_none() {
            return Err(ResolveError::Escapes { url: url.to_owned() });
        }
        let remedy = match directory {
            Some(_) => Remedy::GiveFolder,
            None => Remedy::GiveFolderOrUrdf,
        };
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
            return Err(ResolveError::Escapes { url: url.to_owned() });
        }
        if matches!(name, "" | ".") || rest.is_empty() {
            let problem = "a package and a path in it are needed";
            return Err(ResolveError::Unsupported { url: url.to_owned(), problem });
        }
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
        let paths = roots.into_iter().map(|root| root.join(rest)).collect();
        Ok(Places { paths, remedy: Remedy::GivePackage(name.to_owned()) })
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

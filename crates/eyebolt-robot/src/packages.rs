//! Where mesh URLs of a URDF lead.

use std::path::{Component, Path, PathBuf};

/// Folders in which `package://name/...` is looked up, in this order: packages given by name,
/// search folders, ament prefixes, then the folders above the URDF that are called `name`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PackageRoots {
    named: Vec<(String, PathBuf)>,
    search: Vec<PathBuf>,
    ament: Vec<PathBuf>,
}

/// A mesh URL that leads to no file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResolveError {
    /// No such file in any of the places.
    #[error("mesh `{url}` not found; looked for {}; {remedy}", places(looked_at))]
    NotFound {
        /// As the URDF has it.
        url: String,
        /// Every file that was tried.
        looked_at: Vec<PathBuf>,
        /// What to do.
        remedy: String,
    },
    /// The path leaves its package.
    #[error(
        "mesh `{url}` leaves its package by `..`; write package://NAME/path without leaving NAME"
    )]
    Escapes {
        /// As the URDF has it.
        url: String,
    },
    /// Not a URL that names a file of this machine.
    #[error(
        "mesh `{url}`: {problem}; write package://NAME/path, file:///path or a path relative to the URDF"
    )]
    Unsupported {
        /// As the URDF has it.
        url: String,
        /// What is wrong.
        problem: &'static str,
    },
}

fn places(paths: &[PathBuf]) -> String {
    if paths.is_empty() {
        return "it nowhere: no folders are known".to_owned();
    }
    paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
}

impl PackageRoots {
    /// No roots: only relative paths, `file://` and packages above the URDF are found.
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
        Self { named: Vec::new(), search: split(ros_package_path), ament: split(ament_prefix_path) }
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

    /// Adds `NAME=FOLDER` or `FOLDER`, as the option `--package-path` has it.
    #[must_use]
    pub fn with_argument(self, argument: &str) -> Self {
        match argument.split_once('=') {
            Some((name, directory)) if !name.is_empty() && !name.contains('/') => {
                self.with_package(name, directory)
            }
            _ => self.with_directory(argument),
        }
    }

    /// These roots first, then `other`'s.
    #[must_use]
    pub fn then(mut self, other: Self) -> Self {
        self.named.extend(other.named);
        self.search.extend(other.search);
        self.ament.extend(other.ament);
        self
    }

    /// The file that `url` means: `package://`, `model://`, `file://`, or a path, which is relative
    /// to `directory`, the folder of the URDF, or to a folder given. The file exists; nothing of it is read.
    ///
    /// # Errors
    /// See [`ResolveError`].
    pub fn resolve(&self, url: &str, directory: Option<&Path>) -> Result<PathBuf, ResolveError> {
        let unsupported = |problem| ResolveError::Unsupported { url: url.to_owned(), problem };
        if url.trim().is_empty() {
            return Err(unsupported("no file name"));
        }
        match url.split_once("://") {
            Some(("package" | "model", path)) => self.resolve_package(url, path, directory),
            Some(("file", path)) => {
                let path = percent_decoded(path.strip_prefix("localhost/").unwrap_or(path))
                    .ok_or_else(|| unsupported("bad %-escape"))?;
                let path = Path::new("/").join(path.trim_start_matches('/'));
                existing(url, vec![path], "correct the path in the URDF")
            }
            Some(_) => Err(unsupported("only package://, model:// and file:// are read")),
            None => self.resolve_path(url, directory),
        }
    }

    /// A path: from the folder of the URDF, else from the folders given, where a description from a
    /// topic or a copied one has its meshes.
    fn resolve_path(&self, url: &str, directory: Option<&Path>) -> Result<PathBuf, ResolveError> {
        if Path::new(url).is_absolute() {
            let remedy = "put the file there or correct the path in the URDF";
            return existing(url, vec![PathBuf::from(url)], remedy);
        }
        let mut places: Vec<PathBuf> = directory.map(|d| d.join(url)).into_iter().collect();
        if stays_inside(url) {
            let named = self.named.iter().map(|(_, directory)| directory);
            places.extend(named.chain(&self.search).map(|root| root.join(url)));
        } else if directory.is_none() {
            return Err(ResolveError::Escapes { url: url.to_owned() });
        }
        let remedy = match directory {
            Some(_) => {
                "put the file there, or give the folder that this path starts in with \
                        --package-path FOLDER"
            }
            None => {
                "the description came without a folder: give the one that this path starts in \
                     with --package-path FOLDER, or the URDF as a file with --robot FILE"
            }
        };
        existing(url, places, remedy)
    }

    fn resolve_package(
        &self,
        url: &str,
        path: &str,
        directory: Option<&Path>,
    ) -> Result<PathBuf, ResolveError> {
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
        let places = roots.into_iter().map(|root| root.join(rest)).collect();
        existing(url, places, &format!("give the folder with --package-path {name}=FOLDER"))
    }
}

fn is_called(directory: &Path, name: &str) -> bool {
    directory.file_name().is_some_and(|last| last == name)
}

/// Whether no prefix of the relative path climbs above where it starts.
fn stays_inside(path: &str) -> bool {
    let mut depth = 0_i64;
    Path::new(path).components().all(|component| {
        match component {
            Component::Normal(_) => depth += 1,
            Component::ParentDir => depth -= 1,
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => depth = -1,
        }
        depth >= 0
    })
}

fn existing(url: &str, places: Vec<PathBuf>, remedy: &str) -> Result<PathBuf, ResolveError> {
    match places.iter().find(|place| place.is_file()) {
        Some(found) => Ok(found.clone()),
        None => Err(ResolveError::NotFound {
            url: url.to_owned(),
            looked_at: places,
            remedy: remedy.to_owned(),
        }),
    }
}

fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = text.bytes();
    let mut decoded = Vec::with_capacity(text.len());
    while let Some(byte) = bytes.next() {
        decoded.push(if byte == b'%' {
            let high = char::from(bytes.next()?).to_digit(16)?;
            let low = char::from(bytes.next()?).to_digit(16)?;
            u8::try_from(high * 16 + low).ok()?
        } else {
            byte
        });
    }
    String::from_utf8(decoded).ok()
}

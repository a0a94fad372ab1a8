//! Why a mesh URL leads to no file that may be read.

use super::remedy::Remedy;
use crate::input::Input;
use std::path::PathBuf;

/// A mesh URL that leads to no file, or to none that the description may name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResolveError {
    /// No such file in any of the places.
    #[error("mesh `{url}` not found{}; {remedy}", places(looked_at))]
    NotFound {
        /// As the URDF has it.
        url: String,
        /// Every file that was tried.
        looked_at: Vec<PathBuf>,
        /// What to do.
        remedy: Remedy,
    },
    /// The path leaves its package.
    #[error("mesh `{url}` leaves by `..` the folder that it starts in; {remedy}")]
    Escapes {
        /// As the URDF has it.
        url: String,
        /// What to do.
        remedy: Remedy,
    },
    /// The file is there, but a description that came with a recording may not name it.
    #[error(
        "mesh `{url}` leads to {}, which lies outside the package folders, and the description came \
         with the recording; give the folder of the file with {}, give the URDF as a file with {}, \
         or allow such files with {}",
        path.display(),
        Input::PACKAGE_PATH,
        Input::ROBOT,
        Input::OUTSIDE_FILES
    )]
    Outside {
        /// As the URDF has it.
        url: String,
        /// The file that it means, without `..` and symbolic links.
        path: PathBuf,
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

impl ResolveError {
    /// The input that would help.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::NotFound { remedy, .. } | Self::Escapes { remedy, .. } => remedy.input(),
            Self::Outside { .. } => Some(Input::PACKAGE_PATH),
            Self::Unsupported { .. } => Some(Input::ROBOT),
        }
    }
}

fn places(paths: &[PathBuf]) -> String {
    if paths.is_empty() {
        return ": no folder of packages is known".to_owned();
    }
    let paths: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
    format!("; looked for {}", paths.join(", "))
}

//! What to do about a mesh that was not found.

use crate::input::Input;
use std::fmt;

/// What to do about a mesh that was not found.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Remedy {
    /// Say where this package is.
    GivePackage(String),
    /// Put the file beside the URDF, or say where its path starts.
    GiveFolder,
    /// Say where the path starts, or give the URDF with its folder.
    GiveFolderOrUrdf,
    /// Say what folder the URDF's own lies in, or give the URDF as a file where it belongs.
    GiveFolderAbove,
    /// Write the path so that it stays in its package.
    StayInside,
    /// Correct the path where the URDF lies.
    CorrectPath,
    /// Correct the path in a copy of the URDF, which came with a recording, and give that.
    GiveCorrected,
}

impl Remedy {
    /// The input that it is about.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::GivePackage(_)
            | Self::GiveFolder
            | Self::GiveFolderOrUrdf
            | Self::GiveFolderAbove => Some(Input::PACKAGE_PATH),
            Self::GiveCorrected | Self::StayInside => Some(Input::ROBOT),
            Self::CorrectPath => None,
        }
    }
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (folder, file) = (Input::PACKAGE_PATH, Input::ROBOT);
        match self {
            Self::GivePackage(name) => write!(f, "give the folder with {folder} {name}=FOLDER"),
            Self::GiveFolder => write!(
                f,
                "put the file there, or give the folder that this path starts in with {folder}"
            ),
            Self::GiveFolderOrUrdf => write!(
                f,
                "the description came without a folder: give the one that this path starts in with \
                 {folder}, or the URDF as a file with {file}"
            ),
            Self::GiveFolderAbove => write!(
                f,
                "give the folder that the rest of the path starts in (the package that the URDF is \
                 from) with {folder}, or the URDF with {file} from where it was installed"
            ),
            Self::StayInside => f.write_str("write package://NAME/path without leaving NAME"),
            Self::CorrectPath => f.write_str("put the file there or correct the path in the URDF"),
            Self::GiveCorrected => {
                write!(f, "correct the path in the URDF and give it as a file with {file}")
            }
        }
    }
}

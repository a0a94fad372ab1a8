//! Where the networks of a model are.

use eyebolt_models::{BUILT_IN, BuiltInModel};
use eyebolt_net::models::Model;
use std::borrow::Cow;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Where the networks of a model are: a folder of `eyebolt train`, or within the program.
#[derive(Clone, Debug)]
pub enum ModelFiles {
    /// With a folder for each network, or with the files of one.
    Folder(PathBuf),
    /// One that comes with eyebolt.
    BuiltIn(&'static BuiltInModel),
}

/// Why a network cannot be had.
#[derive(Debug)]
pub enum LoadError {
    /// A file cannot be read.
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: Error,
    },
    /// The files are no network.
    Net(eyebolt_net::Error),
}

/// The description of a network, in its folder.
pub const DESCRIPTION: &str = "model.toml";
/// Its weights.
pub const WEIGHTS: &str = "weights.safetensors";

impl ModelFiles {
    /// The folder at `path` or, where no model is, the one of that name that comes with eyebolt.
    pub fn at(path: PathBuf) -> Self {
        let networks = ["", "segmentation", "end_effector", "rotation", "keypoints"];
        let is_model = networks.iter().any(|name| path.join(name).join(DESCRIPTION).exists());
        match path.to_str().and_then(BuiltInModel::named) {
            Some(built_in) if !is_model => Self::BuiltIn(built_in),
            _ => Self::Folder(path),
        }
    }

    /// The one that comes with eyebolt and knows arms in general, whatever lies in the folder.
    pub fn any_arm() -> Option<Self> {
        BuiltInModel::named("any-arm").map(Self::BuiltIn)
    }

    /// Names of those that come with eyebolt.
    pub fn names() -> [&'static str; BUILT_IN.len()] {
        std::array::from_fn(|index| BUILT_IN[index].name)
    }

    /// Where a network of that name would be, for errors; without a name, the model.
    pub fn place(&self, network: &str) -> PathBuf {
        let model = match self {
            Self::Folder(folder) => folder,
            Self::BuiltIn(model) => Path::new(model.name),
        };
        if network.is_empty() { model.to_owned() } else { model.join(network) }
    }

    /// Whether it has a network of that name.
    pub fn has(&self, network: &str) -> bool {
        match self {
            Self::Folder(folder) => folder.join(network).join(DESCRIPTION).exists(),
            Self::BuiltIn(model) => model.file(network, DESCRIPTION).is_some(),
        }
    }

    /// The network of that name.
    ///
    /// # Errors
    ///
    /// A file that cannot be read; files that are no network.
    pub fn load(&self, network: &str) -> Result<Model, LoadError> {
        let failed = |(path, source)| LoadError::Read { path, source };
        let text = self.file(network, DESCRIPTION).map_err(failed)?;
        let weights = self.weights(network).map_err(failed)?;
        Model::load(&String::from_utf8_lossy(&text), &weights).map_err(LoadError::Net)
    }

    /// Its weights alone, safetensors.
    ///
    /// # Errors
    ///
    /// The file that cannot be read, and why.
    pub fn weights(&self, network: &str) -> Result<Cow<'static, [u8]>, (PathBuf, Error)> {
        self.file(network, WEIGHTS)
    }

    fn file(&self, network: &str, name: &str) -> Result<Cow<'static, [u8]>, (PathBuf, Error)> {
        let path = self.place(network).join(name);
        let bytes = match self {
            Self::Folder(_) => std::fs::read(&path).map(Cow::Owned),
            Self::BuiltIn(model) => {
                let file = model.file(network, name).map(Cow::Borrowed);
                file.ok_or_else(|| Error::from(ErrorKind::NotFound))
            }
        };
        bytes.map_err(|source| (path, source))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_the_model_that_comes_with_eyebolt_unless_a_model_lies_there() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(ModelFiles::at("panda".into()), ModelFiles::BuiltIn(_)));
        assert!(matches!(ModelFiles::at("padna".into()), ModelFiles::Folder(_)));
        let path = folder.path().join("panda");
        assert!(matches!(ModelFiles::at(path), ModelFiles::Folder(_)), "only the bare name");
        for name in ModelFiles::names() {
            let model = ModelFiles::at(name.into());
            assert!(model.has("segmentation") && !model.has(""));
            model.load("segmentation").unwrap();
        }
        let missing = ModelFiles::at("any-arm".into()).load("rotation");
        let Err(LoadError::Read { path, source }) = missing else { panic!("it has none") };
        assert_eq!(path, Path::new("any-arm/rotation/model.toml"));
        assert_eq!(source.kind(), ErrorKind::NotFound);
    }
}

//! The trained networks that come with eyebolt, as `eyebolt train` wrote them; `models/README.md` says what each knows
//! and how it was made.
//!
//! A crate of data: whoever names no model has none in the program.

/// The files of a model.
#[derive(Debug)]
pub struct BuiltInModel {
    /// Its name.
    pub name: &'static str,
    networks: &'static [Network],
}

/// A network: its name, `model.toml`, `weights.safetensors`.
type Network = (&'static str, &'static [u8], &'static [u8]);

impl BuiltInModel {
    /// The model of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        BUILT_IN.iter().find(|model| model.name == name)
    }

    /// The file of that name in the folder of a network.
    #[must_use]
    pub fn file(&self, network: &str, file: &str) -> Option<&'static [u8]> {
        let (_, description, weights) = self.networks.iter().find(|(name, ..)| *name == network)?;
        match file {
            "model.toml" => Some(description),
            "weights.safetensors" => Some(weights),
            _ => None,
        }
    }
}

macro_rules! model {
    ($name:literal, $($network:literal),+) => {
        BuiltInModel {
            name: $name,
            networks: &[$((
                $network,
                include_bytes!(concat!("../models/", $name, "/", $network, "/model.toml")),
                include_bytes!(concat!("../models/", $name, "/", $network, "/weights.safetensors")),
            )),+],
        }
    };
}

/// All of them.
pub static BUILT_IN: [BuiltInModel; 3] = [
    model!("any-arm", "segmentation"),
    model!("panda", "segmentation", "end_effector", "rotation", "keypoints"),
    model!("shackle", "segmentation", "end_effector", "rotation", "keypoints"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_file_in_the_folder_is_built_in() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
        let entries = |path: &Path| -> Vec<_> {
            let entries = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
            entries.filter(|path| path.extension().is_none_or(|it| it != "md")).collect()
        };
        let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut files = 0;
        for model in entries(&folder) {
            let built_in = BuiltInModel::named(&name(&model)).unwrap();
            for network in entries(&model) {
                for file in entries(&network) {
                    let bytes = std::fs::read(&file).unwrap();
                    assert_eq!(built_in.file(&name(&network), &name(&file)), Some(&*bytes));
                    files += 1;
                }
            }
        }
        assert_eq!(files, BUILT_IN.iter().map(|model| 2 * model.networks.len()).sum::<usize>());
    }
}

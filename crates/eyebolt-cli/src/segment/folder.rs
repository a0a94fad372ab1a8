//! Labels as a folder of files.

use super::cloud::{CloudForm, Points};
use super::segmented::{Segmented, Sink};
use crate::output;
use anyhow::Result;
use eyebolt_recording::write_npy;
use std::path::{Path, PathBuf};

/// Writes `label_FRAME.npy`, and clouds if they are wanted.
pub(super) struct FolderSink<'a> {
    folder: &'a Path,
    clouds: Option<CloudForm>,
    force: bool,
}

impl<'a> FolderSink<'a> {
    pub(super) fn new(folder: &'a Path, clouds: Option<CloudForm>, force: bool) -> Self {
        Self { folder, clouds, force }
    }

    fn label(&self, name: &str) -> PathBuf {
        self.folder.join(format!("label_{name}.npy"))
    }

    fn cloud(&self, name: &str, form: CloudForm) -> PathBuf {
        self.folder.join(format!("cloud_{name}.{}", form.ending()))
    }

    pub(super) fn refuse_existing(&self, names: &[String]) -> Result<()> {
        for name in names {
            output::refuse_existing(&self.label(name), self.force)?;
            if let Some(form) = self.clouds {
                output::refuse_existing(&self.cloud(name, form), self.force)?;
            }
        }
        Ok(())
    }
}

impl Sink for FolderSink<'_> {
    fn frame(&mut self, frame: &Segmented<'_>) -> Result<()> {
        if let Some(form) = self.clouds {
            let bytes = form.bytes(&Points::of(frame));
            output::write_whole(&self.cloud(frame.name, form), &bytes, self.force)?;
        }
        let shape = [frame.found.height, frame.found.width];
        let bytes = write_npy("|u1", &shape, frame.found.label.iter().copied());
        output::write_whole(&self.label(frame.name), &bytes, self.force)
    }
}

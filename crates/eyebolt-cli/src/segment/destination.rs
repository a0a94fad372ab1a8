//! Where labels go.

use super::cloud::{CloudForm, Points};
use super::folder::FolderSink;
use super::mcap::McapSink;
use super::npz::NpzSink;
use super::segmented::{Segmented, Sink};
use crate::output;
use anyhow::{Result, bail};
use eyebolt_recording::Recording;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Where labels go, by the name that was given.
pub(super) enum Destination {
    /// A folder of files for each frame.
    Folder(PathBuf, Option<CloudForm>),
    /// The points of the only frame.
    Cloud(PathBuf, CloudForm),
    /// The points of all frames as messages.
    Mcap(PathBuf),
    /// Labels of all frames as arrays.
    Npz(PathBuf),
}

impl Destination {
    /// What `path` names, with `clouds` beside the labels, for frames called `names`.
    pub(super) fn of(path: &Path, clouds: Option<CloudForm>, names: &[String]) -> Result<Self> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let path = path.to_owned();
        let to = match ending.to_ascii_lowercase().as_str() {
            "mcap" => Self::Mcap(path),
            "npz" => Self::Npz(path),
            "ply" => Self::Cloud(path, CloudForm::Ply),
            "pcd" => Self::Cloud(path, CloudForm::Pcd),
            _ => return Ok(Self::Folder(path, clouds)),
        };
        if clouds.is_some() {
            bail!(
                "{}: --output: --clouds writes into a folder. Name a folder, or leave --clouds out",
                to.path().display()
            );
        }
        match &to {
            Self::Cloud(path, form) if names.len() > 1 => bail!(
                "{}: --output: this takes one frame, and there are {}. Name a folder and give --clouds {}, or a file that ends in .mcap",
                path.display(),
                names.len(),
                form.ending()
            ),
            _ => Ok(to),
        }
    }

    pub(super) fn path(&self) -> &Path {
        let (Self::Folder(path, _) | Self::Cloud(path, _) | Self::Mcap(path) | Self::Npz(path)) =
            self;
        path
    }

    /// Whether how sure the networks are is written, too.
    pub(super) fn tells_probability(&self) -> bool {
        matches!(self, Self::Mcap(_) | Self::Npz(_))
    }

    /// An error if something is there already, unless `force` is given.
    pub(super) fn refuse_existing(&self, names: &[String], force: bool) -> Result<()> {
        match self {
            Self::Folder(folder, clouds) => {
                FolderSink::new(folder, *clouds, force).refuse_existing(names)
            }
            _ => output::refuse_existing(self.path(), force),
        }
    }

    /// Hands a taker of frames to `fill`, and writes what it took: a single file as a whole or not at all.
    pub(super) fn fill(
        &self,
        recording: &Recording<'_>,
        force: bool,
        fill: impl FnOnce(&mut dyn Sink) -> Result<()>,
    ) -> Result<()> {
        match self {
            Self::Folder(folder, clouds) => fill(&mut FolderSink::new(folder, *clouds, force)),
            Self::Cloud(path, form) => output::write_through(path, force, |file| {
                let mut only = Only { form: *form, bytes: None };
                fill(&mut only)?;
                let Some(bytes) = only.bytes else {
                    bail!("{}: there is no frame that can be read", path.display());
                };
                Ok(file.write_all(&bytes)?)
            }),
            Self::Mcap(path) => output::write_through(path, force, |file| {
                let named = |error| output::named(error, path);
                let mut sink = McapSink::new(file, recording).map_err(named)?;
                fill(&mut sink)?;
                sink.finish().map_err(named)
            }),
            Self::Npz(path) => output::write_through(path, force, |file| {
                let mut sink = NpzSink::new(file, recording)?;
                fill(&mut sink)?;
                sink.finish()
            }),
        }
    }
}

/// Takes one frame.
struct Only {
    form: CloudForm,
    bytes: Option<Vec<u8>>,
}

impl Sink for Only {
    fn frame(&mut self, frame: &Segmented<'_>) -> Result<()> {
        self.bytes = Some(self.form.bytes(&Points::of(frame)));
        Ok(())
    }
}

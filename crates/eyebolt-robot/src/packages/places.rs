//! Which of several places has the file.

use super::error::ResolveError;
use super::remedy::Remedy;
use std::path::{Path, PathBuf};

/// Where the file that a URL means may lie, and what to do if it does not.
pub(super) struct Places {
    pub(super) paths: Vec<PathBuf>,
    pub(super) remedy: Remedy,
}

impl Places {
    /// The first place that has the file.
    pub(super) fn first(self, url: &str) -> Result<PathBuf, ResolveError> {
        match self.paths.iter().find(|path| path.is_file()) {
            Some(found) => Ok(found.clone()),
            None => Err(self.not_found(url)),
        }
    }

    /// The first place that has the file inside one of `roots`, once `..` and symbolic links are
    /// resolved; so resolved, that no link can be put in its way later.
    pub(super) fn first_inside<'r>(
        self,
        url: &str,
        roots: impl Iterator<Item = &'r Path>,
    ) -> Result<PathBuf, ResolveError> {
        let files = self.paths.iter().filter(|path| path.is_file());
        let real: Vec<PathBuf> = files.filter_map(|path| path.canonicalize().ok()).collect();
        let Some(first) = real.first() else { return Err(self.not_found(url)) };
        let roots: Vec<PathBuf> = roots.filter_map(|root| root.canonicalize().ok()).collect();
        match real.iter().find(|path| roots.iter().any(|root| path.starts_with(root))) {
            Some(inside) => Ok(inside.clone()),
            None => Err(ResolveError::Outside { url: url.to_owned(), path: first.clone() }),
        }
    }

    fn not_found(self, url: &str) -> ResolveError {
        let Self { paths, remedy } = self;
        ResolveError::NotFound { url: url.to_owned(), looked_at: paths, remedy }
    }
}

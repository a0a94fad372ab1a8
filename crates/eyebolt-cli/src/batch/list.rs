//! Which recordings there are.

use super::arguments::Arguments;
use anyhow::{Context, Result, anyhow, bail};
use eyebolt::batch::{Listed, listed};
use std::io::Read;
use std::path::Path;

/// The recordings that are named, and those of the list.
pub fn read(arguments: &Arguments) -> Result<Vec<Listed>> {
    let text = arguments.list.as_deref().map(read_list).transpose()?.unwrap_or_default();
    let mut paths = Vec::new();
    for path in &arguments.recordings {
        match path.to_str() {
            Some(path) if !path.contains('\n') => paths.push(path),
            _ => bail!(
                "{}: a line of a list cannot have this name. Give the recording another one",
                path.display()
            ),
        }
    }
    let lines = text.lines().map(str::trim);
    paths.extend(lines.filter(|line| !line.is_empty() && !line.starts_with('#')));
    if paths.is_empty() {
        let list = arguments.list.as_deref().unwrap_or(Path::new("-"));
        bail!("{}: --list: no recordings. Write the path of one on each line", list.display());
    }
    listed(paths).map_err(|[one, other]| {
        anyhow!("{one} and {other} would have the same name. Move one to another folder")
    })
}

fn read_list(path: &Path) -> Result<String> {
    if path == Path::new("-") {
        let mut text = String::new();
        let read = std::io::stdin().read_to_string(&mut text);
        read.context("--list: cannot read standard input. Give one path on each line, in UTF-8")?;
        return Ok(text);
    }
    std::fs::read_to_string(path).with_context(|| {
        format!(
            "{}: --list: cannot be read. Name a file with one path on each line, in UTF-8",
            path.display()
        )
    })
}

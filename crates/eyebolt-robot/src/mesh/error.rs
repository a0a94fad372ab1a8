//! What can be wrong with a mesh.

use super::triangles::MAX_TRIANGLES;
use std::path::PathBuf;

/// A body without a usable mesh.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file could not be read.
    #[error("{}: cannot read the mesh: {source}; check the path and the permissions", path.display())]
    Read {
        /// The mesh file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is longer than [`crate::MAX_MESH_BYTES`].
    #[error(
        "{}: {bytes} bytes, but a mesh file may have {limit}; \
         decimate the mesh or use the collision mesh",
        path.display()
    )]
    TooLarge {
        /// The mesh file.
        path: PathBuf,
        /// Its length.
        bytes: u64,
        /// The longest accepted.
        limit: u64,
    },
    /// Not a format that is read.
    #[error(
        "{}: meshes of type `{extension}` are not read; convert it to STL, OBJ, DAE or GLB",
        path.display()
    )]
    UnsupportedFormat {
        /// The mesh file.
        path: PathBuf,
        /// The end of its name.
        extension: String,
    },
    /// The content is wrong.
    #[error("{name}: {field}: {problem}; export the mesh again")]
    Invalid {
        /// The mesh file, or the shape.
        name: String,
        /// Which part of it.
        field: String,
        /// What is wrong.
        problem: String,
    },
    /// More than [`crate::MAX_TRIANGLES`].
    #[error("{name}: more than {limit} triangles; decimate the mesh or use the collision mesh")]
    TooManyTriangles {
        /// The mesh file, or the shape.
        name: String,
        /// The most accepted.
        limit: usize,
    },
    /// No triangle with an area.
    #[error("{name}: no triangles; export the mesh again with its surface, or remove the body")]
    Empty {
        /// The mesh file, or the shape.
        name: String,
    },
}

/// What is wrong inside a mesh file; the caller knows which file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fault {
    Invalid { field: String, problem: String },
    TooManyTriangles,
}

impl Fault {
    pub(crate) fn invalid(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Invalid { field: field.into(), problem: problem.into() }
    }

    pub(crate) fn named(self, name: String) -> MeshError {
        match self {
            Self::Invalid { field, problem } => MeshError::Invalid { name, field, problem },
            Self::TooManyTriangles => MeshError::TooManyTriangles { name, limit: MAX_TRIANGLES },
        }
    }
}

/// Refuses `triangles` above [`MAX_TRIANGLES`].
pub(crate) fn check_count(triangles: usize) -> Result<(), Fault> {
    if triangles > MAX_TRIANGLES { Err(Fault::TooManyTriangles) } else { Ok(()) }
}

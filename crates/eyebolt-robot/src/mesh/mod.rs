//! Triangle meshes of links, in metres in the link's frame.

mod dae;
mod dae_geometry;
mod load;
mod obj;
mod primitives;
mod stl;
mod weld;

pub(crate) use load::{Format, read_mesh_file};
pub use load::{MAX_MESH_BYTES, Prefer, link_mesh, load_body};

use nalgebra::Point3;
use std::path::PathBuf;

/// Most triangles of one body.
pub const MAX_TRIANGLES: usize = 5_000_000;

/// A surface of triangles. Vertices are finite and shared by neighbours; every triangle has area.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Vertices, metres, in the link's frame.
    pub vertices: Vec<Point3<f32>>,
    /// Indices of the corners, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

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
    /// The file is longer than [`MAX_MESH_BYTES`].
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
        "{}: meshes of type `{extension}` are not read; convert it to STL, OBJ or DAE",
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
    /// More than [`MAX_TRIANGLES`].
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

/// What a reader returns: coordinates as in the file, indices not yet checked.
#[derive(Clone, Debug, Default)]
pub(crate) struct RawMesh {
    pub(crate) positions: Vec<Point3<f32>>,
    pub(crate) triangles: Vec<[u32; 3]>,
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

impl TriangleMesh {
    /// Adds `other`, whose vertices are in the same frame.
    ///
    /// `None`, and nothing added, if the vertices no longer fit 32-bit indices.
    pub fn append(&mut self, other: &Self) -> Option<()> {
        let first = u32::try_from(self.vertices.len()).ok()?;
        let last = u32::try_from(other.vertices.len()).ok()?;
        first.checked_add(last)?;
        self.vertices.extend_from_slice(&other.vertices);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|i| first + i)));
        Some(())
    }

    /// Least and greatest coordinates, metres; `None` without vertices.
    pub fn bounds(&self) -> Option<(Point3<f32>, Point3<f32>)> {
        let first = *self.vertices.first()?;
        Some(
            self.vertices
                .iter()
                .fold((first, first), |(low, high), vertex| (low.inf(vertex), high.sup(vertex))),
        )
    }
}

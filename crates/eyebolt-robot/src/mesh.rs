//! Triangle meshes of links, in metres in the link's frame.

mod dae;
mod dae_geometry;
mod error;
mod gltf;
mod load;
mod obj;
mod primitives;
mod raw;
mod stl;
mod triangles;
mod weld;

pub use error::MeshError;
pub(crate) use load::{Format, read_mesh_file};
pub use load::{MAX_MESH_BYTES, Prefer, link_mesh, load_body};
pub use triangles::{MAX_TRIANGLES, TriangleMesh};

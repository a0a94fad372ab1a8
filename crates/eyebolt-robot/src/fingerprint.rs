//! Content hashes of bodies and links: keys of caches of what is made from their meshes.

use crate::mesh::{Format, MeshError, Prefer, read_mesh_file};
use crate::robot::{Body, Link, Shape};
use std::fmt;

/// BLAKE3 hash of all that decides a mesh: file content, shape, scale and origin, not file names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(pub [u8; 32]);

impl fmt::Display for Fingerprint {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// Fingerprint of a body. Reads the mesh file, but does not parse it.
///
/// # Errors
/// A mesh file that cannot be read, is too large or has an unsupported format.
pub fn body_fingerprint(body: &Body) -> Result<Fingerprint, MeshError> {
    // Change the text when the same bytes start to give another mesh.
    let mut hash = Hash(blake3::Hasher::new_derive_key("eyebolt-robot body mesh, version 1"));
    let pose = body.link_from_body;
    hash.numbers(pose.translation_m().as_slice());
    hash.numbers(&pose.rotation_xyzw());
    match &body.shape {
        Shape::Mesh { path, scale } => {
            let file = read_mesh_file(path)?;
            hash.kind(match file.format {
                Format::Stl => "stl",
                Format::Obj => "obj",
                Format::Dae => "dae",
                Format::Gltf => "glt",
            });
            hash.numbers(scale);
            // Where one file ends and the next begins decides what is read of them.
            for part in std::iter::once(&file.bytes).chain(&file.beside) {
                if !file.beside.is_empty() {
                    hash.0.update(&(part.len() as u64).to_le_bytes());
                }
                hash.0.update(part);
            }
        }
        Shape::Box { size } => {
            hash.kind("box");
            hash.numbers(size);
        }
        Shape::Cylinder { radius, length } => {
            hash.kind("cyl");
            hash.numbers(&[*radius, *length]);
        }
        Shape::Capsule { radius, length } => {
            hash.kind("cap");
            hash.numbers(&[*radius, *length]);
        }
        Shape::Sphere { radius } => {
            hash.kind("sph");
            hash.numbers(&[*radius]);
        }
    }
    Ok(Fingerprint(hash.0.finalize().into()))
}

/// Fingerprint of the bodies that [`crate::link_mesh`] takes for the same `prefer`, in their order;
/// `None` if the link has no body.
///
/// # Errors
/// As [`body_fingerprint`].
pub fn link_fingerprint(link: &Link, prefer: Prefer) -> Result<Option<Fingerprint>, MeshError> {
    let bodies = prefer.bodies(link);
    if bodies.is_empty() {
        return Ok(None);
    }
    let mut hash = blake3::Hasher::new_derive_key("eyebolt-robot link mesh, version 1");
    for body in bodies {
        hash.update(&body_fingerprint(body)?.0);
    }
    Ok(Some(Fingerprint(hash.finalize().into())))
}

struct Hash(blake3::Hasher);

impl Hash {
    /// Three letters, so that no kind is the start of another.
    fn kind(&mut self, kind: &'static str) {
        self.0.update(kind.as_bytes());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        for number in numbers {
            // Adding zero makes -0 and 0 the same number.
            self.0.update(&(number + 0.0).to_bits().to_le_bytes());
        }
    }
}

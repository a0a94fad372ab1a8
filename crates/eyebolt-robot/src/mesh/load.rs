//! Bodies into meshes.

use super::error::{Fault, MeshError, check_count};
use super::raw::RawMesh;
use super::triangles::TriangleMesh;
use super::{dae, gltf, obj, primitives, stl, weld};
use crate::robot::{Body, Link, Shape};
use nalgebra::Point3;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Longest mesh file accepted, bytes.
pub const MAX_MESH_BYTES: u64 = 512 << 20;

/// Which bodies of a link to take where it has both kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Prefer {
    /// What the link looks like, as a depth camera sees it.
    #[default]
    Visual,
    /// The collision bodies: coarser, sometimes padded.
    Collision,
}

impl Prefer {
    /// The bodies to take: those preferred, else the others.
    pub(crate) fn bodies(self, link: &Link) -> &[Body] {
        let (first, second) = match self {
            Self::Visual => (&link.visuals, &link.collisions),
            Self::Collision => (&link.collisions, &link.visuals),
        };
        if first.is_empty() { second } else { first }
    }
}

/// Mesh of a body, metres, in its link's frame.
///
/// STL, OBJ, DAE, glTF and GLB are read; of a DAE, its unit and the transforms of its scene are applied and
/// its `up_axis` is not, as in RViz. Round shapes become facets that lie at most 0.2 mm inside.
///
/// # Errors
/// See [`MeshError`].
pub fn load_body(body: &Body) -> Result<TriangleMesh, MeshError> {
    let (raw, scale, name) = match &body.shape {
        Shape::Mesh { path, scale } => {
            let name = path.display().to_string();
            let file = read_mesh_file(path)?;
            (parse(&file).map_err(|fault| fault.named(name.clone()))?, *scale, name)
        }
        shape => {
            let name = primitives::name(shape).to_owned();
            let raw = primitives::tessellate(shape).map_err(|fault| fault.named(name.clone()))?;
            (raw, [1.0; 3], name)
        }
    };
    let [x, y, z] = scale;
    let link_from_body = body.link_from_body;
    let placed = |p: Point3<f64>| link_from_body.point(&Point3::new(x * p.x, y * p.y, z * p.z));
    let mirrored = x * y * z < 0.0;
    let mesh = weld::weld(&raw, mirrored, placed).map_err(|fault| fault.named(name.clone()))?;
    if mesh.triangles.is_empty() {
        return Err(MeshError::Empty { name });
    }
    Ok(mesh)
}

/// Mesh of all bodies of a link together, metres, in the link's frame; `None` if it has no body.
///
/// # Errors
/// See [`MeshError`].
pub fn link_mesh(link: &Link, prefer: Prefer) -> Result<Option<TriangleMesh>, MeshError> {
    let mut whole: Option<TriangleMesh> = None;
    for body in prefer.bodies(link) {
        let mesh = load_body(body)?;
        match &mut whole {
            None => whole = Some(mesh),
            Some(whole) => {
                let count = whole.triangles.len() + mesh.triangles.len();
                check_count(count)
                    .and_then(|()| whole.append(&mesh).ok_or(Fault::TooManyTriangles))
                    .map_err(|fault| fault.named(format!("link `{}`", link.name)))?;
            }
        }
    }
    Ok(whole)
}

/// How a mesh file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Stl,
    Obj,
    Dae,
    Gltf,
}

/// What a mesh file holds, unread.
pub(crate) struct MeshFile {
    pub(crate) format: Format,
    pub(crate) bytes: Vec<u8>,
    /// Files beside it that hold its numbers.
    pub(crate) beside: Vec<Vec<u8>>,
}

impl Format {
    /// By the end of the name.
    fn of(path: &Path) -> Result<Self, MeshError> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match extension.as_str() {
            "stl" | "stla" | "stlb" => Ok(Self::Stl),
            "obj" => Ok(Self::Obj),
            "dae" => Ok(Self::Dae),
            "gltf" | "glb" => Ok(Self::Gltf),
            _ => Err(MeshError::UnsupportedFormat { path: path.to_owned(), extension }),
        }
    }
}

/// Whole content of a mesh file; what is too much by its length or its header is not read.
pub(crate) fn read_mesh_file(path: &Path) -> Result<MeshFile, MeshError> {
    let format = Format::of(path)?;
    let bytes = read_file(path, format)?;
    let names = match format {
        Format::Gltf => {
            let names = gltf::buffer_files(&bytes);
            names.map_err(|fault| fault.named(path.display().to_string()))?
        }
        _ => Vec::new(),
    };
    let folder = path.parent().unwrap_or(Path::new("."));
    let beside = names.iter().map(|name| read_file(&folder.join(name), format));
    Ok(MeshFile { format, beside: beside.collect::<Result<_, _>>()?, bytes })
}

fn read_file(path: &Path, format: Format) -> Result<Vec<u8>, MeshError> {
    let failed = |source| MeshError::Read { path: path.to_owned(), source };
    let file = File::open(path).map_err(failed)?;
    let bytes = file.metadata().map_err(failed)?.len();
    let too_large =
        |bytes| MeshError::TooLarge { path: path.to_owned(), bytes, limit: MAX_MESH_BYTES };
    if bytes > MAX_MESH_BYTES {
        return Err(too_large(bytes));
    }
    let mut content = Vec::with_capacity(usize::try_from(bytes).unwrap_or(0));
    // The file may have grown, or be none whose length is known.
    let mut file = file.take(MAX_MESH_BYTES + 1);
    if format == Format::Stl {
        file.by_ref().take(stl::HEADER_AND_COUNT).read_to_end(&mut content).map_err(failed)?;
        let checked = stl::check_header(&content, bytes);
        checked.map_err(|fault| fault.named(path.display().to_string()))?;
    }
    file.read_to_end(&mut content).map_err(failed)?;
    if content.len() as u64 > MAX_MESH_BYTES {
        return Err(too_large(content.len() as u64));
    }
    Ok(content)
}

fn parse(file: &MeshFile) -> Result<RawMesh, Fault> {
    let bytes = &file.bytes;
    match file.format {
        Format::Stl => stl::read(bytes),
        Format::Obj => obj::read(bytes),
        Format::Dae => dae::read(bytes),
        Format::Gltf => gltf::read(bytes, &file.beside),
    }
}

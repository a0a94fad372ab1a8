//! Link models kept on disk, since they take seconds to build and milliseconds to read.
//!
//! A file is named by the hash of what it was built from and ends in the hash of its own content:
//! one that is cut off, damaged or of another version is built anew.

use crate::distance_field::DistanceField;
use crate::link_model::LinkModel;
use crate::surface_sample::SurfacePoint;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Changes whenever what is stored or how it is built does.
const VERSION: &[u8; 16] = b"eyebolt link  05";

/// A folder of link models.
#[derive(Clone, Debug)]
pub struct LinkCache {
    folder: Option<PathBuf>,
}

impl LinkCache {
    /// The cache in `folder`, which is made when the first model is written.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder: Some(folder) }
    }

    /// A cache that keeps nothing.
    pub fn disabled() -> Self {
        Self { folder: None }
    }

    /// The model of the link whose source has `fingerprint`, from disk or built from `mesh` with a
    /// distance field of at most `most_points`.
    ///
    /// A cache that cannot be written is no error: the model is merely built again next time.
    ///
    /// # Errors
    ///
    /// Those of `mesh`.
    pub fn load_or_build<E>(
        &self,
        fingerprint: &str,
        most_points: usize,
        mesh: impl FnOnce() -> Result<TriangleMesh, E>,
    ) -> Result<LinkModel, E> {
        let path = self
            .folder
            .as_ref()
            .map(|folder| folder.join(format!("{fingerprint}-{most_points}.link")));
        let stored = path.as_ref().and_then(|path| std::fs::read(path).ok());
        if let Some(model) = stored.and_then(|bytes| decode(&bytes)) {
            return Ok(model);
        }
        let model = LinkModel::build_within(&mesh()?, most_points);
        if let Some(path) = path {
            // Ignored on purpose: see above.
            let _ = write_whole(&path, &encode(&model));
        }
        Ok(model)
    }
}

/// Writes beside, then renames: readers see the whole file or none.
fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

fn encode(model: &LinkModel) -> Vec<u8> {
    let mut bytes = VERSION.to_vec();
    let field = &model.field;
    put_floats(&mut bytes, field.origin.coords.as_slice());
    put_floats(&mut bytes, &[field.voxel_m, field.step_m]);
    for count in field.size {
        put_count(&mut bytes, count);
    }
    bytes.extend(field.steps.iter().flat_map(|step| step.to_le_bytes()));
    put_count(&mut bytes, model.surface.len());
    for surface in &model.surface {
        put_floats(&mut bytes, surface.point.coords.as_slice());
        put_floats(&mut bytes, surface.normal.as_slice());
    }
    put_count(&mut bytes, model.mesh.vertices.len());
    for vertex in &model.mesh.vertices {
        put_floats(&mut bytes, vertex.coords.as_slice());
    }
    put_count(&mut bytes, model.mesh.triangles.len());
    bytes.extend(model.mesh.triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()));
    let hash = blake3::hash(&bytes);
    bytes.extend(hash.as_bytes());
    bytes
}

fn put_floats(bytes: &mut Vec<u8>, values: &[f32]) {
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
}

fn put_count(bytes: &mut Vec<u8>, count: usize) {
    bytes.extend((count as u64).to_le_bytes());
}

fn decode(bytes: &[u8]) -> Option<LinkModel> {
    let (content, hash) = bytes.split_last_chunk::<32>()?;
    if !content.starts_with(VERSION) || blake3::hash(content).as_bytes() != hash {
        return None;
    }
    let mut reader = Reader(&content[VERSION.len()..]);
    let origin = Point3::from(reader.vector()?);
    let (voxel_m, step_m) = (reader.float()?, reader.float()?);
    let size = [reader.count()?, reader.count()?, reader.count()?];
    let points = size.iter().try_fold(1usize, |product, n| product.checked_mul(*n))?;
    if size.iter().any(|n| *n < 2) {
        return None;
    }
    let steps = reader.chunks::<2>(points)?.map(i16::from_le_bytes).collect();
    let field = DistanceField::new(origin, voxel_m, size, steps, step_m);
    let surface = (0..reader.count()?).map(|_| {
        Some(SurfacePoint { point: Point3::from(reader.vector()?), normal: reader.vector()? })
    });
    let surface = surface.collect::<Option<Vec<_>>>()?;
    let vertices = (0..reader.count()?).map(|_| reader.vector().map(Point3::from));
    let vertices = vertices.collect::<Option<Vec<_>>>()?;
    let corners = reader.count()?.checked_mul(3)?;
    let corners: Vec<u32> = reader.chunks::<4>(corners)?.map(u32::from_le_bytes).collect();
    let (triangles, _) = corners.as_chunks::<3>();
    if corners.iter().any(|corner| *corner as usize >= vertices.len()) {
        return None;
    }
    Some(LinkModel {
        field,
        surface,
        mesh: TriangleMesh { vertices, triangles: triangles.to_vec() },
    })
}

/// What is left to read.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn chunks<const N: usize>(
        &mut self,
        count: usize,
    ) -> Option<impl Iterator<Item = [u8; N]> + use<'a, N>> {
        let (head, rest) = self.0.split_at_checked(count.checked_mul(N)?)?;
        self.0 = rest;
        Some(head.as_chunks::<N>().0.iter().copied())
    }

    fn float(&mut self) -> Option<f32> {
        self.chunks::<4>(1)?.next().map(f32::from_le_bytes)
    }

    fn count(&mut self) -> Option<usize> {
        usize::try_from(self.chunks::<8>(1)?.next().map(u64::from_le_bytes)?).ok()
    }

    fn vector(&mut self) -> Option<Vector3<f32>> {
        Some(Vector3::new(self.float()?, self.float()?, self.float()?))
    }
}

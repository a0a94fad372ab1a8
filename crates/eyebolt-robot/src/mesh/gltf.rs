//! glTF 2.0, as `.gltf` with its buffers and as `.glb`: the scene as one mesh in metres.
//!
//! Coordinates are taken as the file has them, y up or not: RViz, for which URDFs are written, does
//! the same (and the same of a DAE's `up_axis`).

use super::error::{Fault, check_count};
use super::raw::RawMesh;
use crate::packages::stays_inside;
use base64::Engine;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;
use gltf::mesh::Mode;
use gltf::{Accessor, Document, Gltf, Primitive, Semantic};
use nalgebra::{Matrix4, Point3};

/// Deepest nesting of nodes.
const MAX_DEPTH: usize = 64;
/// Most nodes visited.
const MAX_VISITS: usize = 100_000;
/// Bytes of the header of a `.glb`, whose length cannot be less.
const GLB_HEADER: usize = 12;

fn parse(bytes: &[u8]) -> Result<Gltf, Fault> {
    if bytes.starts_with(b"glTF") {
        let length = bytes.get(8..GLB_HEADER).and_then(|length| length.try_into().ok());
        let length = length.map_or(0, u32::from_le_bytes) as usize;
        if length < GLB_HEADER || length > bytes.len() {
            let problem = format!("{length} bytes are announced, but the file has {}", bytes.len());
            return Err(Fault::invalid("header, length", problem));
        }
    }
    Gltf::from_slice(bytes).map_err(|error| Fault::invalid("glTF", error.to_string()))
}

/// Names of the files beside this one that hold its buffers, in their order.
pub(super) fn buffer_files(bytes: &[u8]) -> Result<Vec<String>, Fault> {
    let file = parse(bytes)?;
    let named = file.buffers().filter_map(|buffer| match buffer.source() {
        Source::Uri(uri) if !uri.starts_with("data:") => Some(uri),
        _ => None,
    });
    named
        .map(|uri| {
            let path = crate::packages::percent_decoded(uri);
            path.filter(|path| stays_inside(path) && !path.contains("://")).ok_or_else(|| {
                let problem = format!("`{uri}` is no file below this one's folder");
                Fault::invalid("buffers, uri", problem)
            })
        })
        .collect()
}

/// All triangles, strips and fans that the scene shows; `files` are those of [`buffer_files`].
pub(super) fn read(bytes: &[u8], files: &[Vec<u8>]) -> Result<RawMesh, Fault> {
    let file = parse(bytes)?;
    let buffers = buffers(&file.document, file.blob.as_deref(), files)?;
    let scene = file.default_scene().or_else(|| file.scenes().next());
    let scene = scene.ok_or_else(|| Fault::invalid("scenes", "there is none"))?;
    let mut mesh = RawMesh::default();
    let mut waiting: Vec<_> = scene.nodes().map(|node| (node, Matrix4::identity(), 0)).collect();
    let mut visits = 0;
    while let Some((node, scene_from_parent, depth)) = waiting.pop() {
        visits += 1;
        if depth > MAX_DEPTH || visits > MAX_VISITS {
            return Err(Fault::invalid("nodes", "nested too deep, or nodes contain themselves"));
        }
        let local = Matrix4::from(node.transform().matrix()).cast::<f64>();
        let scene_from_node: Matrix4<f64> = scene_from_parent * local;
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            add(&primitive, &buffers, &scene_from_node, &mut mesh)?;
        }
        waiting.extend(node.children().map(|child| (child, scene_from_node, depth + 1)));
    }
    Ok(mesh)
}

/// What each buffer of the document holds.
fn buffers(
    document: &Document,
    blob: Option<&[u8]>,
    files: &[Vec<u8>],
) -> Result<Vec<Vec<u8>>, Fault> {
    let mut files = files.iter();
    let content = |source: Source<'_>| match source {
        Source::Bin => blob.map(<[u8]>::to_vec),
        Source::Uri(uri) => match uri.strip_prefix("data:") {
            Some(data) => base64::engine::general_purpose::STANDARD
                .decode(data.split_once(";base64,")?.1)
                .ok(),
            None => files.next().cloned(),
        },
    };
    let contents: Option<Vec<_>> = document.buffers().map(|b| b.source()).map(content).collect();
    contents.ok_or_else(|| Fault::invalid("buffers", "one has no data that can be read"))
}

/// Adds one primitive; points and lines are left out.
fn add(
    primitive: &Primitive<'_>,
    buffers: &[Vec<u8>],
    scene_from_node: &Matrix4<f64>,
    mesh: &mut RawMesh,
) -> Result<(), Fault> {
    if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        return Ok(());
    }
    let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(()) };
    let positions = read_positions(&positions, buffers)?;
    let corners = match primitive.indices() {
        Some(indices) => read_indices(&indices, buffers)?,
        None => (0..positions.len() as u32).collect(),
    };
    let count = positions.len();
    if let Some(corner) = corners.iter().find(|corner| **corner as usize >= count) {
        let problem = format!("index {corner}, but there are {count} positions");
        return Err(Fault::invalid("indices", problem));
    }
    let first = u32::try_from(mesh.positions.len()).map_err(|_| Fault::TooManyTriangles)?;
    first.checked_add(count as u32).ok_or(Fault::TooManyTriangles)?;
    let placed = positions.iter().map(|p| scene_from_node.transform_point(p).cast::<f32>());
    mesh.positions.extend(placed);
    let mirrored = scene_from_node.fixed_view::<3, 3>(0, 0).determinant() < 0.0;
    let faced = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
    let triangles = triangles(primitive.mode(), &corners);
    mesh.triangles.extend(triangles.map(|corners| faced(corners).map(|corner| first + corner)));
    check_count(mesh.triangles.len())
}

/// The triangles of a list of corners.
fn triangles(mode: Mode, corners: &[u32]) -> Box<dyn Iterator<Item = [u32; 3]> + '_> {
    let pairs = corners.iter().zip(corners.iter().skip(1));
    match mode {
        Mode::TriangleStrip => {
            let threes = pairs.zip(corners.iter().skip(2)).enumerate();
            // Every second triangle of a strip runs the other way round.
            Box::new(threes.map(|(i, ((a, b), c))| match i % 2 {
                0 => [*a, *b, *c],
                _ => [*b, *a, *c],
            }))
        }
        Mode::TriangleFan => {
            let first = corners.first().copied().unwrap_or_default();
            Box::new(pairs.skip(1).map(move |(b, c)| [first, *b, *c]))
        }
        _ => Box::new(corners.as_chunks::<3>().0.iter().copied()),
    }
}

fn read_positions(accessor: &Accessor<'_>, buffers: &[Vec<u8>]) -> Result<Vec<Point3<f64>>, Fault> {
    if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
        return Err(Fault::invalid("POSITION", "not three 32-bit floats each"));
    }
    let number = |bytes: &[u8], at: usize| {
        let bytes = bytes.get(4 * at..4 * at + 4).and_then(|bytes| bytes.try_into().ok());
        f64::from(bytes.map_or(f32::NAN, f32::from_le_bytes))
    };
    let point = |bytes: &[u8]| Point3::new(number(bytes, 0), number(bytes, 1), number(bytes, 2));
    let points: Vec<_> = elements(accessor, buffers, "POSITION")?.map(point).collect();
    match points.iter().all(|point| point.iter().all(|x| x.is_finite())) {
        true => Ok(points),
        false => Err(Fault::invalid("POSITION", "a coordinate is not finite")),
    }
}

fn read_indices(accessor: &Accessor<'_>, buffers: &[Vec<u8>]) -> Result<Vec<u32>, Fault> {
    let known = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    if !known || accessor.dimensions() != Dimensions::Scalar {
        return Err(Fault::invalid("indices", "not whole numbers"));
    }
    let number = |bytes: &[u8]| {
        bytes.iter().rev().fold(0_u32, |number, byte| (number << 8) | u32::from(*byte))
    };
    Ok(elements(accessor, buffers, "indices")?.map(number).collect())
}

/// The bytes of each element of `accessor`: as many as it announces, all of which must be there.
fn elements<'b>(
    accessor: &Accessor<'_>,
    buffers: &'b [Vec<u8>],
    field: &'static str,
) -> Result<impl Iterator<Item = &'b [u8]>, Fault> {
    if accessor.sparse().is_some() {
        let problem = "sparse accessors are not read; export the mesh without them";
        return Err(Fault::invalid(field, problem));
    }
    let (size, count) = (accessor.size(), accessor.count());
    let found = || {
        let view = accessor.view()?;
        let buffer = buffers.get(view.buffer().index())?;
        let view_end = view.offset().checked_add(view.length())?;
        let bytes = buffer.get(view.offset()..view_end)?.get(accessor.offset()..)?;
        let stride = view.stride().unwrap_or(size).max(size);
        let needed = count.checked_sub(1)?.checked_mul(stride)?.checked_add(size)?;
        let bytes = bytes.get(..needed)?;
        Some(bytes.chunks(stride).filter_map(move |element| element.get(..size)))
    };
    found().ok_or_else(|| {
        let problem = format!("{count} are announced, which the buffer does not hold");
        Fault::invalid(field, problem)
    })
}

//! One `<geometry>` of a COLLADA document: positions and triangles, nothing else.

use super::error::{Fault, check_count};
use crate::xml::child;
use nalgebra::Point3;
use roxmltree::Node;
use std::collections::HashMap;
use std::iter::Peekable;
use std::str::SplitAsciiWhitespace;

type ById<'a, 'i> = HashMap<&'a str, Node<'a, 'i>>;

/// Positions in the unit of the document and triangles whose indices are in range.
pub(super) struct Geometry {
    pub(super) positions: Vec<Point3<f64>>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// All triangles, polygons (cut into fans), strips and fans of a geometry; lines are left out.
pub(super) fn read_geometry<'a, 'i>(
    id: &str,
    node: Node<'a, 'i>,
    by_id: &ById<'a, 'i>,
) -> Result<Geometry, Fault> {
    let mut geometry = Geometry { positions: Vec::new(), triangles: Vec::new() };
    let mut known: HashMap<&str, (usize, usize)> = HashMap::new();
    let Some(mesh) = child(node, "mesh") else { return Ok(geometry) };
    for part in mesh.children() {
        let tag = part.tag_name().name();
        if !matches!(tag, "triangles" | "polylist" | "polygons" | "tristrips" | "trifans") {
            continue;
        }
        let fault = |problem: String| Fault::invalid(format!("geometry `{id}`, <{tag}>"), problem);
        let input = Input::of(part).map_err(fault)?;
        let Some(input) = input else { continue };
        let (first, count) = match known.get(input.source) {
            Some(range) => *range,
            None => {
                let read = positions(input.source, by_id).map_err(fault)?;
                let range = (geometry.positions.len(), read.len());
                geometry.positions.extend(read);
                known.insert(input.source, range);
                range
            }
        };
        let before = geometry.triangles.len();
        faces(part, &input, &mut geometry.triangles, &fault)?;
        for corner in geometry.triangles.iter_mut().skip(before).flatten() {
            if *corner as usize >= count {
                return Err(fault(format!("index {corner}, but there are {count} positions")));
            }
            *corner =
                u32::try_from(first + *corner as usize).map_err(|_| Fault::TooManyTriangles)?;
        }
    }
    Ok(geometry)
}

/// Where in a primitive's list of indices the positions are.
struct Input<'a> {
    source: &'a str,
    offset: usize,
    stride: usize,
}

impl<'a> Input<'a> {
    /// `None` for a primitive without a single index.
    fn of(primitive: Node<'a, '_>) -> Result<Option<Self>, String> {
        let (mut vertex, mut stride) = (None, 1);
        for input in primitive.children().filter(|child| child.tag_name().name() == "input") {
            let offset = match input.attribute("offset").map(|text| text.trim().parse::<u8>()) {
                None => 0,
                Some(Ok(offset)) => usize::from(offset),
                Some(Err(_)) => {
                    return Err("an input's offset is not a number below 256".to_owned());
                }
            };
            stride = stride.max(offset + 1);
            if input.attribute("semantic") == Some("VERTEX") {
                vertex = Some((input.attribute("source").unwrap_or_default(), offset));
            }
        }
        match vertex {
            Some((source, offset)) => Ok(Some(Self { source, offset, stride })),
            None if child(primitive, "p").is_none() => Ok(None),
            None => Err("no input with semantic VERTEX".to_owned()),
        }
    }
}

fn target<'a, 'i>(url: &str, by_id: &ById<'a, 'i>) -> Result<Node<'a, 'i>, String> {
    let found = url.strip_prefix('#').and_then(|id| by_id.get(id)).copied();
    found.ok_or_else(|| format!("nothing has the id `{url}`"))
}

/// Positions behind a VERTEX input: vertices -> POSITION source -> accessor -> array.
fn positions<'a, 'i>(url: &str, by_id: &ById<'a, 'i>) -> Result<Vec<Point3<f64>>, String> {
    let vertices = target(url, by_id)?;
    let position = vertices
        .children()
        .find(|input| input.attribute("semantic") == Some("POSITION"))
        .and_then(|input| input.attribute("source"))
        .ok_or_else(|| format!("`{url}` has no input with semantic POSITION"))?;
    let source = target(position, by_id)?;
    let accessor = child(source, "technique_common")
        .and_then(|technique| child(technique, "accessor"))
        .ok_or_else(|| format!("source `{position}` has no <accessor>"))?;
    let number = |name: &str, absent: usize| match accessor.attribute(name) {
        None => Ok(absent),
        Some(text) => text
            .trim()
            .parse::<usize>()
            .map_err(|_| format!("accessor of `{position}`, {name}: `{text}` is not a count")),
    };
    let (stride, offset) = (number("stride", 1)?, number("offset", 0)?);
    if stride < 3 {
        return Err(format!("accessor of `{position}`: stride {stride}, but a position has 3"));
    }
    let array = target(accessor.attribute("source").unwrap_or_default(), by_id)?;
    let mut words = array.text().unwrap_or_default().split_ascii_whitespace();
    for _ in 0..offset {
        words.next().ok_or_else(|| format!("`{position}` ends before its offset {offset}"))?;
    }
    // The data count, not the announcement: exporters count floats where positions belong.
    let mut words = words.peekable();
    let mut read = Vec::new();
    while words.peek().is_some() {
        let point = position_of(&mut words, stride);
        read.push(
            point.map_err(|problem| format!("`{position}`: position {}: {problem}", read.len()))?,
        );
    }
    Ok(read)
}

/// The next position; what else belongs to it may be missing at the end.
fn position_of(
    words: &mut Peekable<SplitAsciiWhitespace<'_>>,
    stride: usize,
) -> Result<Point3<f64>, String> {
    let mut number = || {
        let word = words.next().ok_or_else(|| "the array is cut off".to_owned())?;
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("`{word}` is not a finite number")),
        }
    };
    let point = Point3::new(number()?, number()?, number()?);
    words.by_ref().take(stride - 3).for_each(drop);
    Ok(point)
}

/// Adds the faces of one primitive.
fn faces(
    primitive: Node<'_, '_>,
    input: &Input<'_>,
    triangles: &mut Vec<[u32; 3]>,
    fault: &dyn Fn(String) -> Fault,
) -> Result<(), Fault> {
    if child(primitive, "ph").is_some() {
        return Err(fault("polygons with holes are not read; triangulate the mesh".to_owned()));
    }
    let tag = primitive.tag_name().name();
    for list in primitive.children().filter(|child| child.tag_name().name() == "p") {
        let corners = corners(list.text().unwrap_or_default(), input).map_err(fault)?;
        match tag {
            "triangles" => triangles.extend(thirds(&corners).map_err(fault)?),
            "polylist" => polygons(primitive, &corners, triangles).map_err(fault)?,
            "tristrips" => triangles.extend(strip(&corners)),
            _ => triangles.extend(fan(&corners)),
        }
        check_count(triangles.len())?;
    }
    Ok(())
}

fn thirds(corners: &[u32]) -> Result<&[[u32; 3]], String> {
    match corners.as_chunks::<3>() {
        (triangles, []) => Ok(triangles),
        _ => Err(format!("{} corners don't come in threes", corners.len())),
    }
}

/// Position indices of a list `<p>`.
fn corners(text: &str, input: &Input<'_>) -> Result<Vec<u32>, String> {
    let mut corners = Vec::new();
    let mut indices = 0;
    for (place, word) in text.split_ascii_whitespace().enumerate() {
        indices = place + 1;
        if place % input.stride == input.offset {
            let index = word.parse::<u32>();
            corners.push(index.map_err(|_| format!("`{word}` is not an index"))?);
        }
    }
    if indices % input.stride != 0 {
        return Err(format!("{indices} indices do not come in groups of {}", input.stride));
    }
    Ok(corners)
}

fn polygons(
    primitive: Node<'_, '_>,
    corners: &[u32],
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), String> {
    let counts = child(primitive, "vcount").and_then(|counts| counts.text()).unwrap_or_default();
    let mut rest = corners;
    for word in counts.split_ascii_whitespace() {
        let count = word.parse::<usize>().ok();
        let split = count.and_then(|count| rest.split_at_checked(count));
        let (polygon, after) = split
            .ok_or_else(|| format!("vcount: `{word}`, but {} corners are left", rest.len()))?;
        triangles.extend(fan(polygon));
        rest = after;
    }
    if rest.is_empty() {
        Ok(())
    } else {
        Err(format!("vcount: {} corners are left over", rest.len()))
    }
}

/// Right for convex polygons, which is what exporters write.
fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let first = corners.first().copied().unwrap_or_default();
    let pairs = corners.iter().zip(corners.iter().skip(1)).skip(1);
    pairs.map(move |(b, c)| [first, *b, *c])
}

fn strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let pairs = corners.iter().zip(corners.iter().skip(1));
    let threes = pairs.zip(corners.iter().skip(2)).enumerate();
    // Every second triangle of a strip runs the other way round.
    threes.map(|(i, ((a, b), c))| if i % 2 == 0 { [*a, *b, *c] } else { [*b, *a, *c] })
}

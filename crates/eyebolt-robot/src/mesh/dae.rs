//! COLLADA (DAE): the scene of a document as one mesh in metres.
//!
//! `mesh-loader`, which reads DAE too, keeps one transform per geometry (a geometry shown twice is
//! drawn once) and draws geometries that the scene does not show.

use super::dae_geometry::{Geometry, read_geometry};
use super::error::{Fault, check_count};
use super::raw::RawMesh;
use crate::xml::{self, child};
use nalgebra::{Matrix3, Matrix4, Point3, Unit, Vector3};
use roxmltree::Node;
use std::collections::HashMap;
use std::rc::Rc;

/// Deepest nesting of scene nodes, through `instance_node` too.
const MAX_DEPTH: usize = 64;
/// Most scene nodes visited: nodes that show nodes that show nodes grow without bound.
const MAX_VISITS: usize = 100_000;

/// Everything that the scene shows, with its transforms and the unit of the document applied.
///
/// `up_axis` is read by nobody in ROS: RViz and MoveIt undo the turn that assimp makes of it, and
/// URDFs are written for them.
pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, Fault> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| Fault::invalid("encoding", format!("not UTF-8: {error}")))?;
    let document = xml::parse(text.trim_start_matches('\u{feff}'))
        .map_err(|(problem, remedy)| Fault::invalid("XML", format!("{problem} ({remedy})")))?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(Fault::invalid("XML", "the outermost element is not <COLLADA>"));
    }
    let mut scene = Scene {
        by_id: root.descendants().filter_map(|n| Some((n.attribute("id")?, n))).collect(),
        geometries: HashMap::new(),
        mesh: RawMesh::default(),
    };
    let unit = unit(root)?;
    let shown = scene.visual_scene(root)?;
    scene.show(shown, Matrix4::new_scaling(unit))?;
    Ok(scene.mesh)
}

/// Metres per unit of the document; 1 where it does not say.
fn unit(root: Node<'_, '_>) -> Result<f64, Fault> {
    let unit = child(root, "asset").and_then(|asset| child(asset, "unit"));
    let Some(text) = unit.and_then(|unit| unit.attribute("meter")) else { return Ok(1.0) };
    match text.trim().parse::<f64>() {
        Ok(metres) if metres.is_finite() && metres > 0.0 => Ok(metres),
        _ => Err(Fault::invalid("asset/unit, meter", format!("`{text}` is not a length"))),
    }
}

struct Scene<'a, 'i> {
    by_id: HashMap<&'a str, Node<'a, 'i>>,
    geometries: HashMap<&'a str, Rc<Geometry>>,
    mesh: RawMesh,
}

impl<'a, 'i> Scene<'a, 'i> {
    fn visual_scene(&self, root: Node<'a, 'i>) -> Result<Node<'a, 'i>, Fault> {
        let instance = child(root, "scene").and_then(|s| child(s, "instance_visual_scene"));
        match instance {
            Some(instance) => Ok(self.target(instance)?.1),
            None => child(root, "library_visual_scenes")
                .and_then(|library| child(library, "visual_scene"))
                .ok_or_else(|| Fault::invalid("scene", "there is no <visual_scene>")),
        }
    }

    /// The element that an instance's `url` means, with its id.
    fn target(&self, instance: Node<'a, 'i>) -> Result<(&'a str, Node<'a, 'i>), Fault> {
        let url = instance.attribute("url").unwrap_or_default();
        let found = url.strip_prefix('#').and_then(|id| Some((id, *self.by_id.get(id)?)));
        found.ok_or_else(|| {
            let tag = instance.tag_name().name();
            Fault::invalid(format!("{tag}, url"), format!("nothing has the id `{url}`"))
        })
    }

    /// Adds all that hangs below `top`.
    fn show(&mut self, top: Node<'a, 'i>, metres_from_top: Matrix4<f64>) -> Result<(), Fault> {
        let mut waiting = vec![(top, metres_from_top, 0)];
        let mut visits = 0;
        while let Some((node, metres_from_parent, depth)) = waiting.pop() {
            visits += 1;
            if depth > MAX_DEPTH || visits > MAX_VISITS {
                return Err(Fault::invalid("node", "nodes are nested too deep or show themselves"));
            }
            let metres_from_node = metres_from_parent * local_transform(node)?;
            for part in node.children() {
                match part.tag_name().name() {
                    "node" => waiting.push((part, metres_from_node, depth + 1)),
                    "instance_node" => {
                        waiting.push((self.target(part)?.1, metres_from_node, depth + 1));
                    }
                    "instance_geometry" => self.add(part, &metres_from_node)?,
                    "instance_controller" => {
                        let problem = "skinned meshes are not read; bake the mesh";
                        return Err(Fault::invalid("instance_controller", problem));
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    fn add(&mut self, instance: Node<'a, 'i>, metres: &Matrix4<f64>) -> Result<(), Fault> {
        let (id, node) = self.target(instance)?;
        let geometry = match self.geometries.get(id) {
            Some(known) => Rc::clone(known),
            None => {
                let read = Rc::new(read_geometry(id, node, &self.by_id)?);
                self.geometries.insert(id, Rc::clone(&read));
                read
            }
        };
        check_count(self.mesh.triangles.len() + geometry.triangles.len())?;
        let first = u32::try_from(self.mesh.positions.len() + geometry.positions.len())
            .map(|total| total - geometry.positions.len() as u32)
            .map_err(|_| Fault::TooManyTriangles)?;
        let place = |p: &Point3<f64>| metres.transform_point(p).cast::<f32>();
        self.mesh.positions.extend(geometry.positions.iter().map(place));
        let linear: Matrix3<f64> = metres.fixed_view::<3, 3>(0, 0).into_owned();
        let mirrored = linear.determinant() < 0.0;
        self.mesh.triangles.extend(geometry.triangles.iter().map(|[a, b, c]| {
            let (b, c) = if mirrored { (c, b) } else { (b, c) };
            [first + a, first + b, first + c]
        }));
        Ok(())
    }
}

/// Product of a node's transforms in the order of the document.
fn local_transform(node: Node<'_, '_>) -> Result<Matrix4<f64>, Fault> {
    let mut product = Matrix4::identity();
    for part in node.children().filter(Node::is_element) {
        let tag = part.tag_name().name();
        product *= match tag {
            "matrix" => Matrix4::from_row_slice(&numbers::<16>(part)?),
            "translate" => Matrix4::new_translation(&Vector3::from(numbers::<3>(part)?)),
            "scale" => Matrix4::new_nonuniform_scaling(&Vector3::from(numbers::<3>(part)?)),
            "rotate" => {
                let [x, y, z, degrees] = numbers::<4>(part)?;
                match Unit::try_new(Vector3::new(x, y, z), 1e-12) {
                    Some(axis) => Matrix4::from_axis_angle(&axis, degrees.to_radians()),
                    None => Matrix4::identity(),
                }
            }
            "lookat" | "skew" => {
                let problem = "this transform is not read; bake it into the mesh";
                return Err(Fault::invalid(tag, problem));
            }
            _ => continue,
        };
    }
    if product.row(3) != nalgebra::RowVector4::new(0.0, 0.0, 0.0, 1.0) {
        return Err(Fault::invalid("matrix", "the last row is not `0 0 0 1`"));
    }
    Ok(product)
}

fn numbers<const N: usize>(node: Node<'_, '_>) -> Result<[f64; N], Fault> {
    let words = node.text().unwrap_or_default().split_ascii_whitespace();
    let parsed: Vec<f64> = words.map_while(|word| word.parse().ok()).take(N + 1).collect();
    <[f64; N]>::try_from(parsed)
        .ok()
        .filter(|numbers| numbers.iter().all(|number| number.is_finite()))
        .ok_or_else(|| {
            let tag = node.tag_name().name();
            Fault::invalid(tag, format!("not {N} finite numbers"))
        })
}

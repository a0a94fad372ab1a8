//! URDF text into links and joints, not yet put in order.
//!
//! Format: <http://wiki.ros.org/urdf/XML>, with `quat_xyzw` and `capsule` of later versions.

use crate::error::RobotError;
use crate::flaw::{Flaw, Of};
use crate::input::Input;
use crate::packages::PackageRoots;
use crate::robot::{Body, JointKind, JointLimits, Robot, Shape};
use crate::tree::{self, Motion, ParsedJoint, ParsedLink};
use crate::xacro::{self, XacroArguments};
use crate::xml::{self, Element};
use eyebolt_geometry::{Transform, frame};
use nalgebra::{Translation3, Unit, UnitQuaternion, Vector3};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Longest URDF accepted, bytes.
pub const MAX_URDF_BYTES: u64 = 64 << 20;

/// The text that describes a robot, and where it came from.
#[derive(Clone, Debug)]
pub struct Description {
    /// URDF: what xacro stood for is expanded.
    pub text: String,
    file: String,
    directory: PathBuf,
}

impl Description {
    /// Reads a URDF file, or expands a xacro file with `arguments`. Meshes are not looked at yet.
    ///
    /// # Errors
    /// A file that cannot be read, is too large or cannot be expanded.
    pub fn read(
        path: &Path,
        packages: &PackageRoots,
        arguments: &XacroArguments,
    ) -> Result<Self, RobotError> {
        let file = path.display().to_string();
        let text = read_limited(path, &file)?;
        let directory = match path.parent() {
            Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
            Some(parent) => parent,
            None => Path::new("."),
        };
        // Packages above the URDF are found by walking up, which needs the whole path.
        let directory = std::path::absolute(directory).unwrap_or_else(|_| directory.to_owned());
        if !needs_expansion(path, &text) {
            return Ok(Self { text, file, directory });
        }
        let text = xacro::expand(path, &text, packages, arguments)?;
        Ok(Self { text, file: format!("{file} (expanded)"), directory })
    }

    /// The robot that it describes. Meshes must exist where the arm needs them, but are not read.
    ///
    /// # Errors
    /// See [`RobotError`]; each names the file, the element and what to do.
    pub fn robot(&self, packages: &PackageRoots) -> Result<Robot, RobotError> {
        parse(&self.text, &self.file, Some(&self.directory), packages)
    }
}

/// Whether the file is xacro by its name or by its elements.
fn needs_expansion(path: &Path, text: &str) -> bool {
    let named = path.extension().is_some_and(|extension| extension == "xacro");
    // Most files have no such word, and need not be parsed twice.
    named
        || (text.contains("xacro") && {
            let text = text.trim_start_matches('\u{feff}').trim_start();
            xml::parse(&xml::with_declared_prefixes(text))
                .is_ok_and(|document| xacro::is_xacro(&document))
        })
}

impl Robot {
    /// Reads a URDF file, or a xacro file whose arguments all have defaults. Meshes must exist where
    /// the arm needs them, but are not read.
    ///
    /// # Errors
    /// See [`RobotError`]; each names the file, the element and what to do.
    pub fn from_urdf_file(path: &Path, packages: &PackageRoots) -> Result<Self, RobotError> {
        Description::read(path, packages, &XacroArguments::default())?.robot(packages)
    }

    /// Reads URDF text. Relative mesh paths start at `directory`, the folder of the file that the
    /// text is from.
    ///
    /// Without one, the text came with a recording, such as its `/robot_description`, and nobody of
    /// this machine vouches for it: it may name files inside the folders of `packages` only, or
    /// others if [`PackageRoots::with_outside_files`] allows it.
    ///
    /// # Errors
    /// See [`RobotError`]; each names the element and what to do.
    pub fn from_urdf_str(
        text: &str,
        directory: Option<&Path>,
        packages: &PackageRoots,
    ) -> Result<Self, RobotError> {
        parse(text, "robot description", directory, packages)
    }
}

fn read_limited(path: &Path, file: &str) -> Result<String, RobotError> {
    let failed = |source| RobotError::Read { path: path.to_owned(), source: Arc::new(source) };
    let handle = std::fs::File::open(path).map_err(failed)?;
    let mut text = String::new();
    // One byte more than allowed, so that a file that is too long shows.
    handle.take(MAX_URDF_BYTES + 1).read_to_string(&mut text).map_err(failed)?;
    check_length(text.len() as u64, file)?;
    Ok(text)
}

fn check_length(bytes: u64, file: &str) -> Result<(), RobotError> {
    if bytes > MAX_URDF_BYTES {
        return Err(RobotError::TooLarge { file: file.to_owned(), bytes, limit: MAX_URDF_BYTES });
    }
    Ok(())
}

fn parse(
    text: &str,
    file: &str,
    directory: Option<&Path>,
    packages: &PackageRoots,
) -> Result<Robot, RobotError> {
    check_length(text.len() as u64, file)?;
    let trimmed = text.trim_start_matches('\u{feff}').trim_start();
    let declared = xml::with_declared_prefixes(trimmed);
    let document = xml::parse(&declared).map_err(|(problem, remedy)| RobotError::Xml {
        file: file.to_owned(),
        problem,
        remedy,
    })?;
    let root = Element { node: document.root_element(), file, context: "<robot>".to_owned() };
    let found = root.node.tag_name().name();
    if found != "robot" {
        return Err(root.error("", format!("the outermost element is <{found}>; give a URDF")));
    }
    if xacro::is_xacro(&document) {
        let problem = format!(
            "this is xacro, not expanded: give the file with {}, or expand it: xacro FILE.xacro > FILE.urdf",
            Input::ROBOT
        );
        return Err(root.error("", problem));
    }
    let reader = Reader { directory, packages, quaternions: has_quaternions(&root) };
    let mut flaws = Vec::new();
    let links = root.children("link").map(|link| reader.link(link, &mut flaws));
    let links = links.collect::<Result<_, _>>()?;
    let joints = root.children("joint").map(|joint| reader.joint(joint, &mut flaws));
    let joints = joints.collect::<Result<_, _>>()?;
    let (links, joints) = tree::build(file, links, joints, &mut flaws)?;
    Ok(Robot {
        name: root.node.attribute("name").unwrap_or_default().to_owned(),
        links,
        joints,
        source: file.to_owned(),
        urdf_hash: blake3::hash(text.as_bytes()).to_hex().to_string(),
        flaws,
    })
}

/// `quat_xyzw` counts from version 1.1 on; older readers ignore it, and so must we.
fn has_quaternions(root: &Element<'_, '_>) -> bool {
    let version = root.node.attribute("version").unwrap_or("1.0").trim();
    let parts = version
        .split_once('.')
        .and_then(|(major, minor)| Some((major.parse::<u32>().ok()?, minor.parse::<u32>().ok()?)));
    parts.is_some_and(|version| version >= (1, 1))
}

struct Reader<'r> {
    directory: Option<&'r Path>,
    packages: &'r PackageRoots,
    quaternions: bool,
}

impl Reader<'_> {
    /// A link, and what is wrong with its bodies: whether that matters, the arm decides.
    fn link(
        &self,
        mut element: Element<'_, '_>,
        flaws: &mut Vec<Flaw>,
    ) -> Result<ParsedLink, RobotError> {
        let name = named(&mut element, "link")?;
        let mut bodies = |kind, of: fn(String) -> Of| {
            let mut sound = Vec::new();
            for body in element.children(kind) {
                match self.body(&body, &name) {
                    Ok(body) => sound.push(body),
                    Err(BodyFault::Nothing(error)) => {
                        flaws.push(Flaw { of: Of::Nothing(name.clone()), error });
                    }
                    Err(BodyFault::Wrong(error)) => {
                        flaws.push(Flaw { of: of(name.clone()), error });
                    }
                }
            }
            sound
        };
        let visuals = bodies("visual", Of::Visual);
        let collisions = bodies("collision", Of::Collision);
        Ok(ParsedLink { name, visuals, collisions })
    }

    fn body(&self, element: &Element<'_, '_>, link: &str) -> Result<Body, BodyFault> {
        let geometry = element.required_child("geometry")?;
        let shape = geometry
            .node
            .children()
            .find(|child| child.is_element())
            .map(|node| geometry.around(node))
            .ok_or_else(|| geometry.error("", "empty; add a <mesh> or another shape"))?;
        if has_no_extent(&shape) {
            return Err(BodyFault::Nothing(shape.error("", "no extent at all; remove it")));
        }
        Ok(Body { link_from_body: self.origin(element)?, shape: self.shape(&shape, link)? })
    }

    fn shape(&self, element: &Element<'_, '_>, link: &str) -> Result<Shape, RobotError> {
        let radius = || element.positive("radius");
        let length = || element.positive("length");
        Ok(match element.node.tag_name().name() {
            "sphere" => Shape::Sphere { radius: radius()? },
            "cylinder" => Shape::Cylinder { radius: radius()?, length: length()? },
            "capsule" => Shape::Capsule { radius: radius()?, length: length()? },
            "box" => {
                let text = element.required("size")?;
                match element.numbers("size")? {
                    Some(size) if size.iter().all(|side| *side > 0.0) => Shape::Box { size },
                    _ => {
                        let problem = format!("`{text}`; write 3 lengths in metres above zero");
                        return Err(element.error("size", problem));
                    }
                }
            }
            "mesh" => {
                let url = element.required("filename")?;
                let scale = element.numbers("scale")?.unwrap_or([1.0; 3]);
                if scale.contains(&0.0) {
                    return Err(element.error("scale", "a factor is zero; write 1 for no scale"));
                }
                let path = self.packages.resolve(url, self.directory).map_err(|source| {
                    let file = element.file.to_owned();
                    RobotError::Mesh { file, link: link.to_owned(), source }
                })?;
                Shape::Mesh { path, scale }
            }
            other => {
                let problem =
                    format!("<{other}> is no shape; use mesh, box, cylinder, sphere or capsule");
                return Err(element.error("", problem));
            }
        })
    }

    /// A joint. One that is not whole but connects two links tells nothing of its child's place; whether
    /// that matters, the arm decides.
    fn joint(
        &self,
        mut element: Element<'_, '_>,
        flaws: &mut Vec<Flaw>,
    ) -> Result<ParsedJoint, RobotError> {
        let name = named(&mut element, "joint")?;
        let link =
            |end| Ok::<_, RobotError>(element.required_child(end)?.required("link")?.to_owned());
        let (parent, child) = (link("parent")?, link("child")?);
        let whole = self.motion(&element);
        let motion = whole.unwrap_or_else(|error| {
            flaws.push(Flaw { of: Of::Joint(name.clone()), error });
            Motion::of(declared_kind(&element))
        });
        Ok(ParsedJoint { name, parent, child, motion })
    }

    fn motion(&self, element: &Element<'_, '_>) -> Result<Motion, RobotError> {
        let kind = kind(element)?;
        let mimic = match element.child("mimic")? {
            Some(mimic) => Some((
                mimic.required("joint")?.to_owned(),
                mimic.number("multiplier")?.unwrap_or(1.0),
                mimic.number("offset")?.unwrap_or(0.0),
            )),
            None => None,
        };
        Ok(Motion {
            kind,
            parent_from_child_at_zero: self.origin(element)?,
            axis: axis(element, kind)?,
            limits: limits(element, kind)?,
            most_per_s: most_per_s(element),
            mimic,
        })
    }

    /// The pose in `<origin>`: identity where there is none, as the format says.
    fn origin(
        &self,
        element: &Element<'_, '_>,
    ) -> Result<Transform<frame::Link, frame::Link>, RobotError> {
        let Some(origin) = element.child("origin")? else { return Ok(Transform::identity()) };
        let xyz = Vector3::from(origin.numbers("xyz")?.unwrap_or_default());
        if self.quaternions && origin.node.has_attribute("quat_xyzw") {
            if origin.node.has_attribute("rpy") {
                return Err(origin.error("quat_xyzw", "there is an rpy too; keep one of them"));
            }
            let xyzw = origin.numbers("quat_xyzw")?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
            return Transform::from_xyzw(xyz.into(), xyzw)
                .ok_or_else(|| origin.error("quat_xyzw", "zero; write a unit quaternion"));
        }
        let [roll, pitch, yaw] = origin.numbers("rpy")?.unwrap_or_default();
        let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Ok(Transform::from_isometry(nalgebra::Isometry3::from_parts(
            Translation3::from(xyz),
            rotation,
        )))
    }
}

/// What is wrong with a body.
enum BodyFault {
    /// Its shape is a stand-in without any extent.
    Nothing(RobotError),
    Wrong(RobotError),
}

impl From<RobotError> for BodyFault {
    fn from(error: RobotError) -> Self {
        Self::Wrong(error)
    }
}

/// Whether all lengths of a plain shape are zero: exporters write such for links that nobody sees.
fn has_no_extent(shape: &Element<'_, '_>) -> bool {
    let zero = |name| matches!(shape.number(name), Ok(Some(length)) if length == 0.0);
    match shape.node.tag_name().name() {
        "box" => matches!(shape.numbers("size"), Ok(Some([0.0, 0.0, 0.0]))),
        "sphere" => zero("radius"),
        "cylinder" | "capsule" => zero("radius") && zero("length"),
        _ => false,
    }
}

/// Name of a link or joint; from then on, messages call the element by it.
fn named(element: &mut Element<'_, '_>, what: &str) -> Result<String, RobotError> {
    element.context = format!("<{what}>");
    let name = element.required("name")?.to_owned();
    if name.is_empty() {
        return Err(element.error("name", "empty; give a name"));
    }
    element.context = format!("{what} `{name}`");
    Ok(name)
}

/// The kind of a joint that is not whole. One that may move is taken to move until the arm is known: a
/// chain does not end where its description is wrong.
fn declared_kind(element: &Element<'_, '_>) -> JointKind {
    match element.node.attribute("type") {
        Some("planar" | "floating") => JointKind::Undetermined,
        _ => kind(element).unwrap_or(JointKind::Revolute),
    }
}

fn kind(element: &Element<'_, '_>) -> Result<JointKind, RobotError> {
    Ok(match element.required("type")? {
        "fixed" => JointKind::Fixed,
        "revolute" => JointKind::Revolute,
        "continuous" => JointKind::Continuous,
        "prismatic" => JointKind::Prismatic,
        other => {
            let problem = format!(
                "`{other}` joints are not supported; make it fixed, revolute, continuous or \
                 prismatic, or remove it with the links on one side"
            );
            return Err(element.error("type", problem));
        }
    })
}

/// An axis may be so much longer or shorter than 1: what few digits make of a unit vector.
const AXIS_ROUNDING: f64 = 1e-3;

/// The unit vector in `<axis>`. Whether other programs make one of a longer vector, or move the
/// joint by its length, depends on the program, so that such a robot would be two.
fn axis(element: &Element<'_, '_>, kind: JointKind) -> Result<Unit<Vector3<f64>>, RobotError> {
    let Some(axis) = element.child("axis")? else { return Ok(Vector3::x_axis()) };
    let xyz = Vector3::from(axis.numbers("xyz")?.unwrap_or([1.0, 0.0, 0.0]));
    if kind == JointKind::Fixed {
        return Ok(Vector3::x_axis());
    }
    let length = xyz.norm();
    let Some(unit) = Unit::try_new(xyz, 1e-9) else {
        return Err(axis.error("xyz", "zero; write the direction that the joint moves about"));
    };
    if (length - 1.0).abs() > AXIS_ROUNDING {
        let [x, y, z] = unit.into_inner().into();
        let problem =
            format!("not of length 1 but {length:.4}; write xyz=\"{x:.6} {y:.6} {z:.6}\"");
        return Err(axis.error("xyz", problem));
    }
    Ok(unit)
}

fn limits(element: &Element<'_, '_>, kind: JointKind) -> Result<Option<JointLimits>, RobotError> {
    if !matches!(kind, JointKind::Revolute | JointKind::Prismatic) {
        return Ok(None);
    }
    let Some(limit) = element.child("limit")? else { return Ok(None) };
    match (limit.number("lower")?, limit.number("upper")?) {
        (None, None) => Ok(None),
        (lower, upper) => {
            let (lower, upper) = (lower.unwrap_or(0.0), upper.unwrap_or(0.0));
            if lower > upper {
                let problem = format!("{lower} is above upper {upper}; swap them");
                return Err(limit.error("lower", problem));
            }
            Ok(Some(JointLimits { lower, upper }))
        }
    }
}

/// The limit of the velocity. Calibrations do without it, so that one that is no speed is none.
fn most_per_s(element: &Element<'_, '_>) -> Option<f64> {
    let limit = element.child("limit").ok()??;
    limit.number("velocity").ok()?.filter(|velocity| velocity.is_finite() && *velocity > 0.0)
}

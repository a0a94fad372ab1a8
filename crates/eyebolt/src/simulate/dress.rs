//! Parts on a real arm that its description lacks.

use super::lab::Lab;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use eyebolt_geometry::{Link, Transform};
use eyebolt_render::Random;
use eyebolt_robot::{Body, Prefer, Robot, Shape, link_mesh};
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// What no posture has to keep clear of: it gives way.
pub(super) struct Soft {
    pub(super) link: usize,
    pub(super) body: Body,
}

/// Adds the tool to the end-effector of `robot`.
pub(super) fn add_tool(robot: &mut Robot, end_effector: usize, tool_m: f64) {
    let Some((low, high)) = bounds(robot, end_effector) else { return };
    // Away from the joint that carries it, along the axis that it reaches farthest.
    let middle = nalgebra::center(&low, &high).coords;
    let axis = middle.iamax();
    let mut along = Vector3::zeros();
    along[axis] = if middle[axis] < 0.0 { -1.0 } else { 1.0 };
    let end = middle + along * 0.5 * (high - low)[axis];
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    let part = |at_m: f64, shape: Shape| Body {
        link_from_body: Transform::<Link, Link>::from_parts(end + at_m * along, turn),
        shape,
    };
    let radius = 0.16 * tool_m;
    let shaft = tool_m - 2.0 * radius;
    let size = [0.22 * tool_m, 0.3 * tool_m, shaft];
    let Some(link) = robot.links.get_mut(end_effector) else { return };
    link.visuals.push(part(0.5 * shaft, Shape::Box { size }));
    link.visuals.push(part(tool_m - radius, Shape::Sphere { radius }));
}

/// The cable and the cover on `robot` of `scenario`, if there are to be any.
pub(super) fn soft_parts(scenario: &Scenario<'_>, robot: &Robot) -> Vec<Soft> {
    let Lab { cable, cover, .. } = scenario.faults.lab;
    let random = RandomStream::Dress.of(scenario.seed);
    let joints = scenario.arm.required_joints();
    let moved: Vec<usize> = joints
        .iter()
        .filter_map(|name| Some(robot.joints.get(robot.joint_index(name)?)?.child))
        .collect();
    let mut parts = Vec::new();
    if cable {
        parts.extend(cable_along(robot, &moved, &mut random.at(0)));
    }
    if cover {
        let mut random = random.at(1);
        let link = moved.get(random.index(moved.len())).copied();
        parts.extend(link.and_then(|link| cover_on(robot, link, &mut random)));
    }
    parts
}

/// A cable from each of `links` to the next, along the outside of the link.
fn cable_along(robot: &Robot, links: &[usize], random: &mut Random) -> Vec<Soft> {
    const SHORT_M: f64 = 0.03;
    let radius = random.between(0.004, 0.009);
    let mut parts = Vec::new();
    for pair in links.windows(2) {
        let [link, next] = [pair[0], pair[1]];
        let joint = robot.links[next].parent.map(|(_, joint)| &robot.joints[joint]);
        let Some(joint) = joint.filter(|joint| joint.parent == link) else { continue };
        let along = joint.parent_from_child_at_zero.translation_m();
        let any = Vector3::from_fn(|_, _| random.normal());
        let Some(aside) = along.cross(&any).try_normalize(1e-9) else { continue };
        if along.norm() < SHORT_M {
            continue;
        }
        let mesh = link_mesh(&robot.links[link], Prefer::Visual).ok().flatten();
        let reach = |vertex: &Point3<f32>| vertex.coords.cast::<f64>().dot(&aside);
        let vertices = mesh.iter().flat_map(|mesh| &mesh.vertices);
        let outside = vertices.map(reach).fold(0.0, f64::max) + radius;
        let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 3.2));
        let at = 0.5 * along + outside * aside;
        let shape = Shape::Capsule { radius, length: along.norm() };
        let body = Body { link_from_body: Transform::from_parts(at, turn), shape };
        parts.push(Soft { link, body });
    }
    parts
}

/// A cover about half of a link, a finger's breadth away from it.
fn cover_on(robot: &Robot, link: usize, random: &mut Random) -> Option<Soft> {
    let (low, high) = bounds(robot, link)?;
    let (mut size, mut at) = (high - low, nalgebra::center(&low, &high).coords);
    let longest = size.iamax();
    let shift = random.between(-0.25, 0.25) * size[longest];
    at[longest] += shift;
    size[longest] *= 0.5;
    let loose = random.between(0.008, 0.015);
    let size =
        [0, 1, 2].map(|axis| if axis == longest { size[axis] } else { size[axis] + 2.0 * loose });
    let body = Body {
        link_from_body: Transform::from_parts(at, UnitQuaternion::identity()),
        shape: Shape::Box { size },
    };
    Some(Soft { link, body })
}

/// A box about the shape of a link.
pub(super) fn bounds(robot: &Robot, link: usize) -> Option<(Point3<f64>, Point3<f64>)> {
    let mesh = link_mesh(robot.links.get(link)?, Prefer::Visual).ok().flatten()?;
    mesh.bounds().map(|(low, high)| (low.cast(), high.cast()))
}

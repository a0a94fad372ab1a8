//! Arms that nobody built: for networks that have to know any arm.

use super::error::TrainError;
use eyebolt_render::Random;
use eyebolt_robot::{Arm, PackageRoots, Robot};
use std::fmt::Write;

/// Axes of the joints of usual kinds of arms, stretched upward: `z` along the link, `y` and `x` across.
const AXES: [&str; 9] =
    ["zyzyzyz", "zyyzyz", "zyyyzy", "zyyyz", "zyyzy", "zyyyyz", "zyyxyz", "zzyyz", "zyzyzy"];
const BASE: &str = "base";
const HAND: &str = "hand";

/// An arm of 5 to 7 joints with links and an end-effector of random shapes and proportions.
///
/// # Errors
///
/// None that a seed could cause: shapes and names are in order.
pub fn invented_arm(random: Random) -> Result<Arm, TrainError> {
    let robot = Robot::from_urdf_str(&urdf(random), None, &PackageRoots::new())?;
    Ok(robot.arm(Some(BASE), Some(HAND))?)
}

/// Its description.
pub fn urdf(random: Random) -> String {
    let mut style = random.at(0);
    let axes = AXES[style.index(AXES.len())];
    let count = axes.len();
    let reach = style.between(0.35, 1.3);
    // Slim desktop arms and stout industrial ones.
    let thick = style.between(0.045, 0.085) * reach.max(0.5).powf(0.7);
    let proportions: Vec<f64> = (0..count).map(|_| style.between(0.3, 1.6)).collect();
    let total: f64 = proportions.iter().sum();
    let kind = style.index(4);
    let mut text = String::from("<robot name=\"invented\">\n");
    let foot = [style.between(2.0, 3.4) * thick, style.between(2.0, 3.4) * thick, 0.04];
    let pillar = style.between(0.05, 0.22);
    let foot_shapes =
        cuboid([0.0, 0.0, 0.02], foot) + &cylinder("z", [0.0, 0.0, 0.03], 1.2 * thick, 0.06);
    link(&mut text, BASE, &foot_shapes);
    let (mut parent, mut at) = (BASE.to_owned(), [0.0, 0.0, pillar + style.between(0.0, 0.06)]);
    for (index, axis) in axes.chars().enumerate() {
        let name = format!("link{}", index + 1);
        let mut random = random.at(1).at(index as u64);
        let slimmer = 1.0 - 0.45 * index as f64 / count as f64;
        let length = (reach * proportions[index] / total).max(0.6 * thick);
        let limit = if axis == 'z' { 2.9 } else { random.between(1.6, 2.6) };
        joint(
            &mut text,
            &format!("joint{}", index + 1),
            "revolute",
            (&parent, &name),
            at,
            axis,
            limit,
        );
        let aside = if random.uniform() < 0.4 { random.between(-1.6, 1.6) * thick } else { 0.0 };
        let next = [
            if random.uniform() < 0.2 { random.between(-1.0, 1.0) * thick } else { 0.0 },
            aside,
            length,
        ];
        link(&mut text, &name, &shapes(&mut random, kind, axis, slimmer * thick, next));
        (parent, at) = (name, next);
    }
    hand(&mut text, &mut random.at(2), &parent, at, thick);
    text.push_str("</robot>\n");
    text
}

/// Shapes of a link from its joint at the origin to the next one at `next`.
fn shapes(random: &mut Random, kind: usize, axis: char, thick: f64, next: [f64; 3]) -> String {
    let wide = random.between(1.0, 1.3) * thick;
    let housing = random.between(1.8, 3.0) * thick;
    let along = if axis == 'z' { "z" } else { "y" };
    let mut text = match random.index(4) {
        0 => format!("{}{}", cuboid([0.0; 3], [1.8 * wide, housing, 1.8 * wide]), ""),
        1 => sphere([0.0; 3], 1.1 * wide),
        _ => cylinder(along, [0.0; 3], wide, housing),
    };
    let [x, y, length] = next;
    let middle = [0.5 * x, 0.5 * y, 0.5 * length];
    let span = length + thick;
    match (kind + random.index(2)) % 4 {
        0 => text += &cylinder("z", middle, random.between(0.55, 0.95) * thick, span),
        1 => {
            let size = [random.between(1.0, 1.9) * thick, random.between(1.0, 1.9) * thick, span];
            text += &cuboid(middle, size);
        }
        2 => text += &capsule(middle, random.between(0.6, 1.0) * thick, length),
        _ => {
            // Two plates, or two tubes, side by side.
            let apart = random.between(0.6, 1.0) * thick;
            for side in [-1.0, 1.0] {
                let at = [middle[0], middle[1] + side * apart, middle[2]];
                text += &cuboid(at, [random.between(0.6, 1.4) * thick, 0.4 * thick, span]);
            }
        }
    }
    if y.abs() > 0.3 * thick {
        // From beside one joint to beside the other.
        text += &cylinder("y", [x, 0.5 * y, length], 0.8 * thick, y.abs() + thick);
    }
    for _ in 0..random.index(3) {
        let at = [0, 1].map(|_| random.between(-0.9, 0.9) * thick);
        let at = [at[0], at[1], random.between(0.0, 1.0) * length];
        let size = [0, 1, 2].map(|_| random.between(0.4, 1.6) * thick);
        text += &if random.uniform() < 0.6 {
            cuboid(at, size)
        } else {
            cylinder("x", at, 0.4 * size[0], size[1])
        };
    }
    text
}

/// An end-effector: two fingers, three, a suction cup, a bare flange, a rod with a box.
fn hand(text: &mut String, random: &mut Random, parent: &str, at: [f64; 3], thick: f64) {
    let flange = cylinder("z", [0.0, 0.0, 0.012], random.between(0.5, 0.9) * thick, 0.03);
    let wrist = random.between(0.0, 0.06);
    joint(text, "mount", "fixed", (parent, HAND), [at[0], at[1], at[2] + wrist], 'z', 0.0);
    let [breadth, depth, height] =
        [random.between(0.06, 0.2), random.between(0.03, 0.09), random.between(0.03, 0.12)];
    let palm = cuboid([0.0, 0.0, 0.02 + 0.5 * height], [depth, breadth, height]);
    let kind = random.index(6);
    if kind == 3 {
        let long = random.between(0.04, 0.16);
        let cup = cylinder("z", [0.0, 0.0, long + 0.03], random.between(0.012, 0.04), 0.02);
        return link(
            text,
            HAND,
            &(flange + &cylinder("z", [0.0, 0.0, 0.5 * long + 0.02], 0.012, long) + &cup),
        );
    }
    if kind == 4 {
        return link(text, HAND, &flange);
    }
    if kind == 5 {
        let long = random.between(0.05, 0.2);
        let rod = capsule([0.0, 0.0, 0.5 * long], random.between(0.006, 0.02), long);
        return link(text, HAND, &(flange + &palm + &rod));
    }
    let mut body = flange + &palm;
    if random.uniform() < 0.3 {
        let size = [0, 1, 2].map(|_| random.between(0.02, 0.08));
        body += &cuboid([0.5 * depth + 0.5 * size[0], 0.0, 0.03], size);
    }
    link(text, HAND, &body);
    let (long, wide) = (random.between(0.03, 0.11), random.between(0.01, 0.03));
    let open = (0.5 * breadth - wide).max(0.02);
    for side in [-1.0, 1.0] {
        let name = if side < 0.0 { "finger_left" } else { "finger_right" };
        let shape = cuboid([0.0, 0.0, 0.5 * long], [wide, 0.7 * wide, long])
            + &cuboid([0.0, 0.2 * side * wide, 0.1 * long], [1.4 * wide, 1.2 * wide, 0.3 * long]);
        joint(
            text,
            &format!("{name}_slide"),
            "prismatic",
            (HAND, name),
            [0.0, 0.0, 0.02 + height],
            'y',
            side * open,
        );
        link(text, name, &shape);
    }
}

fn link(text: &mut String, name: &str, shapes: &str) {
    let _ = writeln!(text, "<link name=\"{name}\">{shapes}</link>");
}

/// A joint about `axis`; turning ones go from `-limit` to `limit`, sliding ones from 0 to it.
fn joint(
    text: &mut String,
    name: &str,
    kind: &str,
    (parent, child): (&str, &str),
    [x, y, z]: [f64; 3],
    axis: char,
    limit: f64,
) {
    let along = ['x', 'y', 'z'].map(|other| if other == axis { "1" } else { "0" }).join(" ");
    let (low, high) =
        if kind == "prismatic" { (limit.min(0.0), limit.max(0.0)) } else { (-limit, limit) };
    let _ = writeln!(
        text,
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"{x} {y} {z}\"/><axis xyz=\"{along}\"/>\
         <limit lower=\"{low}\" upper=\"{high}\" effort=\"1\" velocity=\"1\"/></joint>"
    );
}

fn visual([x, y, z]: [f64; 3], rpy: &str, shape: &str) -> String {
    format!(
        "<visual><origin xyz=\"{x} {y} {z}\" rpy=\"{rpy}\"/><geometry>{shape}</geometry></visual>"
    )
}

fn cuboid(at: [f64; 3], [x, y, z]: [f64; 3]) -> String {
    visual(at, "0 0 0", &format!("<box size=\"{x} {y} {z}\"/>"))
}

fn sphere(at: [f64; 3], radius: f64) -> String {
    visual(at, "0 0 0", &format!("<sphere radius=\"{radius}\"/>"))
}

fn cylinder(along: &str, at: [f64; 3], radius: f64, length: f64) -> String {
    let rpy = match along {
        "x" => "0 1.5707963 0",
        "y" => "1.5707963 0 0",
        _ => "0 0 0",
    };
    visual(at, rpy, &format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>"))
}

/// A cylinder with round ends, along z.
fn capsule(at: [f64; 3], radius: f64, length: f64) -> String {
    let [x, y, z] = at;
    let end = |side: f64| sphere([x, y, z + side * 0.5 * length], radius);
    cylinder("z", at, radius, length) + &end(-1.0) + &end(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::actor::Actor;

    #[test]
    fn every_seed_makes_an_arm_that_can_be_posed() {
        for seed in 0..60 {
            let arm = invented_arm(Random::new(seed)).unwrap();
            assert!((5..=7).contains(&arm.required_joints().len()), "{seed}");
            let actor = Actor::of_plain_shapes(arm).unwrap();
            assert!(actor.is_end_effector.iter().any(|is| *is), "{seed}");
            let pose = actor.pose(actor.any_joints(&mut Random::new(seed))).unwrap();
            assert_eq!(pose.base_from_link.len(), actor.meshes.len());
            assert!((0.15..2.5).contains(&actor.reach_m), "{seed}: {}", actor.reach_m);
        }
    }
}

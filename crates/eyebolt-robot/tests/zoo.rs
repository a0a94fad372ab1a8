//! Robots of every kind that people have, made up: each is read, what it has beside its arm is no
//! matter, and base and end-effector are guessed right.
#![allow(clippy::unwrap_used)]

use eyebolt_robot::{JointPositions, PackageRoots, Robot};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::fmt::Write;

/// What the arm stands on.
#[derive(Clone, Copy, Debug)]
enum Stand {
    Table,
    /// A frame `base_link` and below it, turned, what carries its geometry.
    Inertia,
    /// A frame on the floor, `base_link` above it, and wheels.
    Wheels,
    /// On a joint with six degrees of freedom.
    Floating,
    /// On a planar joint.
    Planar,
    /// On links that nobody sees.
    Dummies,
}

/// What the arm ends in.
#[derive(Clone, Copy, Debug)]
enum Hand {
    /// A flange and frames without geometry.
    Bare,
    /// Two fingers that slide, one following the other.
    Sliding,
    /// A jaw that turns.
    Jaw,
    /// Three fingers of two joints each.
    Three,
    /// A finger that follows a joint that is not there.
    Lost,
}

/// What else there is.
#[derive(Clone, Copy, Debug)]
enum Beside {
    Nothing,
    /// A rod that follows the second joint, on link number so much.
    Rod(usize),
    /// A rod on a joint of its own.
    LooseRod(usize),
    /// A camera's head of two joints on the base.
    Head,
    /// A table whose mesh is not there.
    LostTable,
    /// Elements of another program, without their prefix declared.
    Foreign,
    /// A ball on a floating joint.
    Ball,
}

#[derive(Clone, Debug)]
struct Animal {
    stand: Stand,
    joints: usize,
    hand: Hand,
    beside: Beside,
    prefix: &'static str,
}

fn animals() -> impl Strategy<Value = Animal> {
    use Beside as B;
    let stand = prop::sample::select(vec![
        Stand::Table,
        Stand::Inertia,
        Stand::Wheels,
        Stand::Floating,
        Stand::Planar,
        Stand::Dummies,
    ]);
    let hand =
        prop::sample::select(vec![Hand::Bare, Hand::Sliding, Hand::Jaw, Hand::Three, Hand::Lost]);
    let beside = prop_oneof![
        Just(B::Nothing),
        (2..4_usize).prop_map(B::Rod),
        (1..4_usize).prop_map(B::LooseRod),
        Just(B::Head),
        Just(B::LostTable),
        Just(B::Foreign),
        Just(B::Ball),
    ];
    let prefix = prop::sample::select(vec!["", "left_", "ur10e_"]);
    (stand, 6..8_usize, hand, beside, prefix).prop_map(|(stand, joints, hand, beside, prefix)| {
        Animal { stand, joints, hand, beside, prefix }
    })
}

const BOX: &str = r#"<visual><geometry><box size="0.1 0.1 0.2"/></geometry></visual>"#;
const NOTHING: &str = r#"<visual><geometry><box size="0 0 0"/></geometry></visual>"#;
const LOST: &str =
    r#"<visual><geometry><mesh filename="package://lost/a.dae"/></geometry></visual>"#;

struct Urdf(String);

impl Urdf {
    fn link(&mut self, name: &str, inside: &str) -> &mut Self {
        writeln!(self.0, r#"<link name="{name}">{inside}</link>"#).unwrap();
        self
    }

    fn joint(&mut self, kind: &str, parent: &str, child: &str, inside: &str) -> &mut Self {
        writeln!(
            self.0,
            r#"<joint name="{child}_joint" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>"#
        )
        .unwrap();
        self
    }
}

impl Animal {
    /// Its URDF, and what is to be guessed: base and end-effector.
    fn urdf(&self) -> (String, String, String) {
        let Self { stand, joints, hand, beside, prefix } = self;
        let mut urdf = Urdf("<robot name=\"animal\">\n".to_owned());
        let base = format!("{prefix}base_link");
        let (own, foot) = ((base.clone(), BOX), base.clone());
        let (on, (base, shape)) = match stand {
            Stand::Table => (foot, own),
            Stand::Inertia => {
                let turned = r#"<origin rpy="0 0 3.14159"/>"#;
                urdf.link(&base, "").link("inertia", BOX).joint("fixed", &base, "inertia", turned);
                ("inertia".to_owned(), (base, ""))
            }
            Stand::Wheels => {
                urdf.link("footprint", "").joint("fixed", "footprint", &base, "");
                for wheel in ["wheel_left", "wheel_right"] {
                    urdf.link(wheel, BOX).joint("continuous", &base, wheel, "");
                }
                (foot, own)
            }
            Stand::Floating | Stand::Planar => {
                let kind = if matches!(stand, Stand::Planar) { "planar" } else { "floating" };
                urdf.link("world", BOX).joint(kind, "world", &base, "");
                (foot, own)
            }
            Stand::Dummies => {
                urdf.link("root", NOTHING).joint("fixed", "root", &base, "");
                (foot, own)
            }
        };
        if !matches!(stand, Stand::Inertia) {
            urdf.link(&base, shape);
        }
        let mut parent = on.clone();
        for joint in 1..=*joints {
            let link = format!("{prefix}link_{joint}");
            urdf.link(&link, BOX).joint("revolute", &parent, &link, r#"<axis xyz="0 1 0"/>"#);
            parent = link;
        }
        urdf.link("tool0", "").joint("fixed", &parent, "tool0", "");
        let follows = |other: &str| format!(r#"<mimic joint="{other}_joint"/>"#);
        match hand {
            Hand::Bare => {}
            Hand::Sliding => {
                urdf.link("left", BOX).joint("prismatic", &parent, "left", "");
                urdf.link("right", BOX).joint("prismatic", &parent, "right", &follows("left"));
            }
            Hand::Jaw => {
                urdf.link("moving_jaw", BOX).joint("revolute", &parent, "moving_jaw", "");
            }
            Hand::Three => {
                for finger in 0..3 {
                    let (near, far) = (format!("near_{finger}"), format!("far_{finger}"));
                    urdf.link(&near, BOX).joint("revolute", &parent, &near, "");
                    urdf.link(&far, BOX).joint("revolute", &near, &far, "");
                }
            }
            Hand::Lost => {
                urdf.link("grip", BOX).joint("prismatic", &parent, "grip", &follows("nobody"));
            }
        }
        let link = |number: &usize| format!("{prefix}link_{number}");
        match beside {
            Beside::Nothing => {}
            Beside::Rod(at) => {
                let second = follows(&link(&2));
                urdf.link("rod", BOX).joint("revolute", &link(at), "rod", &second);
            }
            Beside::LooseRod(at) => {
                urdf.link("rod", BOX).joint("revolute", &link(at), "rod", "");
            }
            Beside::Head => {
                urdf.link("pan", BOX).joint("revolute", &on, "pan", "");
                urdf.link("tilt", BOX).joint("revolute", "pan", "tilt", "");
            }
            Beside::LostTable => {
                urdf.link("table", LOST).joint("fixed", &on, "table", "");
            }
            Beside::Foreign => urdf.0 += r#"<drake:collision_filter drake:name="a"/><gazebo/>"#,
            Beside::Ball => {
                urdf.link("ball", BOX).joint("floating", &on, "ball", "");
            }
        }
        (urdf.0 + "</robot>", base, parent)
    }

    /// Whether something is wrong with it that the arm does not need.
    fn is_flawed(&self) -> bool {
        matches!(self.stand, Stand::Floating | Stand::Planar | Stand::Dummies)
            || matches!(self.hand, Hand::Lost)
            || matches!(self.beside, Beside::LostTable | Beside::Ball)
    }
}

/// As many animals each time, and the same ones.
fn config() -> ProptestConfig {
    let rng_seed = RngSeed::Fixed(7);
    ProptestConfig { cases: 512, rng_seed, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config())]
    #[test]
    fn every_animal_of_the_zoo_is_known(animal in animals()) {
        let (urdf, base, end_effector) = animal.urdf();
        let robot = Robot::from_urdf_str(&urdf, None, &PackageRoots::new()).unwrap();
        let arm = robot.arm(None, None);
        let arm = arm.map_err(|error| TestCaseError::fail(format!("{error}\n{urdf}")))?;
        prop_assert_eq!(arm.base_name(), base, "{}", urdf);
        prop_assert_eq!(arm.end_effector_name(), end_effector, "{}", urdf);
        prop_assert_eq!(arm.required_joints().len(), animal.joints);
        prop_assert!(arm.guessed().base && arm.guessed().end_effector);
        prop_assert_eq!(!arm.left_out().is_empty(), animal.is_flawed());
        for part in arm.left_out() {
            prop_assert!(part.to_string().contains("robot description"));
        }
        // The joints of the arm place the base and all links of the chain; what nobody recorded is nowhere.
        let names = arm.required_joints().into_iter().map(|name| (name.to_owned(), 0.2));
        let joints: JointPositions = names.collect();
        let known = arm.known_link_poses(&joints).unwrap();
        for (link, pose) in robot.links.iter().zip(&known.base_from_links) {
            if link.name.contains("link_") {
                prop_assert!(pose.is_some(), "{}", link.name);
            }
            if ["left", "moving_jaw", "near_0", "far_0", "grip", "pan", "tilt", "wheel_left", "ball"]
                .contains(&link.name.as_str())
            {
                prop_assert!(pose.is_none(), "{}", link.name);
            }
        }
    }
}

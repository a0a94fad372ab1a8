//! Whether the arm has room.

use super::movable::MovableArm;
use super::scene::{Room, SeenScene};
use eyebolt_registration::Posture;
use nalgebra::Point3;

/// What keeps the arm from being in a posture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blocked {
    /// Links that touch, or nearly.
    Itself,
    /// The table that the base stands on.
    Table,
    /// The camera.
    Camera,
    /// Something that the camera saw, or that hides what is behind it.
    Scene,
    /// Nobody has seen whether there is room.
    Unseen,
}

impl MovableArm {
    /// What keeps the arm from being at `positions` where nothing is about it but, if there is one, the `table` that its
    /// base stands on; `None` if nothing does.
    ///
    /// # Panics
    ///
    /// Unless there are as many positions as joints that are planned.
    pub fn blocked(&self, positions: &[f64], table: bool) -> Option<Blocked> {
        assert_eq!(positions.len(), self.joints().len(), "a position for each joint");
        let around = Surroundings { camera_in_base: None, table, scene: None, seen_only: false };
        let posture = self.posture(positions).expect("every joint has a position");
        around.check(self, &posture).err()
    }
}

/// What is around the arm.
pub(super) struct Surroundings {
    /// Where the camera is, base frame; `None` where nobody knows.
    pub(super) camera_in_base: Option<Point3<f64>>,
    /// Whether the base stands on a table.
    pub(super) table: bool,
    /// What the camera saw.
    pub(super) scene: Option<SeenScene>,
    /// Whether the arm may only be where the camera saw.
    pub(super) seen_only: bool,
}

/// Of the surface of the links that move, what may be where nobody has seen although that is not allowed: what touches the
/// base is behind itself.
const UNSEEN: f64 = 0.03;

impl Surroundings {
    /// What keeps `arm` from being in `posture`, if anything does.
    pub(super) fn check(&self, arm: &MovableArm, posture: &Posture) -> Result<(), Blocked> {
        let body = &arm.body;
        if self.table && body.sinks(posture) {
            return Err(Blocked::Table);
        }
        if self.camera_in_base.is_some_and(|camera| body.is_near(posture, &camera)) {
            return Err(Blocked::Camera);
        }
        if body.touches_itself(posture) {
            return Err(Blocked::Itself);
        }
        match &self.scene {
            Some(scene) => self.check_scene(scene, arm, posture),
            None => Ok(()),
        }
    }

    fn check_scene(
        &self,
        scene: &SeenScene,
        arm: &MovableArm,
        posture: &Posture,
    ) -> Result<(), Blocked> {
        let (mut unseen, mut all) = (0, 0);
        for point in arm_points(arm, posture) {
            all += 1;
            match scene.room(&point) {
                Room::Free => {}
                Room::Unknown => unseen += 1,
                Room::Taken => return Err(Blocked::Scene),
            }
        }
        match self.seen_only && f64::from(unseen) > UNSEEN * f64::from(all) {
            true => Err(Blocked::Unseen),
            false => Ok(()),
        }
    }

    /// Share of the surface of the links that move that is where the camera has not seen; `None` if it has seen nothing.
    pub(super) fn unseen_share(&self, arm: &MovableArm, posture: &Posture) -> Option<f64> {
        let scene = self.scene.as_ref()?;
        let rooms: Vec<Room> = arm_points(arm, posture).map(|point| scene.room(&point)).collect();
        let unseen = rooms.iter().filter(|room| **room != Room::Free).count();
        Some(unseen as f64 / rooms.len().max(1) as f64)
    }
}

/// Points all over the links that move, a clearance apart at most.
fn arm_points<'a>(
    arm: &'a MovableArm,
    posture: &'a Posture,
) -> impl Iterator<Item = Point3<f32>> + 'a {
    const STEP: usize = 3;
    let links = (0..arm.model.links().len()).filter(move |link| arm.moves(*link));
    links.flat_map(move |link| arm.body.link_surface(posture, link).step_by(STEP))
}

//! Things in the scene as triangles in the base frame.

use eyebolt_geometry::Transform;
use eyebolt_robot::{Body, Link, Prefer, Shape, TriangleMesh, link_mesh};
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// A thing that does not move.
#[derive(Clone, Debug)]
pub struct Solid {
    /// What it is, for people.
    pub name: &'static str,
    /// Its surface, base frame.
    pub mesh: TriangleMesh,
}

impl Solid {
    /// A thing of `bodies`, whose poses are in the base frame.
    ///
    /// # Panics
    ///
    /// With a body that is a mesh file, or that has no size.
    pub fn new(name: &'static str, bodies: &[Body]) -> Self {
        let link = Link {
            name: name.to_owned(),
            parent: None,
            visuals: bodies.to_vec(),
            collisions: Vec::new(),
        };
        let mesh = link_mesh(&link, Prefer::Visual);
        let mesh = mesh.ok().flatten().expect("plain shapes have triangles");
        Self { name, mesh }
    }

    /// The same thing, higher by `by_m` metres.
    pub fn raised(mut self, by_m: f64) -> Self {
        // As it was drawn, to the last bit, where nothing is to be done.
        if by_m != 0.0 {
            self.mesh.vertices.iter_mut().for_each(|vertex| vertex.z += by_m as f32);
        }
        self
    }

    /// Corners of the box around it, base frame, metres.
    pub fn bounds(&self) -> (Point3<f32>, Point3<f32>) {
        self.mesh.bounds().expect("plain shapes have vertices")
    }
}

/// `shape` upright, with its middle at `middle_in_base`.
pub(super) fn place(middle_in_base: Vector3<f64>, shape: Shape) -> Body {
    let link_from_body = Transform::from_parts(middle_in_base, UnitQuaternion::identity());
    Body { link_from_body, shape }
}

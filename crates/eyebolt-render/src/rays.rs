//! Rays against the triangles of a scene.

// Lanes side by side are what the compiler turns into vectors.
#![allow(clippy::needless_range_loop)]

mod build;
mod bvh;
mod eye;
mod image;
mod packet;
mod scene;
mod shadow;
mod single;
mod split;
mod traverse;
mod triangles;

pub use scene::{RayScene, SceneMesh};
pub use single::Hit;

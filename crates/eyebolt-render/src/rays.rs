//! Rays against the triangles of a scene.
//!
//! `build` sorts the triangles into a tree of boxes once (`split` says where to cut). `traverse`
//! takes 64 rays of one eye through it at a time, as a pyramid that most boxes are outside of, and
//! `triangles` tries the triangles that remain on eight rays side by side. Images, single rays and
//! shadows differ only in which rays they put into a packet.

// Lanes side by side are what the compiler turns into vectors.
#![allow(clippy::needless_range_loop)]

mod bounds;
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

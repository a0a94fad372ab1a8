//! How fast a depth image of a mesh is made, as one line of JSON.
//!
//! ```sh
//! cargo run --release -p eyebolt-render --example ray_bench -- MESH.stl \
//!     --intrinsics K.npy --extrinsics CAMERA_FROM_BASE.npy [--size 640 480] [--runs 25] \
//!     [--threads 1] [--depth DEPTH.f32]
//! ```
//!
//! The matrices are 3x3 and 4x4 doubles; the depth is written as raw little-endian floats, row by
//! row, metres. `shadow_ms` is how long it takes to say which points of the image are seen from 5 cm
//! beside. Times are medians. `ray_bench.py` beside it compares with Embree in the same run.
#![allow(clippy::print_stdout)]

use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, RayTable, Transform};
use eyebolt_render::{RayScene, SceneMesh};
use eyebolt_robot::{Body, Shape, TriangleMesh, load_body};
use nalgebra::{Matrix4, Point3};
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let option = |name: &str, nth: usize| {
        let at = arguments.iter().position(|argument| argument == name)?;
        arguments.get(at + nth).map(String::as_str)
    };
    let count = |name, nth, otherwise| option(name, nth).map_or(Ok(otherwise), str::parse::<u32>);
    let mesh = load_mesh(arguments.first().ok_or("give a MESH.stl")?)?;
    let k = doubles(option("--intrinsics", 1).ok_or("give --intrinsics K.npy")?)?;
    let pose = doubles(option("--extrinsics", 1).ok_or("give --extrinsics POSE.npy")?)?;
    let [fx, _, cx, _, fy, cy, ..] = k[..] else { return Err("the intrinsics are not 3x3".into()) };
    let (width, height) = (count("--size", 1, 640)?, count("--size", 2, 480)?);
    let camera = PinholeCamera::new(width, height, fx, fy, cx, cy, Distortion::None)?;
    let pose = (pose.len() == 16).then(|| Matrix4::from_row_slice(&pose));
    let camera_from_base: Transform<Camera, Base> = pose
        .and_then(|matrix| Transform::from_matrix(&matrix, 1e-6))
        .ok_or("the extrinsics are not a 4x4 rigid transform")?;
    let base_from_camera = camera_from_base.inverse();

    let threads = count("--threads", 1, 1)? as usize;
    let runs = count("--runs", 1, 25)?;
    let rays = RayTable::new(&camera);
    let mut depth_m = Vec::new();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let [build_ms, depth_ms, shadow_ms] = pool.install(|| {
        let meshes = [SceneMesh { mesh: &mesh, base_from_mesh: Transform::identity() }];
        let scene = RayScene::new(&meshes);
        [
            median_ms(runs.min(5), || drop(RayScene::new(&meshes))),
            median_ms(runs, || scene.depth(&rays, &base_from_camera, &mut depth_m)),
            {
                let point = |(at, z): (usize, &f32)| {
                    let z = if *z > 0.0 { *z } else { f32::NAN };
                    base_from_camera.point(&rays.point(at, z).cast()).cast()
                };
                let points: Vec<Point3<f32>> = depth_m.iter().enumerate().map(point).collect();
                let beside = base_from_camera.point(&Point3::new(0.05, 0.0, 0.0));
                median_ms(runs, || drop(scene.visible_from(beside, &points)))
            },
        ]
    });
    if let Some(path) = option("--depth", 1) {
        let bytes: Vec<u8> = depth_m.iter().flat_map(|z| z.to_le_bytes()).collect();
        std::fs::write(path, bytes)?;
    }
    let (triangles, rays) = (mesh.triangles.len(), depth_m.len());
    println!(
        "{{\"triangles\":{triangles},\"rays\":{rays},\"build_ms\":{build_ms:.3},\
         \"depth_ms\":{depth_ms:.3},\"shadow_ms\":{shadow_ms:.3},\"threads\":{threads}}}"
    );
    Ok(())
}

fn load_mesh(path: &str) -> Result<TriangleMesh, Failure> {
    let shape = Shape::Mesh { path: path.into(), scale: [1.0; 3] };
    Ok(load_body(&Body { link_from_body: Transform::identity(), shape })?)
}

fn median_ms(runs: u32, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..runs.max(1))
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The numbers of an NPY file of little-endian doubles in C order.
fn doubles(path: &str) -> Result<Vec<f64>, Failure> {
    let bytes = std::fs::read(path)?;
    let data = bytes.iter().position(|byte| *byte == b'\n').map(|end| &bytes[end + 1..]);
    let header = String::from_utf8_lossy(&bytes[..bytes.len() - data.map_or(0, <[u8]>::len)]);
    match data {
        Some(data) if header.contains("'<f8'") && header.contains("'fortran_order': False") => {
            Ok(data.chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect())
        }
        _ => Err(format!("{path}: not an NPY file of '<f8' in C order").into()),
    }
}

//! Triangles into a z-buffer.

use eyebolt_geometry::{Camera, DepthImage, Distortion, Link, PinholeCamera, Transform};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// A mesh in its link's frame and where that link is.
#[derive(Clone, Copy, Debug)]
pub struct PosedMesh<'a> {
    /// The mesh, link frame, metres, corners counter-clockwise as seen from outside.
    pub mesh: &'a TriangleMesh,
    /// Pose of the link.
    pub camera_from_link: Transform<Camera, Link>,
    /// What [`Raster::link`] says where this mesh is seen.
    pub link: u8,
}

/// Depth and link of what each pixel sees of some posed meshes.
///
/// The buffers are reused from one drawing to the next.
#[derive(Clone, Debug)]
pub struct Raster {
    width: usize,
    height: usize,
    /// Inverse depth, 1/m; 0 = nothing is seen.
    inverse_depth: Vec<f32>,
    link: Vec<u8>,
    /// First and last column and row (exclusive) that anything was drawn to.
    drawn: [usize; 4],
    vertices: Vec<Projected>,
}

/// A vertex in the image: pixels and inverse depth.
#[derive(Clone, Copy, Debug)]
struct Projected {
    u: f32,
    v: f32,
    inverse_z: f32,
}

impl Projected {
    /// Behind the camera, or where its lens has no image.
    const HIDDEN: Self = Self { u: 0.0, v: 0.0, inverse_z: 0.0 };
}

/// First and last of `limit` integers between the least and the greatest of `corners`, if any.
///
/// Most triangles are smaller than a pixel: this is the hottest code of all, and conversions cost
/// less than calls of `ceil` and `floor`.
fn pixels_between([a, b, c]: [f32; 3], limit: usize) -> Option<(usize, usize)> {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    if !(high >= 0.0 && low < limit as f32) {
        return None;
    }
    let low = low.max(0.0);
    let truncated = low as usize;
    let first = truncated + usize::from((truncated as f32) < low);
    let last = (high as usize).min(limit - 1);
    (first <= last).then_some((first, last))
}

/// One barycentric weight: `at_a + by_u * du + by_v * dv` at an offset from corner `a`.
struct Side {
    by_u: f32,
    by_v: f32,
    at_a: f32,
    inverse: f32,
}

/// A hair of a triangle's size, so that no pixel falls between two neighbours.
const SLACK: f32 = 1e-5;

/// First and last of the columns `u0..=u1` whose pixels in the row at `dv` from corner `a` lie on
/// the positive side of all `sides`.
fn columns(sides: &[Side; 3], dv: f32, a_u: f32, u0: usize, u1: usize) -> Option<(usize, usize)> {
    let (mut low, mut high) = (u0 as f32, u1 as f32);
    for side in sides {
        let here = side.at_a + side.by_v * dv + SLACK;
        if side.by_u == 0.0 {
            if here < 0.0 {
                return None;
            }
            continue;
        }
        let column = a_u - here * side.inverse;
        if side.by_u > 0.0 {
            low = low.max(column);
        } else {
            high = high.min(column);
        }
    }
    if low > high {
        return None;
    }
    let truncated = low as usize;
    let first = truncated + usize::from((truncated as f32) < low);
    let last = high as usize;
    (first <= last).then_some((first, last))
}

/// Surfaces nearer than this to the camera's centre are not drawn, metres.
const NEAR_M: f64 = 0.02;

impl Raster {
    /// An empty raster for images of `camera`.
    pub fn new(camera: &PinholeCamera) -> Self {
        let count = camera.pixel_count();
        Self {
            width: camera.width() as usize,
            height: camera.height() as usize,
            inverse_depth: vec![0.0; count],
            link: vec![0; count],
            drawn: [0; 4],
            vertices: Vec::new(),
        }
    }

    /// Clears the raster and draws `meshes` as `camera` sees them. Triangles seen from behind are
    /// not drawn.
    ///
    /// `camera` must have the size of the one the raster was made for; edges are drawn straight,
    /// which a lens with distortion bends by less than the triangles are small.
    pub fn draw(&mut self, camera: &PinholeCamera, meshes: &[PosedMesh<'_>]) {
        debug_assert_eq!(camera.pixel_count(), self.inverse_depth.len());
        self.clear();
        for posed in meshes {
            self.project(camera, posed);
            for triangle in &posed.mesh.triangles {
                let [a, b, c] = triangle.map(|i| self.vertices[i as usize]);
                if a.inverse_z > 0.0 && b.inverse_z > 0.0 && c.inverse_z > 0.0 {
                    self.fill([a, b, c], posed.link);
                }
            }
        }
    }

    fn clear(&mut self) {
        let [u0, u1, v0, v1] = self.drawn;
        for v in v0..v1 {
            let row = v * self.width;
            self.inverse_depth[row + u0..row + u1].fill(0.0);
        }
        self.drawn = [self.width, 0, self.height, 0];
    }

    fn project(&mut self, camera: &PinholeCamera, posed: &PosedMesh<'_>) {
        let isometry = posed.camera_from_link.isometry();
        let rotation: Matrix3<f64> = isometry.rotation.to_rotation_matrix().into_inner();
        let translation: Vector3<f64> = isometry.translation.vector;
        let straight = *camera.distortion() == Distortion::None;
        let [fx, fy, cx, cy] = [camera.fx(), camera.fy(), camera.cx(), camera.cy()];
        self.vertices.clear();
        self.vertices.extend(posed.mesh.vertices.iter().map(|vertex| {
            let p = rotation * vertex.coords.cast::<f64>() + translation;
            if p.z <= NEAR_M {
                return Projected::HIDDEN;
            }
            let inverse_z = 1.0 / p.z;
            let pixel = if straight {
                Some(Point2::new(fx * p.x * inverse_z + cx, fy * p.y * inverse_z + cy))
            } else {
                camera.project(&Point3::from(p))
            };
            pixel.map_or(Projected::HIDDEN, |pixel| Projected {
                u: pixel.x as f32,
                v: pixel.y as f32,
                inverse_z: inverse_z as f32,
            })
        }));
    }

    fn fill(&mut self, [a, b, c]: [Projected; 3], link: u8) {
        let area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
        // With v down the image, counter-clockwise corners have a negative area.
        if !(area < 0.0 && area.is_finite()) {
            return;
        }
        let Some((u0, u1)) = pixels_between([a.u, b.u, c.u], self.width) else { return };
        let Some((v0, v1)) = pixels_between([a.v, b.v, c.v], self.height) else { return };
        // Barycentric weights and inverse depth are affine in the pixel: along a row each weight
        // is positive on one side of a column, and the triangle lies between these columns.
        let scale = 1.0 / area;
        let (wb_u, wb_v) = ((c.v - a.v) * scale, -(c.u - a.u) * scale);
        let (wc_u, wc_v) = (-(b.v - a.v) * scale, (b.u - a.u) * scale);
        let sides = [(wb_u, wb_v, 0.0), (wc_u, wc_v, 0.0), (-wb_u - wc_u, -wb_v - wc_v, 1.0)]
            .map(|(by_u, by_v, at_a)| Side { by_u, by_v, at_a, inverse: 1.0 / by_u });
        let (db, dc) = (b.inverse_z - a.inverse_z, c.inverse_z - a.inverse_z);
        let (z_u, z_v) = (wb_u * db + wc_u * dc, wb_v * db + wc_v * dc);
        for v in v0..=v1 {
            let dv = v as f32 - a.v;
            let Some((first, last)) = columns(&sides, dv, a.u, u0, u1) else { continue };
            let row = v * self.width;
            let depths = self.inverse_depth[row + first..row + last + 1].iter_mut();
            let links = self.link[row + first..row + last + 1].iter_mut();
            let start = a.inverse_z + z_v * dv + z_u * (first as f32 - a.u);
            for (u, (depth, seen)) in depths.zip(links).enumerate() {
                let inverse_z = start + z_u * u as f32;
                if inverse_z > *depth {
                    *depth = inverse_z;
                    *seen = link;
                }
            }
        }
        let [du0, du1, dv0, dv1] = &mut self.drawn;
        (*du0, *du1) = ((*du0).min(u0), (*du1).max(u1 + 1));
        (*dv0, *dv1) = ((*dv0).min(v0), (*dv1).max(v1 + 1));
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Inverse depth of every pixel, row by row, 1/m; 0 where nothing is seen.
    pub fn inverse_depth(&self) -> &[f32] {
        &self.inverse_depth
    }

    /// Depth at row-major pixel `index`, metres; `None` where nothing is seen.
    pub fn depth_m(&self, index: usize) -> Option<f32> {
        let inverse = self.inverse_depth[index];
        (inverse > 0.0).then(|| 1.0 / inverse)
    }

    /// The link seen at row-major pixel `index`; `None` where nothing is seen.
    pub fn link(&self, index: usize) -> Option<u8> {
        (self.inverse_depth[index] > 0.0).then(|| self.link[index])
    }

    /// Columns and rows that anything was drawn to, ends exclusive.
    pub fn drawn(&self) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        let [u0, u1, v0, v1] = self.drawn;
        (u0..u1.max(u0), v0..v1.max(v0))
    }

    /// Row-major pixels where something is seen.
    pub fn pixels(&self) -> impl Iterator<Item = usize> + '_ {
        let (columns, rows) = self.drawn();
        rows.flat_map(move |v| {
            let row = v * self.width;
            columns.clone().map(move |u| row + u)
        })
        .filter(|at| self.inverse_depth[*at] > 0.0)
    }

    /// The depth image, 0 where nothing is seen.
    pub fn to_depth_image(&self) -> DepthImage {
        let depth = |inverse: &f32| if *inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        let depth_m = self.inverse_depth.iter().map(depth).collect();
        DepthImage::new(self.width as u32, self.height as u32, depth_m)
            .expect("a raster has as many pixels as its camera")
    }
}

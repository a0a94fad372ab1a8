//! What a ray hits, by trying every triangle (Moeller and Trumbore, 1997).

use crate::scene::Object;
use eyebolt_geometry::PinholeCamera;
use nalgebra::{Point2, Vector3};

/// What each pixel sees: depth in metres and link.
pub type Seen = Vec<Option<(f64, u8)>>;

struct Facet {
    corners: [Vector3<f64>; 3],
    link: u8,
}

/// Every ray against every triangle that lies before the camera and faces it.
pub fn cast_all(camera: &PinholeCamera, objects: &[Object]) -> Seen {
    let facets: Vec<Facet> = objects.iter().flat_map(facets).collect();
    let (width, height) = (camera.width(), camera.height());
    let pixels = (0..height).flat_map(|v| (0..width).map(move |u| (u, v)));
    pixels
        .map(|(u, v)| {
            let ray = camera.ray(&Point2::new(f64::from(u), f64::from(v)))?;
            let hits = facets.iter().filter_map(|f| hit(&ray, &f.corners).map(|z| (z, f.link)));
            hits.min_by(|a, b| a.0.total_cmp(&b.0))
        })
        .collect()
}

fn facets(object: &Object) -> impl Iterator<Item = Facet> + '_ {
    let corner = |i: u32| {
        let vertex = object.mesh.vertices[i as usize].cast();
        object.camera_from_link.point(&vertex).coords
    };
    let corners = object.mesh.triangles.iter().map(move |t| t.map(corner));
    corners
        .filter(|corners| corners.iter().all(|c| c.z > 0.02))
        .map(|corners| Facet { corners, link: object.link })
}

/// How far along `ray` from the origin the front of the triangle is hit.
fn hit(ray: &Vector3<f64>, [a, b, c]: &[Vector3<f64>; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.cross(&ac);
    let determinant = ab.dot(&p);
    if determinant <= 0.0 {
        return None;
    }
    let u = -a.dot(&p) / determinant;
    let q = (-a).cross(&ab);
    let v = ray.dot(&q) / determinant;
    let t = ac.dot(&q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Whether all pixels next to `(u, v)`, itself included, see the same link or nothing.
pub fn away_from_edges(seen: &Seen, width: usize, u: usize, v: usize) -> bool {
    let link = |u: usize, v: usize| seen[v * width + u].map(|(_, link)| link);
    let height = seen.len() / width;
    let (columns, rows) =
        (u.saturating_sub(1)..width.min(u + 2), v.saturating_sub(1)..height.min(v + 2));
    rows.flat_map(|v| columns.clone().map(move |u| (u, v))).all(|(i, j)| link(i, j) == link(u, v))
}

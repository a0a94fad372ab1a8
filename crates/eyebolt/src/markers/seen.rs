//! One marker in several pictures of a scene at rest.

use eyebolt_markers::{Correspondence, NotSeen, Sighting};
use nalgebra::{Point2, Vector2};
use std::collections::{BTreeMap, BTreeSet};

/// What several pictures of the same scene show together: the mean of where each point is seen, of those
/// that at least half of the pictures with the marker show.
///
/// # Errors
///
/// What the first picture has, if none shows the marker.
pub(super) fn together(all: &[Result<Sighting, NotSeen>]) -> Result<Sighting, NotSeen> {
    let seen: Vec<&Sighting> = all.iter().filter_map(|one| one.as_ref().ok()).collect();
    if seen.is_empty() {
        let first = all.iter().find_map(|one| one.as_ref().err());
        return Err(first.cloned().unwrap_or(NotSeen::None));
    }
    // Points of a target are the same numbers in every picture.
    let mut points: BTreeMap<[u64; 3], Vec<&Correspondence>> = BTreeMap::new();
    for point in seen.iter().flat_map(|sighting| &sighting.points) {
        let at: [f64; 3] = point.point_in_marker.coords.into();
        points.entry(at.map(f64::to_bits)).or_default().push(point);
    }
    let often = points.values().filter(|views| 2 * views.len() >= seen.len());
    let points = often.filter_map(|views| {
        let sum: Vector2<f64> = views.iter().map(|view| view.pixel.coords).sum();
        let first = views.first()?;
        Some(Correspondence { pixel: Point2::from(sum / views.len() as f64), ..**first })
    });
    let ids: BTreeSet<u32> = seen.iter().flat_map(|sighting| &sighting.ids).copied().collect();
    Ok(Sighting { ids: ids.into_iter().collect(), points: points.collect() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    fn point(x: f64, u: f64) -> Correspondence {
        Correspondence { point_in_marker: Point3::new(x, 0.0, 0.0), pixel: Point2::new(u, 1.0) }
    }

    #[test]
    fn points_are_averaged_and_rare_ones_left_out() {
        let sighting =
            |points: &[Correspondence]| Ok(Sighting { ids: vec![3], points: points.to_vec() });
        let all = [
            sighting(&[point(0.0, 10.0), point(1.0, 20.0), point(2.0, 0.0)]),
            Err(NotSeen::None),
            sighting(&[point(0.0, 11.0), point(1.0, 20.0)]),
            sighting(&[point(0.0, 12.0)]),
        ];
        let seen = together(&all).unwrap();
        assert_eq!(seen.points, [point(0.0, 11.0), point(1.0, 20.0)]);
        assert_eq!(seen.ids, [3]);
        let none = together(&[Err(NotSeen::Twice { id: 4 }), Err(NotSeen::None)]);
        assert_eq!(none, Err(NotSeen::Twice { id: 4 }));
        assert_eq!(together(&[]), Err(NotSeen::None));
    }
}

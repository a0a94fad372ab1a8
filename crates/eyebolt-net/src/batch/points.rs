//! Batches of points, sampled level after level.

use super::prepared::{Batch, Map, features_for};
use crate::graph::{Domain, Graph, MapSpec, Source};
use crate::random::Random;
use crate::row_map::{RowMap, Runs};
use crate::sampling::{ball_query, farthest_points, three_nearest, uniform_points_by};
use crate::{Error, Matrix};
use std::collections::BTreeMap;
use std::sync::Arc;

/// How samples are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Each the farthest from those before it.
    Farthest,
    /// Without preference, by this seed: in every item, by its place in the batch, and at every
    /// level other ones.
    Uniform(u64),
}

/// The largest coordinate: squares of distances stay within 32 bits.
const FARTHEST: f32 = 1e9;

/// Points that are there at a level, item after item.
struct Level {
    points: Vec<[f32; 3]>,
    starts: Vec<usize>,
}

impl Level {
    fn items(&self) -> impl Iterator<Item = (usize, &[[f32; 3]])> {
        self.starts.windows(2).map(|pair| (pair[0], &self.points[pair[0]..pair[1]]))
    }

    /// Samples of these points, `level` times sampled before.
    fn sampled(&self, level: u64, count: usize, sampling: Sampling) -> Self {
        let mut points = Vec::new();
        let mut starts = vec![0];
        for (place, (_, item)) in (0..).zip(self.items()) {
            let chosen = match sampling {
                Sampling::Farthest => farthest_points(item, count),
                // One stream for all would take points of the same places from items alike in
                // size, and tie the samples of a level to those of the one below.
                Sampling::Uniform(seed) => {
                    let random = Random::new(seed).at(level).at(place);
                    uniform_points_by(random, item.len(), count)
                }
            };
            points.extend(chosen.into_iter().map(|at| item[at as usize]));
            starts.push(points.len());
        }
        Self { points, starts }
    }
}

impl Batch {
    /// For a graph that samples points: points of all items one after the other (in the units of
    /// the graph's radii), how many each item has, and their features, one row each.
    ///
    /// # Errors
    /// If there are no items or an item has no point, a value is not finite, there are not as many
    /// features as the graph takes, or it is a graph on voxels.
    pub fn from_points(
        graph: &Graph,
        points: &[[f32; 3]],
        item_sizes: &[usize],
        features: &Matrix,
        sampling: Sampling,
    ) -> Result<Self, Error> {
        let levels = levels(graph, points, item_sizes, features, sampling)?;
        let rows = graph.domains().iter().map(|&domain| rows(graph, &levels, domain));
        let rows = rows.collect::<Result<_, Error>>()?;
        let mut groups = Groups::new();
        for &spec in graph.maps() {
            if let MapSpec::Group { level, scale } = spec {
                groups.insert((level, scale), group(graph, &levels, level, scale)?);
            }
        }
        let maps = graph.maps().iter().map(|&spec| map(graph, &levels, &groups, spec));
        let maps = maps.collect::<Result<_, Error>>()?;
        let inputs = graph.inputs().map(|(_, node, source)| match source {
            Source::Features => features_for(graph, node, Domain::Points, features),
            Source::Offsets { level, scale } => offsets(graph, &levels, &groups, level, scale),
            Source::Positions { level } => positions(at(&levels, level)?),
        });
        let inputs = inputs.collect::<Result<_, Error>>()?;
        Ok(Self::new(graph, rows, maps, inputs))
    }
}

fn levels(
    graph: &Graph,
    points: &[[f32; 3]],
    item_sizes: &[usize],
    features: &Matrix,
    sampling: Sampling,
) -> Result<Vec<Level>, Error> {
    if item_sizes.is_empty() || item_sizes.contains(&0) {
        return Err(Error::input("points", "an item without a point, or no item"));
    }
    let total = item_sizes.iter().try_fold(0_usize, |sum, &size| sum.checked_add(size));
    if total != Some(points.len()) || features.rows() != points.len() {
        let problem = format!("{}, not as many as items and features say", points.len());
        return Err(Error::input("points", problem));
    }
    features.check_finite("features")?;
    let good = |point: &[f32; 3]| point.iter().all(|value| value.abs() <= FARTHEST);
    if let Some(row) = points.iter().position(|point| !good(point)) {
        let problem = format!(
            "row {row} is {:?}: not finite, or beyond {FARTHEST}; drop such points",
            points[row]
        );
        return Err(Error::input("points", problem));
    }
    let mut starts = vec![0];
    item_sizes.iter().for_each(|size| starts.push(starts[starts.len() - 1] + size));
    let mut levels = vec![Level { points: points.to_vec(), starts }];
    for (level, spec) in (0..).zip(graph.sampling()) {
        let sampled = levels[levels.len() - 1].sampled(level, spec.samples, sampling);
        levels.push(sampled);
    }
    Ok(levels)
}

fn foreign(what: &dyn std::fmt::Debug) -> Error {
    Error::network("graph", format!("{what:?} is not of sampled points; use Batch::from_voxels"))
}

fn at(levels: &[Level], level: u32) -> Result<&Level, Error> {
    levels.get(level as usize).ok_or_else(|| foreign(&Domain::Samples { level }))
}

fn neighbours(graph: &Graph, level: u32, scale: u32) -> Result<(f32, usize), Error> {
    let spec = (level as usize).checked_sub(1).and_then(|level| graph.sampling().get(level));
    let scale_spec = spec.and_then(|spec| spec.scales.get(scale as usize));
    let scale_spec = scale_spec.ok_or_else(|| foreign(&Domain::Groups { level, scale }))?;
    Ok((scale_spec.radius, scale_spec.neighbours))
}

fn rows(graph: &Graph, levels: &[Level], domain: Domain) -> Result<usize, Error> {
    Ok(match domain {
        Domain::Points => levels[0].points.len(),
        Domain::Items => levels[0].starts.len() - 1,
        Domain::Samples { level } => at(levels, level)?.points.len(),
        Domain::Groups { level, scale } => {
            at(levels, level)?.points.len() * neighbours(graph, level, scale)?.1
        }
        Domain::Voxels { .. } => return Err(foreign(&domain)),
    })
}

/// Rows of the level below that are the neighbours of each sample, by level and scale.
type Groups = BTreeMap<(u32, u32), Vec<u32>>;

fn group(graph: &Graph, levels: &[Level], level: u32, scale: u32) -> Result<Vec<u32>, Error> {
    let (radius, count) = neighbours(graph, level, scale)?;
    let (below, here) = (at(levels, level - 1)?, at(levels, level)?);
    let items = below.items().zip(here.items());
    let lists = items.flat_map(|((start, points), (_, centres))| {
        let found = ball_query(points, centres, radius, count);
        found.into_iter().map(move |row| row + start as u32)
    });
    Ok(lists.collect())
}

fn offsets(
    graph: &Graph,
    levels: &[Level],
    groups: &Groups,
    level: u32,
    scale: u32,
) -> Result<Matrix, Error> {
    let none = || foreign(&Source::Offsets { level, scale });
    let rows = groups.get(&(level, scale)).ok_or_else(none)?;
    let count = neighbours(graph, level, scale)?.1;
    let (below, here) = (at(levels, level - 1)?, at(levels, level)?);
    let values = rows.iter().enumerate().flat_map(|(place, &row)| {
        let (point, centre) = (below.points[row as usize], here.points[place / count]);
        [0, 1, 2].map(|axis| point[axis] - centre[axis])
    });
    Matrix::new(rows.len(), 3, values.collect())
}

fn positions(level: &Level) -> Result<Matrix, Error> {
    Matrix::new(level.points.len(), 3, level.points.iter().flatten().copied().collect())
}

fn map(graph: &Graph, levels: &[Level], groups: &Groups, spec: MapSpec) -> Result<Map, Error> {
    let starts = |domain| match domain {
        Domain::Points => Ok(&levels[0].starts),
        Domain::Samples { level } => Ok(&at(levels, level)?.starts),
        _ => Err(foreign(&domain)),
    };
    let runs = |domain| {
        let starts: &Vec<usize> = starts(domain)?;
        Ok::<_, Error>(Runs::new(starts.iter().map(|&start| start as u32).collect()))
    };
    Ok(match spec {
        MapSpec::Maxima(domain) => Map::Runs(Arc::new(runs(domain)?)),
        MapSpec::Means(domain) => Map::Rows(Arc::new(RowMap::means(&runs(domain)?))),
        MapSpec::Group { level, scale } => {
            let inputs = at(levels, level - 1)?.points.len();
            Map::Rows(Arc::new(RowMap::gather(inputs, groups[&(level, scale)].clone())))
        }
        MapSpec::Neighbours { level, scale } => {
            let (count, samples) = (neighbours(graph, level, scale)?.1, at(levels, level)?);
            let starts = (0..=samples.points.len()).map(|sample| (sample * count) as u32);
            Map::Runs(Arc::new(Runs::new(starts.collect())))
        }
        MapSpec::Interpolate { level } => {
            Map::Rows(Arc::new(interpolation(at(levels, level)?, at(levels, level - 1)?)))
        }
        MapSpec::Kernel(_) | MapSpec::Slice => return Err(foreign(&spec)),
    })
}

fn interpolation(from: &Level, to: &Level) -> RowMap {
    let (mut rows, mut weights) = (Vec::new(), Vec::new());
    for ((start, sources), (_, targets)) in from.items().zip(to.items()) {
        for (nearest, shares) in three_nearest(sources, targets) {
            rows.extend(nearest.map(|row| row + start as u32));
            weights.extend(shares);
        }
    }
    let starts = (0..=to.points.len()).map(|target| 3 * target as u32).collect();
    RowMap::new(from.points.len(), starts, rows, weights)
}

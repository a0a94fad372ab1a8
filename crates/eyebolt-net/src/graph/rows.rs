//! Operations that lead from rows of one kind to rows of another, by the names of the field.

use super::builder::GraphBuilder;
use super::domain::{Domain, MapSpec, Source};
use super::ids::NodeId;
use super::op::Op;
use crate::Error;

impl GraphBuilder {
    /// Mean of all rows of each item.
    ///
    /// # Errors
    /// If `input` is of items already, or of neighbours.
    #[doc(alias = "MinkowskiGlobalAvgPooling")]
    #[doc(alias = "MinkowskiGlobalPooling")]
    pub fn global_average_pool(&mut self, name: &str, input: NodeId) -> Result<NodeId, Error> {
        self.combine(name, input, MapSpec::Means(self.domain_of(input)))
    }

    /// Maximum of all rows of each item, channel by channel.
    ///
    /// # Errors
    /// If `input` is of items already, or of neighbours.
    #[doc(alias = "MinkowskiGlobalMaxPooling")]
    pub fn global_max_pool(&mut self, name: &str, input: NodeId) -> Result<NodeId, Error> {
        self.max_pool(name, input, MapSpec::Maxima(self.domain_of(input)))
    }

    /// From voxels back to points: each point has the value of its voxel.
    ///
    /// # Errors
    /// If `input` is not of the finest voxels.
    #[doc(alias = "devoxelize")]
    pub fn slice(&mut self, name: &str, input: NodeId) -> Result<NodeId, Error> {
        self.combine(name, input, MapSpec::Slice)
    }

    /// Values of the neighbours of each sample of the level above `input`'s, within one of that
    /// level's radii.
    ///
    /// # Errors
    /// If `input` is not of points or samples, or the graph's sampling has no such level or scale.
    #[doc(alias = "ball query")]
    pub fn group(&mut self, name: &str, input: NodeId, scale: u32) -> Result<NodeId, Error> {
        let level = self.level_of(name, input)?.saturating_add(1);
        self.expect_scale(name, level, scale)?;
        self.combine(name, input, MapSpec::Group { level, scale })
    }

    /// Where the neighbours of [`GraphBuilder::group`] are, seen from their sample; an input.
    pub fn offsets(&mut self, level: u32, scale: u32) -> NodeId {
        self.input(Source::Offsets { level, scale }, Domain::Groups { level, scale }, 3)
    }

    /// Where the samples of a level are; an input. Level 0 are the points.
    #[doc(alias = "xyz")]
    pub fn positions(&mut self, level: u32) -> NodeId {
        self.input(Source::Positions { level }, Domain::samples(level), 3)
    }

    /// Maximum over the neighbours of each sample, channel by channel.
    ///
    /// # Errors
    /// If `input` is not of neighbours.
    pub fn group_max_pool(&mut self, name: &str, input: NodeId) -> Result<NodeId, Error> {
        let Domain::Groups { level, scale } = self.domain_of(input) else {
            let found = self.domain_of(input);
            return Err(Error::network(
                name,
                format!("needs a value of neighbours, not {found:?}"),
            ));
        };
        self.max_pool(name, input, MapSpec::Neighbours { level, scale })
    }

    /// From samples to those of the level below, or to the points: each has the mean of its three
    /// nearest samples, by inverse squared distance.
    ///
    /// # Errors
    /// If `input` is not of samples.
    #[doc(alias = "three_nn")]
    #[doc(alias = "three_interpolate")]
    pub fn interpolate(&mut self, name: &str, input: NodeId) -> Result<NodeId, Error> {
        let level = self.level_of(name, input)?;
        self.combine(name, input, MapSpec::Interpolate { level })
    }

    /// Rows of the domain that a map leads to, as weighted sums; what [`GraphBuilder::slice`] and
    /// others are made of.
    ///
    /// # Errors
    /// If the input's rows are not those that the map comes from.
    pub fn combine(&mut self, name: &str, input: NodeId, map: MapSpec) -> Result<NodeId, Error> {
        if has_runs(map) {
            return Err(Error::network(name, format!("{map:?} has no weights")));
        }
        let (from, to) = ends(name, map)?;
        self.expect_domain(name, input, from)?;
        let (map, domain, channels) = (self.map(map), self.domain(to), self.channels(input));
        Ok(self.push(name, Op::Combine { map }, vec![input], channels, domain))
    }

    /// Maximum over the runs of a map; what [`GraphBuilder::global_max_pool`] and
    /// [`GraphBuilder::group_max_pool`] are made of.
    ///
    /// # Errors
    /// If the map has no runs, or the input's rows are not those that it comes from.
    pub fn max_pool(&mut self, name: &str, input: NodeId, map: MapSpec) -> Result<NodeId, Error> {
        if !has_runs(map) {
            return Err(Error::network(name, format!("cannot pool over {map:?}")));
        }
        let (from, to) = ends(name, map)?;
        self.expect_domain(name, input, from)?;
        let (map, domain, channels) = (self.map(map), self.domain(to), self.channels(input));
        Ok(self.push(name, Op::MaxPool { map }, vec![input], channels, domain))
    }

    fn domain_of(&self, node: NodeId) -> Domain {
        self.graph.domains[self.node(node).domain]
    }

    /// How often the points of a value were sampled.
    fn level_of(&self, name: &str, input: NodeId) -> Result<u32, Error> {
        match self.domain_of(input) {
            Domain::Points => Ok(0),
            Domain::Samples { level } => Ok(level),
            other => {
                Err(Error::network(name, format!("needs a value of samples, not of {other:?}")))
            }
        }
    }

    fn expect_scale(&self, name: &str, level: u32, scale: u32) -> Result<(), Error> {
        let spec = (level as usize).checked_sub(1).and_then(|at| self.graph.sampling.get(at));
        match spec.and_then(|spec| spec.scales.get(scale as usize)) {
            Some(_) => Ok(()),
            None => {
                let problem = format!("no scale {scale} at level {level} of with_sampling");
                Err(Error::network(name, problem))
            }
        }
    }
}

/// Whether a map is of runs of rows, rather than of weighted rows.
fn has_runs(map: MapSpec) -> bool {
    matches!(map, MapSpec::Maxima(_) | MapSpec::Neighbours { .. })
}

/// Where a map comes from and leads to.
fn ends(name: &str, map: MapSpec) -> Result<(Domain, Domain), Error> {
    Ok(match map {
        MapSpec::Slice => (Domain::Voxels { stride: 1 }, Domain::Points),
        MapSpec::Maxima(domain) | MapSpec::Means(domain)
            if !matches!(domain, Domain::Items | Domain::Groups { .. }) =>
        {
            (domain, Domain::Items)
        }
        MapSpec::Group { level, scale } if level > 0 => {
            (Domain::samples(level - 1), Domain::Groups { level, scale })
        }
        MapSpec::Neighbours { level, scale } => {
            (Domain::Groups { level, scale }, Domain::samples(level))
        }
        MapSpec::Interpolate { level } if level > 0 => {
            (Domain::samples(level), Domain::samples(level - 1))
        }
        _ => return Err(Error::network(name, format!("{map:?} is not a map between rows"))),
    })
}

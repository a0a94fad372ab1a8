//! What a graph is made of, by place.

/// An operation of a graph, by its place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) usize);

impl NodeId {
    /// Its place in the graph's list.
    pub fn index(self) -> usize {
        self.0
    }
}

/// A parameter of a graph, by its place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ParameterId(pub(crate) usize);

impl ParameterId {
    /// Its place in the graph's list.
    pub fn index(self) -> usize {
        self.0
    }
}

/// A map of a graph, by its place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MapId(pub(crate) usize);

impl MapId {
    /// Its place in the graph's list.
    pub fn index(self) -> usize {
        self.0
    }
}

//! The tree of boxes that rays are sorted into, as it lies in memory.

/// Boxes of a node, triangles of a leaf, rays of a row: what one AVX register holds.
pub(super) const LANES: usize = 8;

/// One number of each lane.
pub(super) type Lanes = [f32; LANES];

/// The boxes of up to eight children.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(super) struct Node {
    /// Least x, y, z and greatest x, y, z of each child. Lanes without a child are inside out.
    pub bounds: [Lanes; 6],
    /// What is in each box.
    pub children: [Child; LANES],
}

/// Index of a node or, with the highest bit set, of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Child(u32);

const LEAF: u32 = 1 << 31;

impl Child {
    pub fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub fn leaf(index: usize) -> Self {
        Self(index as u32 | LEAF)
    }

    /// `Ok` with the index of a node, `Err` with that of a leaf.
    pub fn index(self) -> Result<usize, usize> {
        let index = (self.0 & !LEAF) as usize;
        if self.0 & LEAF == 0 { Ok(index) } else { Err(index) }
    }
}

/// Up to eight triangles.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(super) struct Leaf {
    /// `corners[corner][axis][lane]`; lanes without a triangle are NaN, which no ray hits.
    pub corners: [[Lanes; 3]; 3],
}

/// All boxes and triangles, in units and axes of the scene.
#[derive(Clone, Debug, Default)]
pub(super) struct Bvh {
    /// The root is the first; none in an empty scene.
    pub nodes: Vec<Node>,
    pub leaves: Vec<Leaf>,
    /// Which triangle lies in each lane of each leaf: index in what the tree was built from.
    pub triangles: Vec<[u32; LANES]>,
}

impl Node {
    pub const EMPTY: Self = Self {
        bounds: [
            [f32::INFINITY; LANES],
            [f32::INFINITY; LANES],
            [f32::INFINITY; LANES],
            [f32::NEG_INFINITY; LANES],
            [f32::NEG_INFINITY; LANES],
            [f32::NEG_INFINITY; LANES],
        ],
        children: [Child(0); LANES],
    };
}

impl Leaf {
    pub const EMPTY: Self = Self { corners: [[[f32::NAN; LANES]; 3]; 3] };
}

//! Triangles and the boxes around them.

/// Corners of a triangle, units and axes of the scene.
pub(super) type Corners = [[f32; 3]; 3];

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl Bounds {
    /// Around nothing.
    pub const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Around a triangle.
    pub fn of_triangle(corners: &Corners) -> Self {
        let point = |corner: &[f32; 3]| Self { low: *corner, high: *corner };
        corners.iter().map(point).fold(Self::EMPTY, Self::union)
    }

    /// Around both.
    pub fn union(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|axis| self.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// Half the surface of the box.
    pub fn half_area(&self) -> f32 {
        let [x, y, z]: [f32; 3] = std::array::from_fn(|axis| self.high[axis] - self.low[axis]);
        x * y + y * z + z * x
    }

    /// Twice the middle: as good for sorting.
    pub fn middle(&self, axis: usize) -> f32 {
        self.low[axis] + self.high[axis]
    }
}

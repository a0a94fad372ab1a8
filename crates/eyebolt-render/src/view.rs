//! What an ideal camera sees of a scene.

/// Depth, surface and normal of what each pixel sees, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct IdealView {
    /// Pixels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Depth along the optical axis, metres; 0 where nothing is seen.
    pub depth_m: Vec<f32>,
    /// Index of the mesh that is seen, in the order in which the scene was given them;
    /// [`IdealView::NOTHING`] where nothing is.
    pub surface: Vec<u16>,
    /// Unit normal of the triangle that is seen, turned toward the camera, in the camera's frame;
    /// zero where nothing is seen.
    pub normal_in_camera: Vec<[f32; 3]>,
}

impl IdealView {
    /// The surface of pixels that see nothing.
    pub const NOTHING: u16 = u16::MAX;
}

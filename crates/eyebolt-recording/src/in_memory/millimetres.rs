//! Depth as most drivers have it.

use eyebolt_geometry::{DepthImage, ImageError};

/// Depth from whole millimetres, row by row: 0 and 65535 stand for no depth. For depth in metres
/// there is [`DepthImage::new`].
///
/// # Errors
///
/// An empty image, or another number of values than `width * height`.
pub fn depth_from_millimetres(
    width: u32,
    height: u32,
    millimetres: &[u16],
) -> Result<DepthImage, ImageError> {
    // The largest number is what many drivers store where they saw nothing, and never 65 m.
    let metres = |value: &u16| if *value == u16::MAX { 0.0 } else { f32::from(*value) * 1e-3 };
    DepthImage::new(width, height, millimetres.iter().map(metres).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millimetres_become_metres() {
        let depth = depth_from_millimetres(2, 2, &[0, 1250, u16::MAX, 65534]).unwrap();
        assert_eq!(depth.depth_m(), [0.0, 1250.0 * 1e-3, 0.0, 65534.0 * 1e-3]);
        assert!(depth_from_millimetres(2, 2, &[1; 3]).is_err());
    }
}

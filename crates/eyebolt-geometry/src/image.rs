//! What all images share: a size that fits their data.

/// Why data does not make an image.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImageError {
    /// The number of values is not `width * height`, or the image is empty.
    #[error("an image of {width} x {height} pixels cannot have {values} values")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Number of rows.
        height: u32,
        /// How many values were given.
        values: usize,
    },
    /// Image and camera are not of the same size.
    #[error("image of {image:?} pixels does not fit a camera of {camera:?} (width, height)")]
    Camera {
        /// Width and height of the image.
        image: (u32, u32),
        /// Width and height of the camera.
        camera: (u32, u32),
    },
}

/// Checks that `values` fill an image of `width` x `height`, at least one pixel.
pub(crate) fn check_size(width: u32, height: u32, values: usize) -> Result<(), ImageError> {
    let expected = u64::from(width) * u64::from(height);
    if expected == 0 || usize::try_from(expected) != Ok(values) {
        return Err(ImageError::Size { width, height, values });
    }
    Ok(())
}

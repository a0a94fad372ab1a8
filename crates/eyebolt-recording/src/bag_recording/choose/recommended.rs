//! Which of several topics of depth a camera measured, and which were made of it.

/// Words in the names of what drivers and filters make of a depth image: seen from the colour
/// camera, with holes filled, or smaller.
const DERIVED: [&str; 14] = [
    "aligned",
    "registered",
    "color",
    "colour",
    "rgb",
    "filtered",
    "filled",
    "filling",
    "smoothed",
    "denoised",
    "decimated",
    "resized",
    "cropped",
    "fused",
];

/// The one of `names` that the others were made of, if the names tell.
///
/// What is drawn anew in the colour camera's view has lost the edges that the depth camera saw.
pub(super) fn raw<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let made = |name: &str| name.split(['/', '_']).filter(|word| DERIVED.contains(word)).count();
    let least = names.clone().map(made).min()?;
    let mut fitting = names.filter(|name| made(name) == least);
    let found = fitting.next();
    found.filter(|_| fitting.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drivers_names_tell_what_was_measured() {
        let pairs = [
            // realsense-ros 4, with and without the name of the node; its first version.
            (
                "/camera/camera/depth/image_rect_raw",
                "/camera/camera/aligned_depth_to_color/image_raw",
            ),
            ("/camera/depth/image_rect_raw", "/camera/aligned_depth_to_color/image_raw"),
            // Kinect drivers.
            ("/camera/depth/image_raw", "/camera/depth_registered/image_raw"),
            ("/depth/image_raw", "/depth_to_rgb/image_raw"),
            ("/cam/depth/image_raw", "/cam/depth/image_raw_filtered"),
        ];
        for (measured, made) in pairs {
            assert_eq!(raw([measured, made].into_iter()), Some(measured));
            assert_eq!(raw([made, measured].into_iter()), Some(measured));
        }
        // Two cameras.
        assert_eq!(raw(["/left/depth/image_raw", "/right/depth/image_raw"].into_iter()), None);
        assert_eq!(raw(std::iter::empty()), None);
    }
}

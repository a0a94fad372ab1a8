//! What the camera sees now, with the arm on it, as a small PNG.

use super::drawing::{Drawing, Silhouette, coarser};
use eyebolt::report::{OUTLINE, depth_picture};
use eyebolt_geometry::DepthImage;
use eyebolt_robot::JointPositions;

/// Greys of which pictures are made: what is finer is noise of the camera, which no PNG packs.
const GREYS: u8 = 64;
/// Numbers of colours in the palette: greys, greys behind the ghost, lines.
const GHOSTLY: u8 = GREYS;
const OUTLINE_AT: u8 = 2 * GREYS;
const INNER_AT: u8 = OUTLINE_AT + 1;
const GHOST_EDGE_AT: u8 = OUTLINE_AT + 2;
/// As the report has what is near.
const GHOST: [u8; 3] = [112, 151, 255];
const GHOST_EDGE: [u8; 3] = [170, 195, 255];
const BACKDROP: [u8; 3] = [90; 3];

/// `depth` as grey, near ones bright, with the outline of the arm of `drawing` in green, and the configuration to be taken
/// next as a bluish ghost; a PNG. Without the arm where images are not of the drawing's camera.
pub(super) fn picture(
    depth: &DepthImage,
    drawing: Option<&Drawing>,
    joints: &JointPositions,
) -> Vec<u8> {
    let size = (depth.width(), depth.height());
    let small = coarse(depth, coarser(size.0));
    let grey = depth_picture(&small);
    let mut pixels: Vec<u8> =
        grey.rgb().iter().map(|[grey, ..]| grey / (u8::MAX / GREYS + 1)).collect();
    if let Some(drawing) = drawing.filter(|drawing| drawing.fits(size)) {
        if let Some(ghost) = drawing.ghost() {
            lay(&mut pixels, ghost);
        }
        if let Some(Silhouette { outline, .. }) = drawing.silhouette(joints) {
            put(&mut pixels, &outline.inner, INNER_AT);
            put(&mut pixels, &outline.outer, OUTLINE_AT);
        }
    }
    encode(small.width(), small.height(), &pixels)
}

fn lay(pixels: &mut [u8], ghost: &Silhouette) {
    for at in &ghost.inside {
        if let Some(pixel) = pixels.get_mut(*at).filter(|pixel| **pixel < GREYS) {
            *pixel += GHOSTLY;
        }
    }
    put(pixels, &ghost.outline.outer, GHOST_EDGE_AT);
}

fn put(pixels: &mut [u8], places: &[usize], color: u8) {
    for at in places {
        if let Some(pixel) = pixels.get_mut(*at) {
            *pixel = color;
        }
    }
}

/// One pixel, the middle one, of each square of `factor` pixels; as cameras are made coarser.
fn coarse(depth: &DepthImage, factor: u32) -> DepthImage {
    let (width, height) = (depth.width() / factor, depth.height() / factor);
    let middle = factor / 2;
    let rows = (0..height).map(|v| factor * v + middle);
    let depth_m =
        rows.flat_map(|v| (0..width).map(move |u| depth.at(factor * u + middle, v))).collect();
    DepthImage::new(width, height, depth_m).unwrap_or_else(|_| depth.clone())
}

/// The colours, three bytes each.
fn palette() -> Vec<u8> {
    let greys = (0..GREYS).map(|grey| [grey * (u8::MAX / GREYS + 1) + 2; 3]);
    let ghostly = greys.clone().map(|grey| mixed(grey, GHOST, 0.5));
    let lines = [OUTLINE, mixed(BACKDROP, OUTLINE, 0.45), GHOST_EDGE];
    greys.chain(ghostly).chain(lines).flatten().collect()
}

fn mixed(below: [u8; 3], above: [u8; 3], opacity: f32) -> [u8; 3] {
    let mut mixed = below;
    for (channel, above) in mixed.iter_mut().zip(above) {
        let (below, above) = (f32::from(*channel), f32::from(above));
        *channel = (below + opacity * (above - below)).round() as u8;
    }
    mixed
}

fn encode(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette());
    encoder.set_compression(png::Compression::Fast);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    // Only an empty picture, too few bytes or a full disk can fail, and there is none of them.
    written.expect("a depth image has pixels, and memory takes them");
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(png: &[u8]) -> (u32, u32, Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!(reader.info().palette.as_ref().unwrap().len(), 3 * (2 * usize::from(GREYS) + 3));
        (info.width, info.height, pixels)
    }

    #[test]
    fn near_is_bright_and_nothing_dark() {
        let depth_m: Vec<f32> = (0..400).map(|at| if at % 20 < 10 { 1.0 } else { 3.0 }).collect();
        let mut depth_m = depth_m;
        depth_m[0] = 0.0;
        let depth = DepthImage::new(20, 20, depth_m).unwrap();
        let (width, height, pixels) = decoded(&picture(&depth, None, &JointPositions::default()));
        assert_eq!((width, height), (20, 20));
        assert!(pixels[1] > pixels[15] && pixels[15] > pixels[0]);
        assert!(pixels.iter().all(|pixel| *pixel < GREYS));
    }

    #[test]
    fn wide_pictures_are_made_coarser_and_the_ghost_is_seen_through() {
        let depth = DepthImage::new(1920, 10, vec![1.0; 19_200]).unwrap();
        let (width, height, mut pixels) =
            decoded(&picture(&depth, None, &JointPositions::default()));
        assert_eq!((width, height), (640, 3));
        let outline =
            eyebolt::report::OutlinePixels { outer: vec![2, usize::MAX], inner: Vec::new() };
        let before = pixels.clone();
        lay(&mut pixels, &Silhouette { inside: vec![0, 1, 0, usize::MAX], outline });
        assert_eq!(
            pixels[..4],
            [before[0] + GHOSTLY, before[1] + GHOSTLY, GHOST_EDGE_AT, before[3]]
        );
    }
}

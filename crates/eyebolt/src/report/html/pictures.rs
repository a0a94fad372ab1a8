//! Pictures small enough for a page.

use super::base64;
use crate::report::picture::Picture;
use rayon::prelude::*;

/// All pictures of a page together, bytes of PNG: half of what a page may have.
const MOST_BYTES: usize = 3 << 20;
/// Lowest bits of each channel that are noise of the camera, which no PNG packs.
const NOISE_BITS: u8 = 2;

/// Each of `pictures` as a `data:` URL, all made half as large until they fit together.
pub(super) fn data_urls(pictures: &[Picture]) -> Vec<String> {
    let mut scaled: Vec<Picture> = pictures.par_iter().map(without_noise).collect();
    loop {
        let files: Vec<Vec<u8>> = scaled.par_iter().map(Picture::encode_small_png).collect();
        let bytes: usize = files.iter().map(Vec::len).sum();
        let smallest = scaled.iter().all(|picture| picture.width().min(picture.height()) < 64);
        if bytes <= MOST_BYTES || smallest {
            let url = |file: &Vec<u8>| format!("data:image/png;base64,{}", base64::encode(file));
            return files.par_iter().map(url).collect();
        }
        scaled = scaled.par_iter().map(Picture::halved).collect();
    }
}

fn without_noise(picture: &Picture) -> Picture {
    let half = 1 << (NOISE_BITS - 1);
    let round = |channel: u8| channel.saturating_add(half) >> NOISE_BITS << NOISE_BITS;
    let rgb = picture.rgb().iter().map(|rgb| rgb.map(round)).collect();
    Picture::new(picture.width(), picture.height(), rgb)
}

//! Prints the markers of a picture: `cargo run --example detect -- PICTURE DICTIONARY`.

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use eyebolt_markers::{Dictionary, GreyImage, detect};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [picture, name] = arguments.as_slice() else { return Err("PICTURE DICTIONARY".into()) };
    let dictionary = Dictionary::named(name).ok_or("no such dictionary")?;
    let bytes = std::fs::read(picture)?;
    let mut decoder = zune_jpeg::JpegDecoder::new(std::io::Cursor::new(bytes));
    let pixels = decoder.decode()?;
    let (width, height) = decoder.dimensions().ok_or("no size")?;
    let image = GreyImage::from_rgb(width as u32, height as u32, pixels.as_chunks::<3>().0)?;
    for marker in detect(&image, &dictionary) {
        print!("{}", marker.id);
        for corner in marker.corners_px.iter().chain(&marker.outline_px) {
            print!(" {:.2},{:.2}", corner.x, corner.y);
        }
        println!();
    }
    Ok(())
}

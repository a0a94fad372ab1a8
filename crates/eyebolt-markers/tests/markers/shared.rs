//! Data that lie outside the project.

use eyebolt_markers::GreyImage;
use std::io::{BufReader, Cursor, Write};
use std::path::PathBuf;

/// The folder of shared data; says so aloud where there is none.
pub fn shared(test: &str) -> Option<PathBuf> {
    let Some(root) = std::env::var_os("EYEBOLT_SHARED") else {
        let text = format!("SKIPPED {test}: set EYEBOLT_SHARED to the folder of shared data\n");
        // Past the test harness, which keeps what passing tests print.
        std::io::stderr().write_all(text.as_bytes()).unwrap();
        return None;
    };
    Some(PathBuf::from(root).join("data"))
}

/// A JPEG or PNG in grey.
pub fn picture(path: &std::path::Path) -> GreyImage {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    if path.extension().is_some_and(|ending| ending == "png") {
        let mut reader = png::Decoder::new(BufReader::new(Cursor::new(bytes))).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        let samples = info.color_type.samples();
        let pixel = |p: &[u8]| if samples < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] };
        let rgb: Vec<[u8; 3]> =
            data[..info.buffer_size()].chunks_exact(samples).map(pixel).collect();
        return GreyImage::from_rgb(info.width, info.height, &rgb).unwrap();
    }
    let options = zune_jpeg::zune_core::options::DecoderOptions::default()
        .jpeg_set_out_colorspace(zune_jpeg::zune_core::colorspace::ColorSpace::RGB);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(Cursor::new(bytes), options);
    let pixels = decoder.decode().unwrap();
    let (width, height) = decoder.dimensions().unwrap();
    GreyImage::from_rgb(width as u32, height as u32, pixels.as_chunks::<3>().0).unwrap()
}

//! How good a network's labels are on recordings with masks: `segment_score MODEL FOLDER...`
//!
//! Points count, not pixels: those with depth, but for those within 3 pixels of the mask's edge.
#![allow(clippy::print_stdout)]

use eyebolt::model_files::ModelFiles;
use eyebolt::segment::Confusion;
use eyebolt::segment::{BACKGROUND, Segmenter, UNKNOWN};
use eyebolt_geometry::{DepthImage, Mask};
use eyebolt_recording::{BagOptions, Range, Recording};
use std::path::Path;
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let model = arguments.next().ok_or("give MODEL FOLDER...")?;
    let mut segmenter = Segmenter::open(&ModelFiles::at(model.into()))?;
    for folder in arguments {
        let recording = Recording::open(folder.as_ref(), &BagOptions::default())?;
        let camera = recording.camera().ok_or("a recording of depth images is needed")?;
        let mut whole = Confusion::new(2);
        let mut each = Vec::new();
        let mut spent = Vec::new();
        for index in 0..recording.frame_names().len() {
            let frame = recording.read_frame(index)?;
            let (Range::Depth(depth), Some(mask)) = (&frame.range, &frame.mask) else {
                return Err("a recording of depth images with masks is needed".into());
            };
            let begun = Instant::now();
            let found = segmenter.segment(depth, camera)?;
            spent.push(begun.elapsed().as_secs_f64() * 1e3);
            let any: Vec<u8> =
                found.label.iter().map(|label| u8::from(*label != BACKGROUND)).collect();
            if let Ok(folder) = std::env::var("PICTURES") {
                picture(
                    Path::new(&folder).join(format!("{}.png", frame.name)),
                    depth,
                    &found.label,
                    mask,
                )?;
            }
            let truth = truth(depth, mask);
            let mut one = Confusion::new(2);
            one.add(&truth, &any);
            whole.add(&truth, &any);
            each.push(format!("{:.3}", one.class(1).iou));
        }
        let arm = whole.class(1);
        spent.sort_by(f64::total_cmp);
        println!(
            "{folder}: IoU {:.3} precision {:.3} recall {:.3}; frames {}; {:.0} ms",
            arm.iou,
            arm.precision,
            arm.recall,
            each.join(" "),
            spent[spent.len() / 2]
        );
    }
    Ok(())
}

/// 1 the arm, 0 the rest, ignored where there is no depth or the mask's edge is near.
fn truth(depth: &DepthImage, mask: &Mask) -> Vec<u8> {
    const EDGE: i64 = 3;
    let (width, height) = (i64::from(depth.width()), i64::from(depth.height()));
    let set = mask.as_slice();
    let at =
        |u: i64, v: i64| set[(v.clamp(0, height - 1) * width + u.clamp(0, width - 1)) as usize];
    let pixel = |index: i64| {
        let (u, v) = (index % width, index / width);
        let around = (-EDGE..=EDGE).flat_map(|dv| (-EDGE..=EDGE).map(move |du| (du, dv)));
        let same = around.into_iter().all(|(du, dv)| at(u + du, v + dv) == at(u, v));
        match depth.depth_m()[index as usize] > 0.0 && same {
            true => u8::from(at(u, v)),
            false => UNKNOWN,
        }
    };
    (0..width * height).map(pixel).collect()
}

/// Depth in grey, what was found in green, the mask's edge in red.
fn picture(
    path: std::path::PathBuf,
    depth: &DepthImage,
    label: &[u8],
    mask: &Mask,
) -> Result<(), Failure> {
    let width = depth.width() as usize;
    let set = mask.as_slice();
    let pixels = depth.depth_m().iter().enumerate().flat_map(|(at, z)| {
        let grey = if *z > 0.0 { (40.0 + 200.0 / (1.0 + z)) as u8 } else { 0 };
        let edge =
            at % width > 0 && at >= width && (set[at] != set[at - 1] || set[at] != set[at - width]);
        match (edge, label[at]) {
            (true, _) => [255, 40, 40],
            (_, 1) => [grey / 2, grey, grey / 2],
            (_, 2) => [grey / 2, grey / 2, grey],
            _ => [grey; 3],
        }
    });
    let mut encoder =
        png::Encoder::new(std::fs::File::create(path)?, depth.width(), depth.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels.collect::<Vec<u8>>())?;
    Ok(())
}

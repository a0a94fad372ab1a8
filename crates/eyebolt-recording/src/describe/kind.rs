//! What a file is to a recording, by its name and what is in it.

use crate::npy::{Dtype, Npy};
use crate::png_image::PngImage;
use png::{BitDepth, ColorType};
use std::path::Path;

/// What the frames of a series are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Depth(UnitGuess),
    Cloud(UnitGuess),
    Background,
    Mask,
    Color,
    Joints,
}

/// What the unit of depth may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum UnitGuess {
    /// Integers, with this median.
    Integers(f32),
    /// Floats, with this median.
    Floats(f32),
    /// Nobody looked.
    Unknown,
}

/// Depth in metres has a smaller median than this, in millimetres a larger one.
const METRES_BELOW: f32 = 50.0;

impl UnitGuess {
    /// The value of `depth_unit`, and what is to be checked; `told` is the unit that the camera's file
    /// says, metres.
    pub(super) fn text(self, told: Option<f64>) -> (String, Option<String>) {
        if let Some(metres) = told.filter(|_| !matches!(self, Self::Floats(_))) {
            return (metres.to_string(), None);
        }
        let (unit, median, factor) = match self {
            Self::Integers(median) => ("mm", median, 1e-3),
            Self::Floats(median) if median > METRES_BELOW => ("mm", median, 1e-3),
            Self::Floats(median) => ("m", median, 1.0),
            Self::Unknown => ("m", 0.0, 1.0),
        };
        let middle = match self {
            Self::Unknown => String::new(),
            _ => format!(
                ", by which half of the first frame is nearer than {:.2} m",
                median * factor
            ),
        };
        let check = format!(
            "frames.depth_unit is a guess: \"{unit}\"{middle}; some cameras store 0.1 or 0.25 mm \
             (0.0001, 0.00025)"
        );
        (format!("\"{unit}\""), Some(check))
    }
}

impl Kind {
    /// What the file at `path` is, whose series is called `name`.
    pub(super) fn of(path: &Path, name: &str) -> Option<Self> {
        let name = name.to_lowercase();
        let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let background = has(&["background", "empty"]);
        match path.extension().and_then(|e| e.to_str()).unwrap_or_default() {
            "png" => {
                let image = PngImage::read(path, "picture", None, false).ok()?;
                match (image.color, image.depth) {
                    (ColorType::Grayscale, BitDepth::Sixteen) if background => {
                        Some(Self::Background)
                    }
                    (ColorType::Grayscale, BitDepth::Sixteen) => {
                        let samples = image.data.as_chunks::<2>().0;
                        let values =
                            samples.iter().map(|bytes| f32::from(u16::from_be_bytes(*bytes)));
                        Some(Self::Depth(UnitGuess::Integers(median(values)?)))
                    }
                    (ColorType::Grayscale, _) if has(&["mask"]) => Some(Self::Mask),
                    (_, BitDepth::Eight) if has(&["mask"]) => Some(Self::Mask),
                    (ColorType::Rgb | ColorType::Rgba, _) => Some(Self::Color),
                    _ => None,
                }
            }
            "npy" => Self::of_npy(path, background),
            "pcd" | "ply" => Some(Self::Cloud(UnitGuess::Unknown)),
            "csv" | "json" if has(&["joint"]) => Some(Self::Joints),
            _ => None,
        }
    }

    fn of_npy(path: &Path, background: bool) -> Option<Self> {
        let accepted = [Dtype::Float32, Dtype::Float64, Dtype::Uint16];
        let npy = Npy::read(path, "array", &accepted).ok()?;
        let guess = |values: Vec<f32>| {
            let median = median(values.into_iter())?;
            Some(match npy.dtype() {
                Dtype::Uint16 => UnitGuess::Integers(median),
                _ => UnitGuess::Floats(median),
            })
        };
        match *npy.shape() {
            [_] => Some(Self::Joints),
            [1, count] if count < MOST_JOINTS => Some(Self::Joints),
            [.., 3] => {
                let values: Vec<f32> = npy.values();
                let z = values.as_chunks::<3>().0.iter().map(|[x, y, z]| x.hypot(*y).hypot(*z));
                guess(z.collect()).map(Self::Cloud)
            }
            [_, _] if background => Some(Self::Background),
            [_, _] => guess(npy.values()).map(Self::Depth),
            _ => None,
        }
    }
}

/// Numbers of a row that may be positions of joints.
const MOST_JOINTS: usize = 64;

/// How many numbers the NPY at `path` has.
pub(super) fn npy_length(path: &Path) -> Option<usize> {
    let accepted = [Dtype::Float32, Dtype::Float64];
    Npy::read(path, "array", &accepted).ok().map(|npy| npy.shape().iter().product())
}

/// The median of what is positive and finite, and not the largest integer.
fn median(values: impl Iterator<Item = f32>) -> Option<f32> {
    let saturated = f32::from(u16::MAX);
    let seen = |v: &f32| v.is_finite() && *v > 0.0 && *v != saturated;
    let mut seen: Vec<f32> = values.filter(seen).collect();
    let middle = seen.len() / 2;
    if seen.is_empty() {
        return None;
    }
    Some(*seen.select_nth_unstable_by(middle, f32::total_cmp).1)
}

//! What the colours of an overlay mean.

use super::font::{self, GLYPH_HEIGHT};
use super::picture::{Picture, Rgb};
use super::residual::{CLIP_MM, Summary, THROUGH, shade, through_opacity};

const PAPER: Rgb = [0, 0, 0];
const INK: Rgb = [235, 235, 235];
/// Grey behind the colour bar, as the picture is behind the residuals.
const MIDDLE_GREY: Rgb = [95, 95, 95];

/// Lengths in pixels of a legend drawn at scale 1.
const MARGIN: u32 = 4;
const LEADING: u32 = GLYPH_HEIGHT + 3;
const BAR: [u32; 2] = [120, 7];
const SAMPLE: u32 = 12;
/// Longer titles are cut.
const TITLE_CHARACTERS: usize = 28;
/// Pictures at least this wide get letters of twice the size.
const WIDE_PX: u32 = 600;

/// A line of the picture and what it is.
pub(super) struct Line {
    pub(super) color: Rgb,
    pub(super) text: &'static str,
}

/// Where the next thing goes.
struct Pen {
    scale: u32,
    left: u32,
    top: u32,
}

/// Draws the legend into the lower left corner, unless it would take more than a third of the
/// picture.
pub(super) fn paint(
    picture: &mut Picture,
    frames: &[String],
    summary: Option<Summary>,
    lines: &[Line],
) {
    let scale = if picture.width() >= WIDE_PX { 2 } else { 1 };
    let title = title(frames);
    let figures = figures(summary);
    let longest = figures.iter().map(String::as_str).chain([title.as_str()]).map(font::width);
    let width = scale * (longest.max().unwrap_or(0).max(BAR[0]) + 2 * MARGIN);
    // The title, the figures, two rows below the bar, the lines and the stripes.
    let rows = 1 + figures.len() as u32 + 2 + lines.len() as u32 + 1;
    let height = scale * (rows * LEADING + BAR[1] + 3 + 2 * MARGIN);
    let room = u64::from(picture.width()) * u64::from(picture.height());
    let fits = width <= picture.width() && height <= picture.height();
    if !fits || 3 * u64::from(width) * u64::from(height) > room {
        return;
    }
    let top = picture.height() - height;
    picture.fill([0, top], [width, height], PAPER, 0.72);
    let mut pen = Pen { scale, left: scale * MARGIN, top: top + scale * MARGIN };
    pen.text(picture, &title);
    for figure in &figures {
        pen.text(picture, figure);
    }
    pen.bar(picture);
    for line in lines {
        pen.line(picture, line);
    }
    pen.stripes(picture);
}

fn title(frames: &[String]) -> String {
    let title = match frames {
        [] => String::new(),
        [one] => format!("frame {one}"),
        [first, rest @ ..] => format!("frame {first} and {} more", rest.len()),
    };
    if title.chars().count() <= TITLE_CHARACTERS {
        return title;
    }
    title.chars().take(TITLE_CHARACTERS - 2).chain("..".chars()).collect()
}

fn figures(summary: Option<Summary>) -> Vec<String> {
    match summary {
        Some(Summary { median_mm, half_within_mm }) => vec![
            format!("median {median_mm:+.1} mm"),
            format!("half within {half_within_mm:.1} mm"),
        ],
        None => vec!["no depth on the model".to_owned()],
    }
}

impl Pen {
    fn text(&mut self, picture: &mut Picture, text: &str) {
        font::write(picture, text, [self.left, self.top], self.scale, INK);
        self.top += self.scale * LEADING;
    }

    /// The colours from nearer to farther, with their figures and words below.
    fn bar(&mut self, picture: &mut Picture) {
        let [width, height] = BAR.map(|length| length * self.scale);
        picture.fill([self.left, self.top], [width, height], MIDDLE_GREY, 1.0);
        for u in 0..width {
            let share = (u as f32 + 0.5) / width as f32;
            let (color, opacity) = shade((2.0 * share - 1.0) * CLIP_MM);
            picture.fill([self.left + u, self.top], [1, height], color, opacity);
        }
        self.top += height + self.scale * 3;
        let ends = (format!("-{CLIP_MM} mm"), format!("+{CLIP_MM} mm"));
        self.ends(picture, &ends.0, "0", &ends.1);
        self.ends(picture, "nearer", "", "farther");
    }

    /// Words at the left end, the middle and the right end of the bar.
    fn ends(&mut self, picture: &mut Picture, left: &str, middle: &str, right: &str) {
        for (text, share) in [(left, 0), (middle, 1), (right, 2)] {
            let indent = BAR[0].saturating_sub(font::width(text)) * share / 2;
            let corner = [self.left + self.scale * indent, self.top];
            font::write(picture, text, corner, self.scale, INK);
        }
        self.top += self.scale * LEADING;
    }

    /// A piece of a line and what it is.
    fn line(&mut self, picture: &mut Picture, line: &Line) {
        let corner = [self.left, self.top + self.scale * (GLYPH_HEIGHT / 2)];
        picture.fill(corner, [self.scale * SAMPLE, 2], line.color, 1.0);
        self.beside_sample(picture, line.text);
    }

    fn stripes(&mut self, picture: &mut Picture) {
        let row = picture.width() as usize;
        for v in 0..self.scale * GLYPH_HEIGHT {
            for u in 0..self.scale * SAMPLE {
                let at = (self.top + v) as usize * row + (self.left + u) as usize;
                picture.blend(at, THROUGH, through_opacity(at, row));
            }
        }
        self.beside_sample(picture, "seen through");
    }

    fn beside_sample(&mut self, picture: &mut Picture, text: &str) {
        let left = self.left + self.scale * (SAMPLE + 4);
        font::write(picture, text, [left, self.top], self.scale, INK);
        self.top += self.scale * LEADING;
    }
}

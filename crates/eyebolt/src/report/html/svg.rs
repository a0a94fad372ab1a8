//! Drawings as SVG that a page holds: colours and fonts come from the page's style by class, so that
//! they follow its colour scheme.

use minijinja::HtmlEscape;
use std::fmt::Write;

/// Where a text stands about its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A drawing that grows.
#[derive(Debug)]
pub(super) struct Svg {
    body: String,
    width: f32,
    height: f32,
}

// Writing to a string cannot fail.
impl Svg {
    /// An empty drawing of this size, in units of which a line of text is 16 high.
    pub(super) fn new(width: f32, height: f32) -> Self {
        Self { body: String::new(), width, height }
    }

    /// Draws a group of `class` that says `title` to who points at it.
    pub(super) fn group(&mut self, class: &str, title: &str, fill: impl FnOnce(&mut Self)) {
        let _ = write!(self.body, "<g class=\"{class}\">");
        if !title.is_empty() {
            let _ = write!(self.body, "<title>{}</title>", HtmlEscape(title));
        }
        fill(self);
        self.body.push_str("</g>\n");
    }

    pub(super) fn line(&mut self, class: &str, [x1, y1]: [f32; 2], [x2, y2]: [f32; 2]) {
        let _ = write!(
            self.body,
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        );
    }

    pub(super) fn rect(&mut self, class: &str, [x, y]: [f32; 2], [width, height]: [f32; 2]) {
        let _ = write!(
            self.body,
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            width.max(0.0),
            height.max(0.0)
        );
    }

    /// As [`Self::rect`], of which `opacity` shows.
    pub(super) fn shade(&mut self, class: &str, corner: [f32; 2], size: [f32; 2], opacity: f32) {
        let _ = write!(self.body, "<g fill-opacity=\"{opacity:.2}\">");
        self.rect(class, corner, size);
        self.body.push_str("</g>");
    }

    pub(super) fn circle(&mut self, class: &str, [x, y]: [f32; 2], radius: f32) {
        let _ = write!(
            self.body,
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
        );
    }

    pub(super) fn polygon(&mut self, class: &str, points: impl IntoIterator<Item = [f32; 2]>) {
        let _ = write!(self.body, "<polygon class=\"{class}\" points=\"");
        for [x, y] in points {
            let _ = write!(self.body, "{x:.1},{y:.1} ");
        }
        self.body.push_str("\"/>");
    }

    pub(super) fn text(&mut self, class: &str, [x, y]: [f32; 2], anchor: Anchor, text: &str) {
        let _ = write!(
            self.body,
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{}\">{}</text>",
            anchor.name(),
            HtmlEscape(text)
        );
    }

    /// The element, which a reader who does not see is told of as `label`.
    pub(super) fn finish(self, name: &str, label: &str) -> String {
        let Self { body, width, height } = self;
        format!(
            "<svg class=\"plot\" data-plot=\"{name}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             role=\"img\" aria-label=\"{}\">\n{body}</svg>",
            HtmlEscape(label)
        )
    }
}

/// `value` with its sign; what rounds to zero has none.
pub(super) fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{value:+.decimals$}");
    let zero = text.chars().all(|c| "+-0.".contains(c));
    if zero { format!("{:.decimals$}", 0.0) } else { text }
}

/// Numbers on a line of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    /// The numbers at its ends.
    pub(super) range: [f32; 2],
    /// Where these are.
    pub(super) place: [f32; 2],
}

impl Axis {
    /// Where `value` is, or the end that is nearest to it.
    pub(super) fn at(&self, value: f32) -> f32 {
        let ([low, high], [from, to]) = (self.range, self.place);
        from + (to - from) * ((value - low) / (high - low)).clamp(0.0, 1.0)
    }

    /// Round numbers along it, at most `most` of them, and how many decimals they need.
    pub(super) fn ticks(&self, most: usize) -> (Vec<f32>, usize) {
        let [low, high] = self.range;
        let step = round_step((high - low) / most.max(1) as f32);
        let decimals = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
        let first = (low / step).ceil() as i32;
        let ticks = (first..).map(|i| i as f32 * step);
        (ticks.take_while(|tick| *tick <= high + 1e-3 * step).collect(), decimals)
    }
}

/// The least of 1, 2 and 5 times a power of ten that is not below `step`.
fn round_step(step: f32) -> f32 {
    let step = if step.is_finite() { step.max(1e-6) } else { 1.0 };
    let power = 10f32.powf(step.log10().floor());
    let factors = [1.0, 2.0, 5.0, 10.0];
    factors.into_iter().find(|f| f * power >= 0.999 * step).unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_from_outside_are_text() {
        let mut svg = Svg::new(10.0, 10.0);
        svg.group("mark", "<a> & \"b\"", |svg| {
            svg.text("label", [0.0; 2], Anchor::End, "<script>")
        });
        let text = svg.finish("p", "'\"><x>");
        for bad in ["<a>", "<script>", "\"><x>"] {
            assert!(!text.contains(bad), "{text}");
        }
        assert!(text.contains("&lt;a&gt; &amp; &quot;b&quot;"), "{text}");
    }

    #[test]
    fn ticks_are_round_inside_the_range_and_few() {
        for (low, high) in [(0.0, 1.0), (-30.0, 30.0), (-0.03, 0.02), (0.0, 7.3), (2.0, 950.0)] {
            let (ticks, decimals) = Axis { range: [low, high], place: [0.0, 1.0] }.ticks(6);
            assert!((2..=7).contains(&ticks.len()), "{low} {high}: {ticks:?}");
            for tick in ticks {
                let shown: f32 = format!("{tick:.decimals$}").parse().unwrap();
                let near = (shown - tick).abs() < 1e-4 * (high - low);
                assert!(near && tick >= low - 1e-6 && tick <= high * 1.001, "{tick}");
            }
        }
    }
}

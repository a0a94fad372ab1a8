//! Distributions one below the other.

use super::layout::{ROW, WIDTH, gutter, short};
use crate::report::html::spread::Spread;
use crate::report::html::svg::{Anchor, Axis, Svg, signed};

/// One distribution.
#[derive(Clone, Debug)]
pub(in super::super) struct Row {
    pub(in super::super) label: String,
    pub(in super::super) spread: Spread,
    /// Whether it took no part in the answer.
    pub(in super::super) muted: bool,
}

/// Room for the axis below, and for the medians at the right.
const BELOW: f32 = 40.0;
const ABOVE: f32 = 20.0;
const RIGHT: f32 = 58.0;
/// Parts of the axis in which numbers are counted.
const BINS: usize = 64;
/// The axis ends where all rows but these shares of their numbers do, and no farther.
const TAIL: f32 = 0.03;

/// `rows` on one axis in `unit`, which ends at `farthest` at the latest: the shape, whiskers from 5
/// to 95 percent, the quartiles as a box, the median as a line and in figures.
pub(in super::super) fn rows(
    name: &str,
    label: &str,
    unit: &str,
    rows: &[Row],
    farthest: f32,
) -> String {
    let left = gutter(rows.iter().map(|row| row.label.as_str()));
    let bottom = ABOVE + ROW * rows.len() as f32;
    let axis = Axis { range: range(rows, farthest), place: [left, WIDTH - RIGHT] };
    let mut svg = Svg::new(WIDTH, bottom + BELOW);
    let (ticks, decimals) = axis.ticks(7);
    for tick in ticks {
        let (x, zero) = (axis.at(tick), tick.abs() < 1e-6);
        svg.line(if zero { "zero" } else { "grid" }, [x, ABOVE], [x, bottom]);
        svg.text("tick", [x, bottom + 16.0], Anchor::Middle, &format!("{tick:.decimals$}"));
    }
    svg.text("unit", [axis.at(0.0), bottom + 34.0], Anchor::Middle, label);
    svg.text("tick", [WIDTH, 12.0], Anchor::End, "median");
    for (index, row) in rows.iter().enumerate() {
        draw(&mut svg, row, unit, &axis, ABOVE + ROW * (index as f32 + 0.5));
    }
    svg.finish(name, label)
}

/// Fewer numbers than this have no distribution.
const FEW: usize = 20;

/// About zero, as far as the rows reach, but for their tails.
fn range(rows: &[Row], farthest: f32) -> [f32; 2] {
    let ends = rows
        .iter()
        .filter(|row| row.spread.count() >= FEW)
        .flat_map(|row| [TAIL, 1.0 - TAIL].map(|q| row.spread.quantile(q)));
    let reach = ends.flatten().fold(0.0f32, |reach, end| reach.max(end.abs()));
    let reach = (1.1 * reach).clamp(0.1 * farthest, farthest);
    [-reach, reach]
}

fn draw(svg: &mut Svg, row: &Row, unit: &str, axis: &Axis, y: f32) {
    let class = if row.muted { "mark muted" } else { "mark" };
    let quantiles = [0.05, 0.25, 0.5, 0.75, 0.95].map(|share| row.spread.quantile(share));
    let count = row.spread.count();
    let known = all(quantiles).filter(|_| count >= FEW);
    let Some([low, lower, median, upper, high]) = known else {
        let (seen, few) = match count {
            0 => ("nothing was seen".to_owned(), "none"),
            _ => (format!("hardly seen: {count} points"), "few"),
        };
        return svg.group(class, &format!("{}: {seen}", row.label), |svg| {
            svg.text("label", [axis.place[0] - 8.0, y + 4.0], Anchor::End, &short(&row.label));
            svg.text("value", [WIDTH, y + 4.0], Anchor::End, few);
        });
    };
    let [a, b, middle, c, d] = [low, lower, median, upper, high].map(|v| signed(v.into(), 1));
    let title = format!(
        "{}: median {middle} {unit}, half from {b} to {c}, 90 % from {a} to {d} {unit}, of {}",
        row.label,
        row.spread.count()
    );
    svg.group(class, &title, |svg| {
        svg.text("label", [axis.place[0] - 8.0, y + 4.0], Anchor::End, &short(&row.label));
        violin(svg, &row.spread, axis, y);
        svg.line("whisker", [axis.at(low), y], [axis.at(high), y]);
        svg.rect("box", [axis.at(lower), y - 4.0], [axis.at(upper) - axis.at(lower), 8.0]);
        svg.line("median", [axis.at(median), y - 7.0], [axis.at(median), y + 7.0]);
        svg.text("value", [WIDTH, y + 4.0], Anchor::End, &middle);
    });
}

fn all<const N: usize>(values: [Option<f32>; N]) -> Option<[f32; N]> {
    values.iter().all(Option::is_some).then(|| values.map(Option::unwrap_or_default))
}

/// The shape above and below the middle of the row.
fn violin(svg: &mut Svg, spread: &Spread, axis: &Axis, y: f32) {
    let [low, high] = axis.range;
    let shape = spread.shape(low, high, BINS);
    let at = |bin: usize| axis.at(low + (high - low) * (bin as f32 + 0.5) / BINS as f32);
    let half = 0.46 * ROW;
    let upper = shape.iter().enumerate().map(|(bin, height)| [at(bin), y - half * height]);
    let lower = shape.iter().enumerate().rev().map(|(bin, height)| [at(bin), y + half * height]);
    svg.polygon("shape", upper.chain(lower));
}

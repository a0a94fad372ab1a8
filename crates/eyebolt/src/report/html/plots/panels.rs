//! Translations beside rotations, one row for each.

use super::layout::{ROW, WIDTH, gutter, short};
use crate::report::html::svg::{Anchor, Axis, Svg};

/// One of the two columns.
#[derive(Clone, Debug)]
pub(in super::super) struct Panel<'a> {
    /// What stands below it.
    pub(in super::super) label: &'a str,
    pub(in super::super) unit: &'a str,
    /// Decimals of its figures.
    pub(in super::super) decimals: usize,
    /// A value to compare with, drawn across all rows.
    pub(in super::super) mark: Option<f64>,
}

const ABOVE: f32 = 8.0;
const BELOW: f32 = 40.0;
/// Between the columns, and room for figures behind the longest bar.
const GAP: f32 = 20.0;
const FIGURE: f32 = 36.0;

/// For each of `rows` a bar from zero in each of two `columns`.
pub(in super::super) fn panels(
    name: &str,
    label: &str,
    rows: &[(String, [f64; 2])],
    columns: &[Panel<'_>; 2],
) -> String {
    let left = gutter(rows.iter().map(|(label, _)| label.as_str()));
    let bottom = ABOVE + ROW * rows.len() as f32;
    let width = (WIDTH - left - GAP) / 2.0;
    let mut svg = Svg::new(WIDTH, bottom + BELOW);
    for (index, panel) in columns.iter().enumerate() {
        let from = left + index as f32 * (width + GAP);
        let values = rows.iter().map(|(_, values)| values[index]).chain(panel.mark);
        let most = values.fold(0.0, f64::max).max(1e-6) as f32;
        let axis = Axis { range: [0.0, most], place: [from, from + width - FIGURE] };
        frame(&mut svg, panel, &axis, from + 0.5 * (width - FIGURE), bottom);
        for (row, (label, values)) in rows.iter().enumerate() {
            let y = ABOVE + ROW * (row as f32 + 0.5);
            bar(&mut svg, label, values[index], panel, &axis, y);
        }
        if let Some(mark) = panel.mark {
            let x = axis.at(mark as f32);
            svg.line("reference", [x, ABOVE], [x, bottom]);
        }
    }
    for (row, (label, _)) in rows.iter().enumerate() {
        let y = ABOVE + ROW * (row as f32 + 0.5) + 4.0;
        svg.text("label", [left - 8.0, y], Anchor::End, &short(label));
    }
    svg.finish(name, label)
}

fn frame(svg: &mut Svg, panel: &Panel<'_>, axis: &Axis, middle: f32, bottom: f32) {
    let (ticks, decimals) = axis.ticks(3);
    for tick in ticks {
        let x = axis.at(tick);
        svg.line(if tick.abs() < 1e-9 { "zero" } else { "grid" }, [x, ABOVE], [x, bottom]);
        svg.text("tick", [x, bottom + 16.0], Anchor::Middle, &format!("{tick:.decimals$}"));
    }
    svg.text("unit", [middle, bottom + 34.0], Anchor::Middle, panel.label);
}

fn bar(svg: &mut Svg, label: &str, value: f64, panel: &Panel<'_>, axis: &Axis, y: f32) {
    let Panel { unit, decimals, .. } = panel;
    let figure = format!("{value:.decimals$}");
    let (from, to) = (axis.at(0.0), axis.at(value as f32));
    svg.group("mark", &format!("{label}: {figure} {unit}"), |svg| {
        svg.line("stem", [from, y], [to, y]);
        svg.circle("dot", [to, y], 4.5);
        svg.text("value", [to + 9.0, y + 4.0], Anchor::Start, &figure);
    });
}

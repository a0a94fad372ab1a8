//! Correlations as shades.

use super::layout::WIDTH;
use crate::report::html::svg::{Anchor, Svg, signed};
use nalgebra::Matrix6;

const NAMES: [&str; 6] = ["x", "y", "z", "rot x", "rot y", "rot z"];
const LEFT: f32 = 56.0;
const ABOVE: f32 = 24.0;
const CELL: [f32; 2] = [(WIDTH - LEFT) / 6.0, 30.0];

/// The lower triangle of a correlation matrix with its figures.
pub(in super::super) fn matrix(name: &str, label: &str, correlations: &Matrix6<f64>) -> String {
    let mut svg = Svg::new(WIDTH, ABOVE + 6.0 * CELL[1] + 4.0);
    for (index, name) in NAMES.iter().enumerate() {
        let [x, y] = corner(index, index);
        svg.text("label", [x + 0.5 * CELL[0], ABOVE - 8.0], Anchor::Middle, name);
        svg.text("label", [LEFT - 8.0, y + 0.5 * CELL[1] + 4.0], Anchor::End, name);
    }
    for row in 0..6 {
        for column in 0..=row {
            let [x, y] = corner(row, column);
            let value = correlations[(row, column)];
            let class = if value < 0.0 { "negative" } else { "positive" };
            let title = format!("{} with {}: {value:+.2}", NAMES[row], NAMES[column]);
            svg.group("mark", &title, |svg| {
                let size = CELL.map(|edge| edge - 2.0);
                svg.rect("cell", [x, y], size);
                svg.shade(class, [x, y], size, 0.75 * value.abs() as f32);
                let middle = [x + 0.5 * size[0], y + 0.5 * size[1] + 4.0];
                svg.text("value", middle, Anchor::Middle, &signed(value, 2));
            });
        }
    }
    svg.finish(name, label)
}

fn corner(row: usize, column: usize) -> [f32; 2] {
    [LEFT + CELL[0] * column as f32, ABOVE + CELL[1] * row as f32]
}

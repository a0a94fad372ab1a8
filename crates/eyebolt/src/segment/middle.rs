//! The middle of points some of which are wrong.

/// Median of each coordinate by itself: points far away, wrongly labelled, do not move it. `None` without points.
pub fn middle(points: impl IntoIterator<Item = [f32; 3]>) -> Option<[f32; 3]> {
    let points: Vec<[f32; 3]> = points.into_iter().collect();
    if points.is_empty() {
        return None;
    }
    let of = |axis: usize| {
        let mut values: Vec<f32> = points.iter().map(|point| point[axis]).collect();
        let at = values.len() / 2;
        *values.select_nth_unstable_by(at, f32::total_cmp).1
    };
    Some([0, 1, 2].map(of))
}

#[cfg(test)]
mod tests {
    use super::middle;

    #[test]
    fn a_few_far_away_do_not_move_it() {
        let mut points: Vec<[f32; 3]> = (0..9).map(|n| [n as f32, -(n as f32), 2.0]).collect();
        points.extend([[1e6, 1e6, -1e6]; 2]);
        assert_eq!(middle(points), Some([5.0, -3.0, 2.0]));
        assert_eq!(middle([]), None);
    }
}

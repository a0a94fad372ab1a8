//! In which order configurations are taken, so that the way is short.

/// The order of `costs.len()` places that is cheapest in all, from `start` if there is one: `costs[a][b]` is that of going
/// from `a` to `b`, `start[a]` of going to `a` first. By dynamic programming over subsets (Held and Karp, SIAM Journal
/// 1962), so for a dozen places. `None` if every order has a way of infinite cost.
pub(super) fn cheapest(costs: &[Vec<f64>], start: Option<&[f64]>) -> Option<Vec<usize>> {
    let count = costs.len();
    if count == 0 {
        return Some(Vec::new());
    }
    let first = |place: usize| start.map_or(0.0, |start| start[place]);
    // By subset and last place: the cost, and the place before.
    let mut best = vec![vec![(f64::INFINITY, usize::MAX); count]; 1 << count];
    for place in 0..count {
        best[1 << place][place] = (first(place), usize::MAX);
    }
    for subset in 1..1usize << count {
        for last in (0..count).filter(|last| subset & (1 << last) != 0) {
            let so_far = best[subset][last].0;
            if !so_far.is_finite() {
                continue;
            }
            for next in (0..count).filter(|next| subset & (1 << next) == 0) {
                let cost = so_far + costs[last][next];
                let known = &mut best[subset | (1 << next)][next];
                if cost < known.0 {
                    *known = (cost, last);
                }
            }
        }
    }
    let mut subset = (1 << count) - 1;
    let ends = (0..count).map(|last| (best[subset][last].0, last));
    let (cost, mut last) = ends.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if !cost.is_finite() {
        return None;
    }
    let mut order = vec![last];
    while let (_, before) = best[subset][last]
        && before != usize::MAX
    {
        subset &= !(1 << last);
        last = before;
        order.push(last);
    }
    order.reverse();
    Some(order)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn permutations(count: usize) -> Vec<Vec<usize>> {
        if count == 0 {
            return vec![Vec::new()];
        }
        let shorter = permutations(count - 1);
        let with = |order: &Vec<usize>| {
            (0..count)
                .map(|at| {
                    let mut order = order.clone();
                    order.insert(at, count - 1);
                    order
                })
                .collect::<Vec<_>>()
        };
        shorter.iter().flat_map(with).collect()
    }

    fn cost(costs: &[Vec<f64>], start: &[f64], order: &[usize]) -> f64 {
        let ways = order.windows(2).map(|pair| costs[pair[0]][pair[1]]);
        start[order[0]] + ways.sum::<f64>()
    }

    proptest! {
        /// As cheap as the best of all orders.
        #[test]
        fn no_order_is_cheaper(
            numbers in prop::collection::vec(0.0..9.0_f64, 36), count in 1_usize..6,
        ) {
            let costs: Vec<Vec<f64>> =
                numbers.chunks(6).take(count).map(|row| row[..count].to_vec()).collect();
            let start = &numbers[30..30 + count];
            let order = cheapest(&costs, Some(start)).unwrap();
            let mut sorted = order.clone();
            sorted.sort_unstable();
            prop_assert_eq!(sorted, (0..count).collect::<Vec<_>>());
            let all = permutations(count);
            let least = all.iter().map(|o| cost(&costs, start, o)).fold(f64::INFINITY, f64::min);
            prop_assert!((cost(&costs, start, &order) - least).abs() < 1e-9);
        }
    }

    #[test]
    fn a_place_that_cannot_be_reached_leaves_no_order() {
        let never = f64::INFINITY;
        assert_eq!(cheapest(&[vec![0.0, never], vec![never, 0.0]], None), None);
        assert_eq!(cheapest(&[vec![0.0, 1.0], vec![never, 0.0]], None), Some(vec![0, 1]));
        assert_eq!(cheapest(&[], None), Some(Vec::new()));
    }
}

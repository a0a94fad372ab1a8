//! A few of many, evenly chosen.

/// At most `most` of `indices`, from the first to the last.
pub(crate) fn evenly(indices: &[usize], most: usize) -> Vec<usize> {
    let count = indices.len().min(most);
    (0..count).map(|i| indices[i * (indices.len() - 1) / (count - 1).max(1)]).collect()
}

/// At most `most` of the indices below `count` but `own`, evenly chosen.
pub(crate) fn evenly_others(count: usize, own: usize, most: usize) -> Vec<usize> {
    let others: Vec<usize> = (0..count).filter(|other| *other != own).collect();
    evenly(&others, most)
}

#[cfg(test)]
mod tests {
    use super::evenly;

    #[test]
    fn as_many_as_asked_for_with_both_ends() {
        for available in 1..40 {
            let indices: Vec<usize> = (0..available).collect();
            for most in 1..12 {
                let chosen = evenly(&indices, most);
                assert_eq!(chosen.len(), most.min(available));
                let rising = chosen.windows(2).all(|pair| pair[0] < pair[1]);
                assert!(rising && chosen[0] == 0, "{chosen:?}");
                assert!(most == 1 || chosen.last() == indices.last());
            }
        }
        assert!(evenly(&[], 3).is_empty());
    }
}

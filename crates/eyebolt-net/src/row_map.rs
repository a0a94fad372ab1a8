//! Rows as weighted sums of other rows, and runs of rows.

use std::sync::OnceLock;

/// A sparse matrix: each output row is a weighted sum of input rows.
#[derive(Debug)]
pub struct RowMap {
    inputs: usize,
    starts: Vec<u32>,
    rows: Vec<u32>,
    weights: Vec<f32>,
    adjoint: OnceLock<Box<RowMap>>,
}

impl RowMap {
    /// From lists one after the other: output `i` sums the entries `starts[i]..starts[i + 1]`.
    ///
    /// # Panics
    /// If starts do not ascend from 0 to the number of entries, or a row is not below `inputs`.
    pub(crate) fn new(inputs: usize, starts: Vec<u32>, rows: Vec<u32>, weights: Vec<f32>) -> Self {
        assert_eq!(rows.len(), weights.len(), "a weight for each row");
        assert!(starts.is_sorted() && starts.first() == Some(&0), "starts ascend from zero");
        assert_eq!(starts.last().map(|&end| end as usize), Some(rows.len()), "the last end");
        assert!(rows.iter().all(|&row| (row as usize) < inputs), "rows of the input");
        Self { inputs, starts, rows, weights, adjoint: OnceLock::new() }
    }

    /// Each output is one input row.
    pub(crate) fn gather(inputs: usize, rows: Vec<u32>) -> Self {
        let starts = (0..=rows.len() as u32).collect();
        let weights = vec![1.0; rows.len()];
        Self::new(inputs, starts, rows, weights)
    }

    /// Each output is the mean of a run.
    pub(crate) fn means(runs: &Runs) -> Self {
        let rows = (0..runs.inputs() as u32).collect();
        let weights = runs.iter().flat_map(|run| {
            let share = 1.0 / run.len().max(1) as f32;
            std::iter::repeat_n(share, run.len())
        });
        let weights = weights.collect();
        Self::new(runs.inputs(), runs.starts.clone(), rows, weights)
    }

    /// Number of input rows.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Number of output rows.
    pub fn outputs(&self) -> usize {
        self.starts.len() - 1
    }

    /// Input rows and their weights in the sum of an output.
    pub fn entries(&self, output: usize) -> impl Iterator<Item = (usize, f32)> {
        let (rows, weights) = self.lists(output);
        rows.iter().map(|&row| row as usize).zip(weights.iter().copied())
    }

    /// The same as two lists.
    pub(crate) fn lists(&self, output: usize) -> (&[u32], &[f32]) {
        let range = self.starts[output] as usize..self.starts[output + 1] as usize;
        (&self.rows[range.clone()], &self.weights[range])
    }

    /// The transposed matrix, which leads gradients back.
    pub fn adjoint(&self) -> &Self {
        self.adjoint.get_or_init(|| Box::new(self.transposed()))
    }

    fn transposed(&self) -> Self {
        let mut starts = vec![0_u32; self.inputs + 1];
        self.rows.iter().for_each(|&row| starts[row as usize + 1] += 1);
        for row in 0..self.inputs {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut rows = vec![0; self.rows.len()];
        let mut weights = vec![0.0; self.rows.len()];
        for output in 0..self.outputs() {
            for (input, weight) in self.entries(output) {
                let at = next[input] as usize;
                next[input] += 1;
                rows[at] = output as u32;
                weights[at] = weight;
            }
        }
        Self::new(self.outputs(), starts, rows, weights)
    }
}

/// Rows cut into runs, none of them empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Runs {
    starts: Vec<u32>,
}

impl Runs {
    /// From the first row of each and the end of the last.
    ///
    /// # Panics
    /// If they do not ascend from zero.
    pub(crate) fn new(starts: Vec<u32>) -> Self {
        let ascends = starts.windows(2).all(|pair| pair[0] < pair[1]);
        assert!(ascends && starts.first() == Some(&0), "runs ascend from zero and are not empty");
        Self { starts }
    }

    /// Number of rows in all.
    pub fn inputs(&self) -> usize {
        *self.starts.last().expect("there is a first") as usize
    }

    /// Number of runs.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Rows of every run.
    pub fn iter(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        self.starts.windows(2).map(|pair| pair[0] as usize..pair[1] as usize)
    }

    /// Rows of one run.
    pub fn get(&self, run: usize) -> std::ops::Range<usize> {
        self.starts[run] as usize..self.starts[run + 1] as usize
    }
}

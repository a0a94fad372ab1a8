//! Rows of channels.

use crate::Error;

/// One row of channels for every point, row after row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrix<T = f32> {
    rows: usize,
    channels: usize,
    values: Vec<T>,
}

impl<T: Copy + Default> Matrix<T> {
    /// A matrix of these values.
    ///
    /// # Errors
    /// If there are not `rows * channels` of them.
    pub fn new(rows: usize, channels: usize, values: Vec<T>) -> Result<Self, Error> {
        if rows.checked_mul(channels) != Some(values.len()) {
            return Err(Error::input(
                "matrix",
                format!("{} values are not {rows} rows of {channels}", values.len()),
            ));
        }
        Ok(Self { rows, channels, values })
    }

    /// All zero.
    pub fn zeros(rows: usize, channels: usize) -> Self {
        Self { rows, channels, values: vec![T::default(); rows * channels] }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Values in a row.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Row after row.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// Row after row, to be changed.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// Row after row, owned.
    pub fn into_values(self) -> Vec<T> {
        self.values
    }

    /// One row.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, row: usize) -> &[T] {
        &self.values[row * self.channels..][..self.channels]
    }

    /// The values through a function.
    pub fn map<U: Copy + Default>(&self, function: impl Fn(T) -> U) -> Matrix<U> {
        let values = self.values.iter().map(|&value| function(value)).collect();
        Matrix { rows: self.rows, channels: self.channels, values }
    }
}

impl Matrix<f32> {
    /// The channel with the largest value of each row, of equals the first: the class, where these
    /// are logits.
    pub fn argmax(&self) -> Vec<u32> {
        let largest = |row: &[f32]| {
            let better = |best: usize, c: usize| if row[c] > row[best] { c } else { best };
            (0..row.len()).fold(0, better) as u32
        };
        (0..self.rows).map(|row| largest(self.row(row))).collect()
    }

    /// That no value is NaN or infinite.
    ///
    /// # Errors
    /// The first that is, by row and channel.
    pub fn check_finite(&self, field: &str) -> Result<(), Error> {
        let bad = self.first_not_finite();
        bad.map_or(Ok(()), |bad| Err(Error::input(field, format!("{bad}; drop such points"))))
    }

    /// What is said of the first value that is NaN or infinite, if there is one.
    pub(crate) fn first_not_finite(&self) -> Option<String> {
        let at = self.values.iter().position(|value| !value.is_finite())?;
        let (row, channel) = (at / self.channels, at % self.channels);
        Some(format!("row {row}, channel {channel} is {}", self.values[at]))
    }
}

#[cfg(test)]
mod tests {
    use super::Matrix;

    #[test]
    fn the_largest_of_each_row() {
        let values = vec![0.0, 2.0, 2.0, -1.0, -3.0, -2.0];
        assert_eq!(Matrix::new(2, 3, values).unwrap().argmax(), [1, 0]);
        assert_eq!(Matrix::<f32>::zeros(2, 0).argmax(), [0, 0]);
    }
}

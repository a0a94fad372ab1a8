//! What networks told of the pixels of an image.

use super::classes::{CLASSES, UNKNOWN};

/// What networks told of the pixels of an image, row by row.
#[derive(Clone, Debug)]
pub struct Told {
    /// Of each pixel the likeliest class, or [`UNKNOWN`].
    pub label: Vec<u8>,
    /// Of each pixel the probability of every class, 0 where nobody can say; empty where nobody asked.
    pub probability: Vec<[f32; CLASSES.len()]>,
}

impl Told {
    /// These labels, and no probabilities.
    pub fn of(label: Vec<u8>) -> Self {
        Self { label, probability: Vec::new() }
    }

    /// Nothing of `pixels` pixels yet, with room for probabilities if they are `wanted`.
    pub fn nothing(pixels: usize, wanted: bool) -> Self {
        let probability = if wanted { vec![[0.0; CLASSES.len()]; pixels] } else { Vec::new() };
        Self { label: vec![UNKNOWN; pixels], probability }
    }

    /// The labels of each row of `width` pixels, and its probabilities if there are any.
    pub fn rows(
        &mut self,
        width: usize,
    ) -> impl Iterator<Item = (&mut [u8], Option<&mut [[f32; CLASSES.len()]]>)> {
        let mut probabilities = self.probability.chunks_mut(width);
        self.label.chunks_mut(width).map(move |labels| (labels, probabilities.next()))
    }
}

//! Memory that is used again: a fresh page costs more than what is written to it.

/// Buffers that are free.
#[derive(Debug, Default)]
pub struct Buffers {
    free: Vec<Vec<f32>>,
}

impl Buffers {
    /// A buffer of this length, with whatever was left in it.
    pub fn take(&mut self, len: usize) -> Vec<f32> {
        // One that is much too large is better kept for something that needs it.
        let fits = |buffer: &Vec<f32>| (len..=len + len / 4).contains(&buffer.len());
        let best = (0..self.free.len())
            .filter(|&at| fits(&self.free[at]))
            .min_by_key(|&at| self.free[at].len());
        match best {
            Some(at) => {
                let mut buffer = self.free.swap_remove(at);
                buffer.truncate(len);
                buffer
            }
            None => vec![0.0; len],
        }
    }

    /// Takes a buffer back.
    pub fn give(&mut self, mut buffer: Vec<f32>) {
        if !buffer.is_empty() {
            // What was cut off when it was taken comes back.
            buffer.resize(buffer.capacity(), 0.0);
            self.free.push(buffer);
        }
    }
}

//! Memory that is used again: a fresh page costs more than what is written to it.

/// Values that are kept from one run to the next: 256 MiB. For runs that need more, fresh pages
/// cost little beside the work.
const KEPT: usize = 1 << 26;

/// Buffers that are free.
#[derive(Debug, Default)]
pub struct Buffers {
    free: Vec<Vec<f32>>,
    /// In inference memory is what counts: what no longer fits goes back to the system.
    is_lean: bool,
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
            None => {
                if self.is_lean {
                    self.free.retain(|buffer| buffer.len() > len);
                }
                vec![0.0; len]
            }
        }
    }

    /// Before a run, of inference or not.
    pub fn set_lean(&mut self, is_lean: bool) {
        self.is_lean = is_lean;
    }

    /// After a run of inference.
    pub fn trim(&mut self) {
        self.free.sort_unstable_by_key(Vec::len);
        while self.free.iter().map(Vec::len).sum::<usize>() > KEPT {
            self.free.pop();
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

//! Memory that is used again: a fresh page costs more than what is written to it.

use crate::Error;

/// Values that are kept from one inference to the next: 256 MiB. For runs that need more, fresh
/// pages cost little beside the work.
const KEPT: usize = 1 << 26;

/// Buffers that are free, and how much is in use.
#[derive(Debug)]
pub struct Buffers {
    free: Vec<Free>,
    /// In inference memory is what counts: what no longer fits goes back to the system.
    is_lean: bool,
    /// Counts the runs.
    run: u64,
    /// Values in buffers that were taken and not given back in this run.
    used: usize,
    /// Values there may be in all.
    limit: usize,
}

/// A buffer, and the run that used it last.
#[derive(Debug)]
struct Free {
    values: Vec<f32>,
    run: u64,
}

impl Default for Buffers {
    fn default() -> Self {
        Self { free: Vec::new(), is_lean: false, run: 0, used: 0, limit: usize::MAX }
    }
}

impl Buffers {
    /// As many values as there may be from now on.
    pub fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }

    /// Before a run, of inference or not.
    pub fn start(&mut self, is_lean: bool) {
        self.is_lean = is_lean;
        self.run += 1;
        self.used = 0;
    }

    /// After a run. Inference keeps little; training what this run or the one before used, so that
    /// batches of all sizes do not each leave buffers behind.
    pub fn finish(&mut self) {
        if self.is_lean {
            self.free.sort_unstable_by_key(|free| free.values.len());
            while self.kept() > KEPT {
                self.free.pop();
            }
        } else {
            let run = self.run;
            self.free.retain(|free| free.run + 1 >= run);
        }
    }

    fn kept(&self) -> usize {
        self.free.iter().map(|free| free.values.len()).sum()
    }

    /// A buffer of this length, with whatever was left in it.
    ///
    /// # Errors
    /// If there is not as much memory, or there would be more in use than the limit.
    pub fn take(&mut self, len: usize) -> Result<Vec<f32>, Error> {
        // One that is much too large is better kept for something that needs it.
        let fits = |free: &Free| (len..=len + len / 4).contains(&free.values.len());
        let best = (0..self.free.len())
            .filter(|&at| fits(&self.free[at]))
            .min_by_key(|&at| self.free[at].values.len());
        let buffer = match best {
            Some(at) => {
                let mut buffer = self.free.swap_remove(at).values;
                buffer.truncate(len);
                buffer
            }
            None => self.fresh(len)?,
        };
        self.used += buffer.capacity();
        Ok(buffer)
    }

    fn fresh(&mut self, len: usize) -> Result<Vec<f32>, Error> {
        if self.is_lean {
            self.free.retain(|free| free.values.len() > len);
        }
        if self.used.saturating_add(self.kept()).saturating_add(len) > self.limit {
            self.free.clear();
        }
        let total = self.used.saturating_add(len);
        // A probe, since what the system zeroes page by page cannot be asked for so.
        if total > self.limit || Vec::<f32>::new().try_reserve_exact(len).is_err() {
            let mib = |values: usize| values.saturating_mul(4) >> 20;
            let problem = format!(
                "more than {} MiB of memory are needed at once, {} of them for one value; take fewer \
                 points, larger voxels or a narrower network",
                mib(total),
                mib(len)
            );
            return Err(Error::input("batch", problem));
        }
        Ok(vec![0.0; len])
    }

    /// Takes a buffer back.
    pub fn give(&mut self, mut buffer: Vec<f32>) {
        self.used = self.used.saturating_sub(buffer.capacity());
        if !buffer.is_empty() {
            // What was cut off when it was taken comes back.
            buffer.resize(buffer.capacity(), 0.0);
            self.free.push(Free { values: buffer, run: self.run });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Buffers;

    /// One run that uses buffers of these lengths at once.
    fn run(buffers: &mut Buffers, lengths: &[usize]) {
        buffers.start(false);
        let taken: Vec<_> = lengths.iter().map(|&len| buffers.take(len).unwrap()).collect();
        taken.into_iter().for_each(|buffer| buffers.give(buffer));
        buffers.finish();
    }

    #[test]
    fn batches_of_all_sizes_leave_no_more_than_two_runs_use() {
        let mut buffers = Buffers::default();
        for size in 1..200_usize {
            run(&mut buffers, &[size * size * 10; 4]);
            assert!(buffers.kept() <= 2 * 4 * 10 * size * size, "{} of {size}", buffers.kept());
        }
        run(&mut buffers, &[100; 4]);
        run(&mut buffers, &[100; 4]);
        assert_eq!(buffers.kept(), 400);
    }

    #[test]
    fn what_is_free_makes_room_and_a_limit_is_kept() {
        let mut buffers = Buffers::default();
        buffers.set_limit(1000);
        run(&mut buffers, &[300, 300, 300]);
        buffers.start(false);
        let large = buffers.take(700).unwrap();
        assert!(buffers.kept() + large.len() <= 1000);
        let error = buffers.take(400).unwrap_err().to_string();
        assert!(error.contains("batch: more than 0 MiB"), "{error}");
        buffers.give(large);
        assert!(buffers.take(900).is_ok());
        assert!(Buffers::default().take(usize::MAX / 4).is_err());
    }
}

//! Which frames a machine labels, of several that share a folder.

use std::fmt;
use std::str::FromStr;

/// One of several equal parts of all frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u32,
    count: u32,
}

/// Machines that may share a folder.
const MOST_SHARDS: u32 = 10_000;

impl Shard {
    /// All frames.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Shard `index`, from 0, of `count`; `None` if there is no such shard.
    pub fn new(index: u32, count: u32) -> Option<Self> {
        (index < count && count <= MOST_SHARDS).then_some(Self { index, count })
    }

    /// Its number, from 0.
    pub fn index(&self) -> u32 {
        self.index
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Whether frame `number` of `recording` is in this shard: consecutive frames go to one shard
    /// after the other, each recording beginning with another.
    pub fn takes(&self, recording: &str, number: usize) -> bool {
        let hash = blake3::hash(recording.as_bytes());
        let [a, b, c, d, ..] = *hash.as_bytes();
        let first = u64::from(u32::from_le_bytes([a, b, c, d]));
        (first + number as u64) % u64::from(self.count) == u64::from(self.index)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    /// From `I/N`.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text.split_once('/').map(|(index, count)| (index.parse(), count.parse()));
        let Some((Ok(index), Ok(count))) = numbers else {
            return Err("write I/N: which shard, and how many there are, as in 0/8".to_owned());
        };
        Self::new(index, count).ok_or_else(|| match count {
            0 => "there must be at least one shard, as in 0/1".to_owned(),
            count if count > MOST_SHARDS => format!("there may be {MOST_SHARDS} shards at most"),
            count => {
                format!("shards are counted from 0: the last of {count} is {}/{count}", count - 1)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn every_frame_is_in_one_shard_and_shards_are_alike_in_size() {
        for count in [1, 2, 3, 7] {
            let shards: Vec<Shard> = (0..count).map(|i| Shard::new(i, count).unwrap()).collect();
            let mut sizes = vec![0_i32; shards.len()];
            for (recording, frames) in [("a-1", 10), ("b-2", 5), ("c-3", 1)] {
                for number in 0..frames {
                    let taken = shards.iter().filter(|shard| shard.takes(recording, number));
                    let taken: Vec<u32> = taken.map(Shard::index).collect();
                    assert_eq!(taken.len(), 1);
                    sizes[taken[0] as usize] += 1;
                }
            }
            let (least, most) = (sizes.iter().min().unwrap(), sizes.iter().max().unwrap());
            assert!(most - least <= 3, "{sizes:?}");
        }
    }

    #[test]
    fn shards_that_are_none_say_what_to_write() {
        for (text, word) in [("2/2", "1/2"), ("0/0", "0/1"), ("3", "I/N"), ("-1/2", "I/N")] {
            let error = text.parse::<Shard>().unwrap_err();
            assert!(error.contains(word), "{text}: {error}");
        }
        assert_eq!("1/2".parse(), Ok(Shard { index: 1, count: 2 }));
    }
}

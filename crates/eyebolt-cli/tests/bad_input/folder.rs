//! A recording in a folder, to be spoilt.

use crate::desk::Desk;
use crate::outcome::trusted;
use crate::recording::{npy_f64, write, write_depth};
use crate::scene::{Shot, shots};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// What the camera saw in all configurations.
pub static SHOTS: LazyLock<Vec<Shot>> = LazyLock::new(shots);

/// The calibration of all shots, unspoilt.
pub static GOOD: LazyLock<String> = LazyLock::new(|| trusted(Recorded::all().path()));

/// A recording folder of one's own.
pub struct Recorded(Desk);

impl Recorded {
    /// Two configurations: whoever complains of the second has read the first.
    pub fn two() -> Self {
        Self::of(&SHOTS[..2])
    }

    /// Enough for a trusted answer.
    pub fn all() -> Self {
        Self::of(&SHOTS)
    }

    pub fn of(shots: &[Shot]) -> Self {
        let desk = Desk::new();
        write_depth(desk.path(), shots);
        Self(desk)
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn write(&self, name: &str, bytes: &[u8]) {
        write(self.path(), name, bytes);
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.file(name)).unwrap()
    }

    /// Replaces `from`, which is in the text of file `name`, by `to`.
    #[track_caller]
    pub fn replace(&self, name: &str, from: &str, to: &str) {
        let text = String::from_utf8(self.read(name)).unwrap();
        assert!(text.contains(from), "no {from:?} in {text}");
        self.write(name, text.replacen(from, to, 1).as_bytes());
    }

    /// Positions of the joints in `frame`, in the order of the description.
    pub fn write_joints(&self, frame: usize, positions: &[f64]) {
        let bytes = npy_f64(&[positions.len()], positions);
        self.write(&format!("joints_{frame}.npy"), &bytes);
    }
}

//! What `fixtures/make_fixtures.py` wrote, and the numbers that both sides make for themselves.

use eyebolt_net::{Graph, Matrix, Parameters};
use safetensors::SafeTensors;
use std::collections::BTreeMap;
use std::path::Path;

/// Uniform in `[-1, 1)`: 24 bits of SplitMix64 of the FNV-1a hash of the name and the place.
pub fn hashed(name: &str, count: usize) -> Vec<f32> {
    let seed = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |seed, byte| {
        (seed ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let value = |place: u64| {
        let mut z = seed.wrapping_add((place + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 40) as f32 / (1 << 23) as f32 - 1.0
    };
    (0..count as u64).map(value).collect()
}

pub fn hashed_matrix(name: &str, rows: usize, channels: usize) -> Matrix {
    Matrix::new(rows, channels, hashed(name, rows * channels)).unwrap()
}

/// Parameters of a graph, each by its name.
pub fn parameters(graph: &Graph, of: impl Fn(&str, &[usize], Vec<f32>) -> Vec<f32>) -> Parameters {
    let values = graph
        .parameters()
        .iter()
        .map(|spec| of(&spec.name, &spec.shape, hashed(&spec.name, spec.len())));
    Parameters::new(graph, values.collect()).unwrap()
}

/// A file of tensors, by name.
pub struct Fixture {
    floats: BTreeMap<String, Vec<f32>>,
    integers: BTreeMap<String, Vec<i32>>,
}

impl Fixture {
    pub fn read(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
        let bytes = std::fs::read(folder.join(name).with_extension("safetensors")).unwrap();
        let mut found = Self { floats: BTreeMap::new(), integers: BTreeMap::new() };
        for (name, view) in SafeTensors::deserialize(&bytes).unwrap().tensors() {
            let words = view.data().as_chunks::<4>().0.iter().copied();
            if view.dtype() == safetensors::Dtype::I32 {
                found.integers.insert(name, words.map(i32::from_le_bytes).collect());
            } else {
                found.floats.insert(name, words.map(f32::from_le_bytes).collect());
            }
        }
        found
    }

    pub fn floats(&self, name: &str) -> &[f32] {
        self.floats.get(name).unwrap_or_else(|| panic!("no {name}"))
    }

    pub fn integers(&self, name: &str) -> &[i32] {
        self.integers.get(name).unwrap_or_else(|| panic!("no {name}"))
    }

    pub fn cells(&self, name: &str) -> Vec<[i32; 4]> {
        self.integers(name).as_chunks::<4>().0.to_vec()
    }
}

/// Rows of `values`, which are of the voxels `have`, in the order of `wanted`.
pub fn reordered(values: &Matrix, have: &[[i32; 4]], wanted: &[[i32; 4]]) -> Vec<f32> {
    let place: BTreeMap<_, _> = have.iter().zip(0..).collect();
    wanted.iter().flat_map(|cell| values.row(place[cell]).to_vec()).collect()
}

/// Largest difference in shares of the largest value.
pub fn assert_close(name: &str, found: &[f32], expected: &[f32], tolerance: f32) {
    let largest = expected.iter().fold(1e-20_f32, |a, b| a.max(b.abs()));
    assert_within(name, found, expected, tolerance * largest);
}

/// That no value is off by more than this.
pub fn assert_within(name: &str, found: &[f32], expected: &[f32], tolerance: f32) {
    assert_eq!(found.len(), expected.len(), "{name}");
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        // Not by a maximum, in which a NaN would be lost.
        let is_close = (found - expected).abs() <= tolerance;
        assert!(is_close, "{name}: value {at} is {found}, not {expected} within {tolerance}");
    }
}

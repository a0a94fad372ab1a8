//! The occupied voxels of a batch at one resolution.

use super::bricks::Bricks;
use super::morton::{self, BITS};
use crate::Error;
use rayon::prelude::*;

/// Coordinates lie from minus this up to, but not including, this: 20 bits.
pub const COORDINATE_LIMIT: i32 = 1 << (BITS - 1);
/// Items that a batch may have.
pub const MAX_ITEMS: usize = 1 << 10;

/// Distinct voxels, item after item, each in Morton order.
#[doc(alias = "SparseTensor")]
#[doc(alias = "CoordinateManager")]
#[derive(Clone, Debug)]
pub struct VoxelSet {
    stride: u32,
    /// What a coordinate of zero is in the codes, which have no sign.
    origin: u32,
    codes: Vec<u64>,
    item_starts: Vec<u32>,
    bricks: Bricks,
}

impl VoxelSet {
    /// The distinct voxels of these `[item, x, y, z]`, and the voxel of each.
    ///
    /// # Errors
    /// If there are none, more than 2^31, an item at or above [`MAX_ITEMS`] or below zero, or a
    /// coordinate beyond [`COORDINATE_LIMIT`].
    pub fn new(coordinates: &[[i32; 4]]) -> Result<(Self, Vec<u32>), Error> {
        if coordinates.is_empty() {
            return Err(Error::input("coordinates", "there are none"));
        }
        if coordinates.len() > i32::MAX as usize {
            return Err(Error::input("coordinates", "more than 2^31; split the cloud"));
        }
        let key = |(row, &coordinate): (usize, &[i32; 4])| key(row, coordinate);
        let keys: Result<Vec<_>, Error> = coordinates.par_iter().enumerate().map(key).collect();
        // Threads fail in no order: the error is that of the first row.
        let keys = keys.or_else(|_| coordinates.iter().enumerate().map(key).collect())?;
        Ok(Self::from_keys(1, COORDINATE_LIMIT as u32, keys))
    }

    /// Of item, code and row; the voxel of each row comes second.
    pub(super) fn from_keys(
        stride: u32,
        origin: u32,
        mut keys: Vec<(u32, u64, u32)>,
    ) -> (Self, Vec<u32>) {
        if !keys.is_sorted() {
            keys.par_sort_unstable();
        }
        let mut voxel_of_row = vec![0; keys.len()];
        let mut codes = Vec::with_capacity(keys.len());
        let mut item_starts = vec![0];
        let mut last = None;
        for (item, code, row) in keys {
            while item_starts.len() <= item as usize {
                item_starts.push(codes.len() as u32);
            }
            if last != Some((item, code)) {
                codes.push(code);
                last = Some((item, code));
            }
            voxel_of_row[row as usize] = codes.len() as u32 - 1;
        }
        item_starts.push(codes.len() as u32);
        let bricks = Bricks::new(voxels_of(&item_starts, &codes));
        (Self { stride, origin, codes, item_starts, bricks }, voxel_of_row)
    }

    /// The voxels `factor` times as large that hold these, and which of them holds each.
    pub(super) fn coarser(&self, factor: u32) -> (Self, Vec<u32>) {
        let same_order = factor.is_power_of_two() && self.origin.is_multiple_of(factor);
        let origin = if same_order { self.origin / factor } else { self.origin };
        let keys = self.voxels().enumerate().map(|(row, (item, code))| {
            let code = if same_order {
                code >> (3 * factor.trailing_zeros())
            } else {
                morton::encode(morton::decode(code).map(|value| {
                    let cell =
                        (i64::from(value) - i64::from(self.origin)).div_euclid(factor.into());
                    // Nearer to zero than before, so within bits.
                    (cell + i64::from(origin)) as u32
                }))
            };
            (item, code, row as u32)
        });
        Self::from_keys(self.stride * factor, origin, keys.collect())
    }

    /// Number of voxels.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Never: there is always one.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty()
    }

    /// Edge of a voxel, in voxels of the finest resolution.
    pub fn stride(&self) -> u32 {
        self.stride
    }

    /// First row of each item, and the end of the last.
    pub fn item_starts(&self) -> &[u32] {
        &self.item_starts
    }

    /// `[item, x, y, z]` of every voxel, in multiples of the stride, as the finest resolution
    /// counts.
    pub fn coordinates(&self) -> Vec<[i32; 4]> {
        self.voxels()
            .map(|(item, code)| {
                let [x, y, z] = morton::decode(code)
                    .map(|value| (value as i32 - self.origin as i32) * self.stride as i32);
                [item as i32, x, y, z]
            })
            .collect()
    }

    pub(super) fn bricks(&self) -> &Bricks {
        &self.bricks
    }

    pub(super) fn origin(&self) -> u32 {
        self.origin
    }

    pub(super) fn code(&self, row: usize) -> u64 {
        self.codes[row]
    }

    /// Item and code of every voxel.
    pub(super) fn voxels(&self) -> impl Iterator<Item = (u32, u64)> {
        voxels_of(&self.item_starts, &self.codes)
    }

    /// The item of a row.
    pub(super) fn item(&self, row: usize) -> u32 {
        self.item_starts.partition_point(|&start| start as usize <= row) as u32 - 1
    }
}

fn voxels_of<'a>(starts: &'a [u32], codes: &'a [u64]) -> impl Iterator<Item = (u32, u64)> + 'a {
    starts.windows(2).enumerate().flat_map(move |(item, pair)| {
        codes[pair[0] as usize..pair[1] as usize].iter().map(move |&code| (item as u32, code))
    })
}

fn key(row: usize, [item, x, y, z]: [i32; 4]) -> Result<(u32, u64, u32), Error> {
    if item < 0 || item as usize >= MAX_ITEMS {
        return Err(Error::input(
            "coordinates",
            format!("row {row}: item {item} of a batch of at most {MAX_ITEMS}"),
        ));
    }
    let range = -COORDINATE_LIMIT..COORDINATE_LIMIT;
    if let Some(far) = [x, y, z].into_iter().find(|value| !range.contains(value)) {
        return Err(Error::input(
            "coordinates",
            format!(
                "row {row}: {far} is beyond 20 bits ({} to {}); choose larger voxels or move the \
                 cloud to the origin",
                range.start,
                range.end - 1
            ),
        ));
    }
    let cell = [x, y, z].map(|value| (value + COORDINATE_LIMIT) as u32);
    Ok((item as u32, morton::encode(cell), row as u32))
}

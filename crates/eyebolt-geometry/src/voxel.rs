//! Downsampling to one point per voxel.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

/// Integer coordinates of a voxel: it covers `key * size .. (key + 1) * size` on every axis.
pub type VoxelKey = [i32; 3];

/// Why points cannot be put into voxels.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VoxelError {
    /// The voxel size is not a positive finite number.
    #[error("voxel size {voxel_size_m} m: must be positive and finite")]
    Size {
        /// The size asked for.
        voxel_size_m: f64,
    },
    /// A point is so far from the origin that its voxel has no key.
    #[error("point {index} is more than 2^20 voxels from the origin: units other than metres?")]
    TooFar {
        /// Index of the point.
        index: usize,
    },
    /// More points than an index can name.
    #[error("{count} points are too many: at most 2^32 - 2")]
    TooMany {
        /// How many points were given.
        count: usize,
    },
}

/// The occupied voxels of a set of points, sorted by key; all lists have one entry per voxel.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    /// Which voxel, ascending.
    pub keys: Vec<VoxelKey>,
    /// Mean of the points inside, metres.
    pub centroids: Vec<Point3<f32>>,
    /// How many points are inside.
    pub counts: Vec<u32>,
    /// Of every **point** given: which voxel of the lists it is in; `None` for points that are NaN.
    pub voxel_of_point: Vec<Option<u32>>,
}

impl Voxels {
    /// How many voxels are occupied.
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether there were no points.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }
}

/// Keys run from `-KEY_LIMIT` to `KEY_LIMIT - 1`, so that three of them fit in 63 bits.
const KEY_LIMIT: i64 = 1 << 20;

/// Puts `points` (metres) into cubes of `voxel_size_m` and takes the mean of each; points with a
/// coordinate that is not finite are left out.
///
/// # Errors
///
/// A size that is not positive, or a point more than 2^20 voxels from the origin.
pub fn voxel_downsample(points: &[Point3<f32>], voxel_size_m: f64) -> Result<Voxels, VoxelError> {
    if !(voxel_size_m > 0.0 && voxel_size_m.is_finite()) {
        return Err(VoxelError::Size { voxel_size_m });
    }
    let count = points.len();
    if u32::try_from(count).is_err() {
        return Err(VoxelError::TooMany { count });
    }
    let mut order = codes_of(points, voxel_size_m)?;
    // Index breaks ties, so the order and with it every sum is the same on any number of threads.
    order.par_sort_unstable();
    let mut voxels = Voxels {
        keys: Vec::new(),
        centroids: Vec::new(),
        counts: Vec::new(),
        voxel_of_point: vec![None; count],
    };
    for members in order.chunk_by(|a, b| a.0 == b.0) {
        push_voxel(&mut voxels, points, members);
    }
    Ok(voxels)
}

/// Code of the voxel and index of every finite point.
fn codes_of(points: &[Point3<f32>], voxel_size_m: f64) -> Result<Vec<(u64, u32)>, VoxelError> {
    let mut codes = Vec::with_capacity(points.len());
    for (index, point) in (0_u32..).zip(points) {
        if !point.iter().all(|c| c.is_finite()) {
            continue;
        }
        let code = code(point, voxel_size_m).ok_or(VoxelError::TooFar { index: index as usize })?;
        codes.push((code, index));
    }
    Ok(codes)
}

/// The key of a finite point in one number that sorts as the key does.
fn code(point: &Point3<f32>, voxel_size_m: f64) -> Option<u64> {
    let mut code = 0_u64;
    for coordinate in point.iter() {
        // The cast saturates, so a number out of range stays out of range.
        let key = (f64::from(*coordinate) / voxel_size_m).floor() as i64;
        if !(-KEY_LIMIT..KEY_LIMIT).contains(&key) {
            return None;
        }
        code = code << 21 | (key + KEY_LIMIT) as u64;
    }
    Some(code)
}

fn key_of(code: u64) -> VoxelKey {
    [42, 21, 0].map(|shift| ((code >> shift & 0x1f_ffff) as i64 - KEY_LIMIT) as i32)
}

/// Appends the voxel of `members`, points of one code in ascending order of index.
fn push_voxel(voxels: &mut Voxels, points: &[Point3<f32>], members: &[(u64, u32)]) {
    let Some((code, _)) = members.first() else { return };
    let voxel = voxels.keys.len() as u32;
    let mut sum = Vector3::<f64>::zeros();
    for (_, index) in members {
        let index = *index as usize;
        if let (Some(point), Some(of_point)) =
            (points.get(index), voxels.voxel_of_point.get_mut(index))
        {
            sum += point.coords.cast::<f64>();
            *of_point = Some(voxel);
        }
    }
    voxels.keys.push(key_of(*code));
    voxels.centroids.push(Point3::from((sum / members.len() as f64).cast::<f32>()));
    voxels.counts.push(members.len() as u32);
}

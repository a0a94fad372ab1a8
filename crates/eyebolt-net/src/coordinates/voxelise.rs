//! From points to voxels: coordinates, mean features, votes.

use super::COORDINATE_LIMIT;
use crate::{Error, Matrix};

/// `[item, x, y, z]` of the voxel of edge `voxel_m` that each point, in metres, lies in.
///
/// # Errors
/// If the edge is not positive, a point is NaN or infinite, or a voxel lies beyond
/// [`COORDINATE_LIMIT`].
#[doc(alias = "sparse_quantize")]
#[doc(alias = "quantize")]
#[doc(alias = "voxelize")]
pub fn voxelise(item: u16, points_m: &[[f32; 3]], voxel_m: f32) -> Result<Vec<[i32; 4]>, Error> {
    if !(voxel_m.is_finite() && voxel_m > 0.0) {
        return Err(Error::input("voxel_m", format!("{voxel_m} is not a positive length")));
    }
    let place = |(row, &[x, y, z]): (usize, &[f32; 3])| {
        let [x, y, z] = [x, y, z].map(|value| (value / voxel_m).floor());
        let limit = COORDINATE_LIMIT as f32;
        if ![x, y, z].iter().all(|value| value.is_finite() && (-limit..limit).contains(value)) {
            return Err(Error::input(
                "points",
                format!(
                    "point {row} is {:?}: not finite, or beyond 20 bits of voxels of {voxel_m} m",
                    points_m[row]
                ),
            ));
        }
        Ok([i32::from(item), x as i32, y as i32, z as i32])
    };
    points_m.iter().enumerate().map(place).collect()
}

/// Mean features of the points of each voxel.
///
/// # Errors
/// If there is not one voxel for every row, or a voxel without a point.
pub fn average_features(
    features: &Matrix,
    voxel_of_point: &[u32],
    voxels: usize,
) -> Result<Matrix, Error> {
    check_rows("features", features.rows(), voxel_of_point, voxels)?;
    let channels = features.channels();
    // A voxel may hold millions of points, whose sum 32 bits would not follow.
    let mut sums = vec![0.0_f64; voxels * channels];
    let mut counts = vec![0_u32; voxels];
    for (row, &voxel) in voxel_of_point.iter().enumerate() {
        let voxel = voxel as usize;
        counts[voxel] += 1;
        let sums = &mut sums[voxel * channels..][..channels];
        for (sum, &value) in sums.iter_mut().zip(features.row(row)) {
            *sum += f64::from(value);
        }
    }
    if let Some(voxel) = counts.iter().position(|&count| count == 0) {
        return Err(Error::input("voxel_of_point", format!("no point is in voxel {voxel}")));
    }
    let shares = counts.iter().flat_map(|&count| std::iter::repeat_n(f64::from(count), channels));
    let means = sums.iter().zip(shares).map(|(sum, count)| (sum / count) as f32).collect();
    Matrix::new(voxels, channels, means)
}

/// The label that most points of each voxel have, the smallest where several have as many;
/// `ignore` where every point has that. Points to ignore have no vote.
///
/// # Errors
/// If there is not one voxel for every label.
pub fn vote_labels(
    labels: &[u32],
    voxel_of_point: &[u32],
    voxels: usize,
    ignore: u32,
) -> Result<Vec<u32>, Error> {
    check_rows("labels", labels.len(), voxel_of_point, voxels)?;
    let mut votes: Vec<(u32, u32)> = voxel_of_point
        .iter()
        .zip(labels)
        .filter(|&(_, &label)| label != ignore)
        .map(|(&voxel, &label)| (voxel, label))
        .collect();
    votes.sort_unstable();
    let mut winners = vec![ignore; voxels];
    let mut most = vec![0; voxels];
    for votes in votes.chunk_by(|a, b| a == b) {
        let (voxel, label) = (votes[0].0 as usize, votes[0].1);
        if votes.len() > most[voxel] {
            most[voxel] = votes.len();
            winners[voxel] = label;
        }
    }
    Ok(winners)
}

fn check_rows(
    field: &str,
    rows: usize,
    voxel_of_point: &[u32],
    voxels: usize,
) -> Result<(), Error> {
    if rows != voxel_of_point.len() {
        let problem = format!("{rows} rows for {} points", voxel_of_point.len());
        return Err(Error::input(field, problem));
    }
    match voxel_of_point.iter().position(|&voxel| voxel as usize >= voxels) {
        Some(row) => Err(Error::input(
            "voxel_of_point",
            format!("point {row} is in voxel {} of {voxels}", voxel_of_point[row]),
        )),
        None => Ok(()),
    }
}

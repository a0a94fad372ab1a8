//! What the paper prints (Sefercik and Akgun, CoRL 2022), in millimetres and degrees.

use super::scores::{OURS, OURS_ICP, TAG, TRUE_ICP};

/// Table of segmentation: class, precision, recall, accuracy.
pub const SEGMENTATION: [(&str, [f64; 3]); 4] = [
    ("end-effector", [0.96, 0.99, 1.00]),
    ("arm", [0.87, 0.99, 0.99]),
    ("background", [1.00, 0.99, 0.99]),
    ("all", [0.94, 0.99, 0.99]),
];

/// Table of poses: mean and standard deviation of translation, rotation and ADD.
pub const BY_TRUE_LABELS: [(&str, [[f64; 2]; 3]); 4] = [
    ("RPT", [[23.6, 3.6], [7.75, 5.05], [24.7, 5.2]]),
    ("RPT + ICP", [[8.7, 2.0], [3.20, 2.42], [9.7, 3.0]]),
    ("KPM", [[13.5, 3.7], [7.46, 1.54], [15.3, 3.3]]),
    ("KPM + ICP", [[9.6, 2.7], [2.42, 0.98], [9.9, 2.6]]),
];
/// The same by labels that the network found.
pub const BY_FOUND_LABELS: [(&str, [[f64; 2]; 3]); 4] = [
    ("RPT", [[24.9, 7.7], [7.18, 4.62], [25.8, 9.0]]),
    ("RPT + ICP", [[10.1, 3.2], [3.47, 2.75], [10.7, 3.5]]),
    ("KPM", [[14.3, 4.8], [7.44, 1.44], [16.0, 4.7]]),
    ("KPM + ICP", [[10.0, 2.7], [2.74, 1.59], [10.4, 2.7]]),
];

/// Table of calibrations: translation and rotation.
pub const CALIBRATION: [(&str, [f64; 2]); 4] =
    [(TAG, [18.3, 3.26]), (OURS, [23.5, 3.37]), (OURS_ICP, [7.4, 1.69]), (TRUE_ICP, [7.7, 1.19])];

/// The row of that name.
pub fn row<T: Copy>(table: &[(&str, T)], name: &str) -> Option<T> {
    table.iter().find(|(known, _)| *known == name).map(|(_, figures)| *figures)
}

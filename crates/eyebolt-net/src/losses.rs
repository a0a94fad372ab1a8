//! What training makes small. Every loss comes with its gradient.

mod classes;
mod loss;
mod lovasz;
mod of_values;
mod rotation;

pub use classes::{cross_entropy, soft_cross_entropy};
pub use loss::Loss;
pub use lovasz::lovasz_softmax;
pub use of_values::{laplace, smooth_l1};
pub use rotation::{PoseLoss, pose_loss};

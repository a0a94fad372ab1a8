//! What a person looks at to believe a calibration, or not.

mod backdrop;
mod font;
mod legend;
mod overlay;
mod picture;
mod residual;

pub use overlay::overlay;
pub use picture::Picture;

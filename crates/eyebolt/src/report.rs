//! What a person looks at to believe a calibration, or not.

mod backdrop;
mod font;
mod html;
mod labelled;
mod legend;
mod overlay;
mod picture;
mod residual;

pub use backdrop::from_depth as depth_picture;
pub use html::{Context, STYLE, TruthComparison, batch_page, html, remedies, tables_page};
pub use labelled::{classes, labelled};
pub use overlay::{Drawn, OUTLINE, OutlinePixels, overlay, overlays};
pub use picture::Picture;

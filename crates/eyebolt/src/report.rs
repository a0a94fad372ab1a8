//! What a person looks at to believe a calibration, or not.

mod backdrop;
mod coarse;
mod font;
mod html;
mod labelled;
mod leftovers;
mod legend;
mod overlay;
mod picture;
mod residual;
mod seen;
mod viewer;

pub use backdrop::from_depth as depth_picture;
pub use html::{Context, STYLE, TruthComparison, batch_page, html, remedies, tables_page};
pub use labelled::{classes, labelled};
pub use overlay::{Drawn, OUTLINE, OutlinePixels, overlay, overlays};
pub use picture::Picture;
pub use viewer::Viewer;

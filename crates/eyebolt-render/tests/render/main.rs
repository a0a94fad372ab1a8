//! Laws of the rasteriser and of the contour, against rays and formulas of their own.

mod contour;
mod oracle;
mod raster;
mod scene;

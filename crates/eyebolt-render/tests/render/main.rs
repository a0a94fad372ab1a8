//! Laws of the rasteriser, of the contour and of the sensors, against rays and formulas of their
//! own.

mod contour;
mod oracle;
mod raster;
mod scene;
mod sensor;

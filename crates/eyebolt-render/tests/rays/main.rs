//! Laws of rays, against every triangle tried one by one, formulas, the rasteriser and Embree.

mod embree;
mod image;
mod nearest;
mod oracle;
mod scenes;
mod shadow;
mod watertight;

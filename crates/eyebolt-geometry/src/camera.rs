//! Pinhole camera with lens distortion.

//! Depth cameras: what a real one makes of what an ideal one sees.
//!
//! A [`Sensor`] is a row of figures from the literature and the family of physics that they belong
//! to. One specimen of it looks at a posed scene once ([`Sensor::look`]): what stays the same from
//! frame to frame, shadows and fattened edges among it, is worked out there. Frames are then cheap
//! ([`Exposure::frame`]).

mod by_name;
mod exposure;
mod field;
mod figures;
mod geometry;
mod laws;
mod look;
mod model;
mod models;
mod multipath;
mod specimen;
mod time_of_flight;
mod triangulation;
mod window;

pub use by_name::UnknownSensor;
pub use exposure::Exposure;
pub use field::Field;
pub use figures::{TimeOfFlight, Triangulation, Window};
pub use laws::{AxialNoise, LateralNoise};
pub use model::{Family, Mode, Sensor};
pub use specimen::{IntrinsicsError, Specimen};

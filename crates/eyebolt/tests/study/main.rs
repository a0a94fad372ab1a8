//! Studies: what a session is, how it ends, what is counted.

mod counted;
mod sessions;
mod tampered;

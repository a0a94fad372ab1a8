//! Sessions from their first message to an answer.

mod law;
mod replay;
mod simulated;

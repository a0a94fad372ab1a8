//! Xacro, the macro language of robot descriptions, expanded: includes, properties, macros, conditions,
//! `$(arg)`, `$(find)` and expressions, as <https://github.com/ros/xacro> has them.
//!
//! `xacro-rs` lacks conditional expressions (`a if b else c`), without which the descriptions of most
//! makers do not expand.

mod calls;
mod error;
mod expand;
mod expression;
mod literal;
mod macros;
mod operators;
mod scope;
mod text;
mod tree;
mod value;
mod yaml;

pub use expand::XacroArguments;
pub(crate) use expand::expand;
pub(crate) use tree::is_xacro;

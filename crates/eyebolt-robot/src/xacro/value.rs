//! What an expression may be worth: the few types of Python that descriptions use.

use std::fmt::{self, Display};
use std::rc::Rc;

#[derive(Clone, Debug)]
pub(crate) enum Value {
    None,
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(Rc<str>),
    List(Rc<Vec<Value>>),
    /// Pairs in the order of the file.
    Dict(Rc<Vec<(Value, Value)>>),
    /// A function by its name, without the module that it is in.
    Function(Rc<str>),
    /// A module: `math`, `xacro`, `python`.
    Module(&'static str),
}

impl Value {
    pub(crate) fn text(text: impl AsRef<str>) -> Self {
        Self::Text(Rc::from(text.as_ref()))
    }

    pub(crate) fn list(items: Vec<Self>) -> Self {
        Self::List(Rc::new(items))
    }

    /// As a number, where it counts as one.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Self::Bool(truth) => Some(f64::from(u8::from(*truth))),
            Self::Int(number) => Some(*number as f64),
            Self::Float(number) => Some(*number),
            _ => None,
        }
    }

    /// As a whole number, where it is one by its type.
    pub(crate) fn whole(&self) -> Option<i64> {
        match self {
            Self::Bool(truth) => Some(i64::from(*truth)),
            Self::Int(number) => Some(*number),
            _ => None,
        }
    }

    pub(crate) fn is_true(&self) -> bool {
        match self {
            Self::None => false,
            Self::Text(text) => !text.is_empty(),
            Self::List(items) => !items.is_empty(),
            Self::Dict(pairs) => !pairs.is_empty(),
            Self::Function(_) | Self::Module(_) => true,
            number => number.number() != Some(0.0),
        }
    }

    /// The value of a key of a dictionary.
    pub(crate) fn entry(&self, key: &Self) -> Option<Self> {
        let Self::Dict(pairs) = self else { return None };
        pairs.iter().find(|(known, _)| known == key).map(|(_, value)| value.clone())
    }

    /// What Python calls the type.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Bool(_) => "bool",
            Self::Int(_) => "int",
            Self::Float(_) => "float",
            Self::Text(_) => "str",
            Self::List(_) => "list",
            Self::Dict(_) => "dict",
            Self::Function(_) => "function",
            Self::Module(_) => "module",
        }
    }

    /// As Python's `repr`.
    fn quoted(&self) -> String {
        match self {
            Self::Text(text) if text.contains('\'') && !text.contains('"') => format!("\"{text}\""),
            Self::Text(text) => format!("'{}'", text.replace('\\', "\\\\").replace('\'', "\\'")),
            other => other.to_string(),
        }
    }
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        if let (Some(a), Some(b)) = (self.number(), other.number()) {
            return a == b;
        }
        match (self, other) {
            (Self::None, Self::None) => true,
            (Self::Text(a), Self::Text(b)) | (Self::Function(a), Self::Function(b)) => a == b,
            (Self::List(a), Self::List(b)) => a == b,
            (Self::Dict(_), Self::Dict(b)) => {
                let Self::Dict(a) = self else { return false };
                a.len() == b.len() && b.iter().all(|(k, v)| self.entry(k).as_ref() == Some(v))
            }
            _ => false,
        }
    }
}

/// As Python's `str`: this is what stands in the expanded file.
impl Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("None"),
            Self::Bool(true) => f.write_str("True"),
            Self::Bool(false) => f.write_str("False"),
            Self::Int(number) => write!(f, "{number}"),
            Self::Float(number) => f.write_str(&float(*number)),
            Self::Text(text) => f.write_str(text),
            Self::List(items) => {
                let items: Vec<String> = items.iter().map(Self::quoted).collect();
                write!(f, "[{}]", items.join(", "))
            }
            Self::Dict(pairs) => {
                let pair =
                    |(key, value): &(Self, Self)| format!("{}: {}", key.quoted(), value.quoted());
                let pairs: Vec<String> = pairs.iter().map(pair).collect();
                write!(f, "{{{}}}", pairs.join(", "))
            }
            Self::Function(name) => write!(f, "<function {name}>"),
            Self::Module(name) => write!(f, "<module {name}>"),
        }
    }
}

/// The shortest digits that are read as the same number, laid out as Python does: with an exponent
/// below 0.0001 and from 10^16 on.
fn float(number: f64) -> String {
    if !number.is_finite() {
        return if number.is_nan() {
            "nan"
        } else if number > 0.0 {
            "inf"
        } else {
            "-inf"
        }
        .to_owned();
    }
    let scientific = format!("{number:e}");
    let exponent =
        scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match (scientific.split_once('e'), exponent) {
        (Some((digits, _)), Some(exponent)) if number != 0.0 && !(-4..16).contains(&exponent) => {
            let sign = if exponent < 0 { '-' } else { '+' };
            format!("{digits}e{sign}{:02}", exponent.abs())
        }
        _ => format!("{number:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_look_as_in_python() {
        for (number, text) in [
            (0.0, "0.0"),
            (-0.0, "-0.0"),
            (1.0, "1.0"),
            (0.1 + 0.2, "0.30000000000000004"),
            (1e-4, "0.0001"),
            (1e-5, "1e-05"),
            (-1.5e-7, "-1.5e-07"),
            (1e15, "1000000000000000.0"),
            (1e16, "1e+16"),
            (1.25e200, "1.25e+200"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(float(number), text);
        }
    }
}

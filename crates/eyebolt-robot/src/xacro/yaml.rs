//! YAML files that descriptions load.

use super::error::Fault;
use super::value::Value;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::collections::HashMap;
use std::fmt;
use std::rc::Rc;

/// Tags with a unit, and how many SI units one is.
const UNITS: [(&str, f64); 8] = [
    ("!radians", 1.0),
    ("!degrees", std::f64::consts::PI / 180.0),
    ("!meters", 1.0),
    ("!millimeters", 0.001),
    ("!millimetres", 0.001),
    ("!centimeters", 0.01),
    ("!inches", 0.0254),
    ("!foot", 0.3048),
];

/// What `text` says.
pub(super) fn parse(text: &str) -> Result<Value, Fault> {
    let text = text.lines().map(in_si_units).collect::<Result<Vec<_>, _>>()?.join("\n");
    // As PyYAML reads it: of a key that is there twice the last counts, and `y` is a name.
    let options = serde_saphyr::options! {
        duplicate_keys: serde_saphyr::options::DuplicateKeyPolicy::LastWins,
        strict_booleans: true,
    };
    let Read(value) = serde_saphyr::from_str_with_options(&text, options)
        .map_err(|error| Fault::new(format!("not YAML: {error}; correct the file")))?;
    Ok(value)
}

/// A line with the numbers that have a unit in SI units: readers differ in what they make of tags.
fn in_si_units(line: &str) -> Result<String, Fault> {
    let mut line = line.to_owned();
    for (tag, si_units) in UNITS {
        while let Some(at) = line.find(&format!("{tag} ")) {
            let (before, after) = line.split_at(at);
            let after = after.get(tag.len()..).unwrap_or_default().trim_start();
            let end = after.find([',', '}', ']', '#']).unwrap_or(after.len());
            let (number, rest) = after.split_at(end);
            let value = super::expression::parse(number.trim().trim_matches(['"', '\'']))
                .and_then(|expression| super::text::constant(&expression))?;
            let number = value.number().ok_or_else(|| {
                Fault::new(format!("`{tag} {}` is not a number; write one", number.trim()))
            })?;
            line = format!("{before}{}{rest}", Value::Float(number * si_units));
        }
    }
    Ok(line)
}

struct Read(Value);

impl<'de> Deserialize<'de> for Read {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ReadVisitor).map(Self)
    }
}

struct ReadVisitor;

impl<'de> Visitor<'de> for ReadVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("numbers, texts, lists and mappings")
    }

    fn visit_bool<E>(self, truth: bool) -> Result<Value, E> {
        Ok(Value::Bool(truth))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Value, E> {
        Ok(Value::Int(number))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Value, E> {
        Ok(i64::try_from(number).map_or(Value::Float(number as f64), Value::Int))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Value, E> {
        Ok(Value::Float(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::text(text))
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::None)
    }

    fn visit_none<E>(self) -> Result<Value, E> {
        Ok(Value::None)
    }

    fn visit_some<D: Deserializer<'de>>(self, inner: D) -> Result<Value, D::Error> {
        inner.deserialize_any(Self)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(Read(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(Value::list(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut pairs: Vec<(Value, Value)> = Vec::new();
        let mut places: HashMap<String, usize> = HashMap::new();
        while let Some((Read(key), Read(value))) = entries.next_entry()? {
            let place = *places.entry(format!("{} {key}", key.kind())).or_insert(pairs.len());
            match pairs.get_mut(place) {
                Some(known) => known.1 = value,
                None => pairs.push((key, value)),
            }
        }
        Ok(Value::Dict(Rc::new(pairs)))
    }
}

//! Text that stands for a number or a truth.

use super::error::Fault;
use super::value::Value;

/// What the text of a property is worth: a number, a truth, what stands in single quotes, or itself.
pub(super) fn literal(text: &str) -> Value {
    if let Some(inside) = text.strip_prefix('\'').and_then(|rest| rest.strip_suffix('\'')) {
        return Value::text(inside);
    }
    // Python reads 1_000 as a number; names like that are meant as text.
    if text.contains('_') {
        return Value::text(text);
    }
    if let Some(number) = whole(text) {
        return Value::Int(number);
    }
    if let Some(number) = float(text) {
        return Value::Float(number);
    }
    match text {
        "true" | "True" => Value::Bool(true),
        "false" | "False" => Value::Bool(false),
        _ => Value::text(text),
    }
}

/// As Python's `int` reads text.
pub(super) fn whole(text: &str) -> Option<i64> {
    text.trim().parse().ok()
}

/// As Python's `float` reads text.
pub(super) fn float(text: &str) -> Option<f64> {
    let text = text.trim();
    let digits = text.trim_start_matches(['+', '-']);
    let named = ["inf", "infinity", "nan"].iter().any(|name| digits.eq_ignore_ascii_case(name));
    let starts = digits.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    if named || starts { text.parse().ok() } else { None }
}

/// What a condition is worth.
pub(super) fn truth(value: &Value, condition: &str) -> Result<bool, Fault> {
    let Value::Text(text) = value else { return Ok(value.is_true()) };
    match text.as_ref() {
        "true" | "True" => Ok(true),
        "false" | "False" => Ok(false),
        other => whole(other).map(|number| number != 0).ok_or_else(|| {
            Fault::new(format!(
                "the condition `{condition}` is `{other}`; write true, false or 1, 0"
            ))
        }),
    }
}

//! What operators make of values.

use super::error::Fault;
use super::value::Value;
use std::cmp::Ordering;

fn cannot(operator: &str, a: &Value, b: &Value) -> Fault {
    Fault::new(format!("`{operator}` of {} `{a}` and {} `{b}` makes no sense", a.kind(), b.kind()))
}

/// `a operator b`.
pub(super) fn binary(operator: &str, a: &Value, b: &Value) -> Result<Value, Fault> {
    match (operator, a, b) {
        ("+", Value::Text(a), Value::Text(b)) => return Ok(Value::text(format!("{a}{b}"))),
        ("+", Value::List(a), Value::List(b)) => {
            return Ok(Value::list(a.iter().chain(b.iter()).cloned().collect()));
        }
        ("*", Value::Text(text), count) | ("*", count, Value::Text(text)) => {
            // No longer than any description's text.
            let count = count.whole().filter(|count| *count < 1000);
            let count = count.ok_or_else(|| cannot(operator, a, b))?;
            return Ok(Value::text(text.repeat(usize::try_from(count).unwrap_or(0))));
        }
        _ => {}
    }
    let (Some(x), Some(y)) = (a.number(), b.number()) else { return Err(cannot(operator, a, b)) };
    if matches!(operator, "/" | "//" | "%") && y == 0.0 {
        return Err(format!("`{a} {operator} {b}` divides by zero").into());
    }
    if let (Some(m), Some(n)) = (a.whole(), b.whole())
        && let Some(whole) = whole(operator, m, n)
    {
        return Ok(Value::Int(whole));
    }
    Ok(Value::Float(match operator {
        "+" => x + y,
        "-" => x - y,
        "*" => x * y,
        "/" => x / y,
        "//" => (x / y).floor(),
        // The sign of Python's remainder is that of the divisor.
        "%" => x - y * (x / y).floor(),
        "**" => x.powf(y),
        _ => return Err(cannot(operator, a, b)),
    }))
}

/// Of whole numbers, where the result is one that fits.
fn whole(operator: &str, m: i64, n: i64) -> Option<i64> {
    match operator {
        "+" => m.checked_add(n),
        "-" => m.checked_sub(n),
        "*" => m.checked_mul(n),
        "//" => {
            let quotient = m.checked_div(n)?;
            Some(quotient - i64::from(m % n != 0 && (m < 0) != (n < 0)))
        }
        "%" => {
            let remainder = m.checked_rem(n)?;
            Some(if remainder != 0 && (remainder < 0) != (n < 0) {
                remainder + n
            } else {
                remainder
            })
        }
        "**" => m.checked_pow(u32::try_from(n).ok()?),
        _ => None,
    }
}

/// Whether `a operator b` holds.
pub(super) fn compare(operator: &str, a: &Value, b: &Value) -> Result<bool, Fault> {
    let order = || match (a, b) {
        (Value::Text(a), Value::Text(b)) => Some(a.cmp(b)),
        _ => a.number()?.partial_cmp(&b.number()?),
    };
    let is_in = || match b {
        Value::List(items) => Ok(items.contains(a)),
        Value::Dict(_) => Ok(b.entry(a).is_some()),
        Value::Text(text) => match a {
            Value::Text(part) => Ok(text.contains(part.as_ref())),
            _ => Err(cannot("in", a, b)),
        },
        _ => Err(cannot("in", a, b)),
    };
    match operator {
        "==" | "is" => return Ok(a == b),
        "!=" | "is not" => return Ok(a != b),
        "in" => return is_in(),
        "not in" => return is_in().map(|is_in| !is_in),
        _ => {}
    }
    // Nothing is above or below what is not a number.
    let numbers = a.number().is_some() && b.number().is_some();
    let Some(order) = order() else {
        return if numbers { Ok(false) } else { Err(cannot(operator, a, b)) };
    };
    Ok(match operator {
        "<" => order == Ordering::Less,
        "<=" => order != Ordering::Greater,
        ">" => order == Ordering::Greater,
        _ => order != Ordering::Less,
    })
}

/// The item at `index`: of a list (from the end, if negative), a text or a dictionary.
pub(super) fn index(of: &Value, index: &Value) -> Result<Value, Fault> {
    let missing = || Fault::new(format!("`{of}` has no `{index}`"));
    let place = |length: usize| {
        let at = index.whole()?;
        usize::try_from(if at < 0 { at + i64::try_from(length).ok()? } else { at }).ok()
    };
    match of {
        Value::Dict(_) => of.entry(index),
        Value::List(items) => place(items.len()).and_then(|at| items.get(at).cloned()),
        Value::Text(text) => place(text.chars().count())
            .and_then(|at| text.chars().nth(at))
            .map(|letter| Value::text(letter.to_string())),
        _ => None,
    }
    .ok_or_else(missing)
}

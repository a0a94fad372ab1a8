//! The functions and methods that expressions may call.

use super::error::Fault;
use super::literal;
use super::value::Value;

/// Names of functions that need nothing but their arguments.
const FUNCTIONS: [&str; 38] = [
    "abs", "acos", "asin", "atan", "atan2", "bool", "ceil", "copysign", "cos", "degrees", "dict",
    "exp", "fabs", "float", "floor", "fmod", "hypot", "int", "len", "list", "log", "log10", "max",
    "min", "pow", "radians", "range", "round", "sin", "sorted", "sqrt", "str", "sum", "tan",
    "tokenize", "tuple", "message", "warning",
];

/// What a name means that no property has: a constant, a function or a module.
pub(super) fn built_in(name: &str) -> Option<Value> {
    Some(match name {
        "pi" => Value::Float(std::f64::consts::PI),
        "e" => Value::Float(std::f64::consts::E),
        "tau" => Value::Float(std::f64::consts::TAU),
        "inf" => Value::Float(f64::INFINITY),
        "nan" => Value::Float(f64::NAN),
        "True" => Value::Bool(true),
        "False" => Value::Bool(false),
        "None" => Value::None,
        "math" => Value::Module("math"),
        "xacro" => Value::Module("xacro"),
        "python" => Value::Module("python"),
        "load_yaml" | "arg" | "abs_filename" | "fatal" | "error" => Value::Function(name.into()),
        _ if FUNCTIONS.contains(&name) => Value::Function(name.into()),
        _ => return None,
    })
}

/// The value of function `name` with arguments by name: a dictionary; others take none.
pub(super) fn with_names(
    name: &str,
    given: &[Value],
    named: Vec<(Value, Value)>,
) -> Result<Value, Fault> {
    let mut pairs = match (name, given) {
        ("dict", []) => Vec::new(),
        ("dict", [Value::Dict(pairs)]) => pairs.to_vec(),
        _ => return Err(format!("{name} with arguments by name is not understood").into()),
    };
    pairs.retain(|(key, _)| named.iter().all(|(other, _)| other != key));
    pairs.extend(named);
    Ok(Value::Dict(std::rc::Rc::new(pairs)))
}

/// The value of function `name`.
pub(super) fn call(name: &str, arguments: &[Value]) -> Result<Value, Fault> {
    let wrong = || {
        let given: Vec<String> = arguments.iter().map(ToString::to_string).collect();
        Fault::new(format!("{name}({}) is not understood", given.join(", ")))
    };
    let number = |at: usize| arguments.get(at).and_then(Value::number).ok_or_else(wrong);
    let one = |function: fn(f64) -> f64| Ok(Value::Float(function(number(0)?)));
    let two = |function: fn(f64, f64) -> f64| Ok(Value::Float(function(number(0)?, number(1)?)));
    match name {
        "sin" => one(f64::sin),
        "cos" => one(f64::cos),
        "tan" => one(f64::tan),
        "asin" => one(f64::asin),
        "acos" => one(f64::acos),
        "atan" => one(f64::atan),
        "sqrt" => one(f64::sqrt),
        "exp" => one(f64::exp),
        "log" => one(f64::ln),
        "log10" => one(f64::log10),
        "fabs" => one(f64::abs),
        "radians" => one(|degrees| degrees * (std::f64::consts::PI / 180.0)),
        "degrees" => one(|radians| radians * (180.0 / std::f64::consts::PI)),
        "atan2" => two(f64::atan2),
        "hypot" => two(f64::hypot),
        "pow" => two(f64::powf),
        "fmod" => two(|a, b| a % b),
        "copysign" => two(f64::copysign),
        "floor" => Ok(Value::Int(number(0)?.floor() as i64)),
        "ceil" => Ok(Value::Int(number(0)?.ceil() as i64)),
        "message" | "warning" => Ok(Value::text("")),
        _ => convert(name, arguments).ok_or_else(wrong),
    }
}

fn convert(name: &str, arguments: &[Value]) -> Option<Value> {
    let first = arguments.first();
    match (name, first?) {
        ("abs", Value::Int(number)) => number.checked_abs().map(Value::Int),
        ("abs", number) => Some(Value::Float(number.number()?.abs())),
        ("bool", value) => Some(Value::Bool(value.is_true())),
        ("str", value) => Some(Value::text(value.to_string())),
        ("int", Value::Text(text)) => literal::whole(text).map(Value::Int),
        ("int", number) => Some(Value::Int(number.number()?.trunc() as i64)),
        ("float", Value::Text(text)) => literal::float(text).map(Value::Float),
        ("float", number) => number.number().map(Value::Float),
        ("len", Value::Text(text)) => Some(Value::Int(text.chars().count() as i64)),
        ("len", Value::List(items)) => Some(Value::Int(items.len() as i64)),
        ("len", Value::Dict(pairs)) => Some(Value::Int(pairs.len() as i64)),
        ("list" | "tuple", value) => items(value).map(Value::list),
        ("dict", Value::Dict(pairs)) => Some(Value::Dict(pairs.clone())),
        ("sum", value) => {
            let whole = items(value)?;
            let add = |sum: Value, item: &Value| super::operators::binary("+", &sum, item).ok();
            whole.iter().try_fold(Value::Int(0), add)
        }
        ("min" | "max" | "sorted", value) => {
            let mut all = if arguments.len() > 1 { arguments.to_vec() } else { items(value)? };
            sort(&mut all)?;
            match name {
                "min" => all.first().cloned(),
                "max" => all.last().cloned(),
                _ => Some(Value::list(all)),
            }
        }
        ("round", number) => round(number, arguments.get(1)),
        ("range", _) => range(arguments),
        ("tokenize", Value::Text(text)) => {
            let words = text.split([',', ';', ' ']).filter(|word| !word.is_empty());
            Some(Value::list(words.map(Value::text).collect()))
        }
        _ => None,
    }
}

fn items(value: &Value) -> Option<Vec<Value>> {
    match value {
        Value::List(items) => Some(items.to_vec()),
        Value::Dict(pairs) => Some(pairs.iter().map(|(key, _)| key.clone()).collect()),
        Value::Text(text) => Some(text.chars().map(|c| Value::text(c.to_string())).collect()),
        _ => None,
    }
}

fn sort(values: &mut [Value]) -> Option<()> {
    let comparable = values.windows(2).all(|pair| match pair {
        [a, b] => super::operators::compare("<", a, b).is_ok(),
        _ => true,
    });
    values.sort_by(|a, b| match super::operators::compare("<", a, b) {
        Ok(true) => std::cmp::Ordering::Less,
        _ if a == b => std::cmp::Ordering::Equal,
        _ => std::cmp::Ordering::Greater,
    });
    comparable.then_some(())
}

/// To even at the half, as Python does.
fn round(number: &Value, digits: Option<&Value>) -> Option<Value> {
    let Some(digits) = digits else {
        return Some(Value::Int(number.number()?.round_ties_even() as i64));
    };
    let digits = i32::try_from(digits.whole()?).ok().filter(|digits| digits.abs() <= 300)?;
    // Through text, since what is rounded is the decimal number.
    let places = usize::try_from(digits).ok()?;
    format!("{:.places$}", number.number()?).parse().ok().map(Value::Float)
}

fn range(arguments: &[Value]) -> Option<Value> {
    const MOST: i64 = 10_000;
    let whole: Vec<i64> = arguments.iter().map(Value::whole).collect::<Option<_>>()?;
    let (first, end, step) = match whole.as_slice() {
        [end] => (0, *end, 1),
        [first, end] => (*first, *end, 1),
        [first, end, step] => (*first, *end, *step),
        _ => return None,
    };
    let count = end.checked_sub(first)?.checked_div(step)?;
    if count > MOST {
        return None;
    }
    let inside = |at: &i64| if step > 0 { *at < end } else { *at > end };
    let next = |at: &i64| at.checked_add(step);
    let all = std::iter::successors(Some(first), next).take_while(inside);
    Some(Value::list(all.map(Value::Int).collect()))
}

/// The value of `of.name(arguments)`.
pub(super) fn method(of: &Value, name: &str, arguments: &[Value]) -> Result<Value, Fault> {
    let found = match of {
        Value::Text(text) => text_method(text, name, arguments),
        Value::Dict(pairs) => match (name, arguments) {
            ("keys", []) => items(of).map(Value::list),
            ("values", []) => Some(Value::list(pairs.iter().map(|(_, v)| v.clone()).collect())),
            ("items", []) => {
                let pair = |(k, v): &(Value, Value)| Value::list(vec![k.clone(), v.clone()]);
                Some(Value::list(pairs.iter().map(pair).collect()))
            }
            ("get", [key]) => Some(of.entry(key).unwrap_or(Value::None)),
            ("get", [key, other]) => Some(of.entry(key).unwrap_or_else(|| other.clone())),
            _ => None,
        },
        _ => None,
    };
    found.ok_or_else(|| Fault::new(format!("{} `{of}` has no method {name} of these", of.kind())))
}

fn text_method(text: &str, name: &str, arguments: &[Value]) -> Option<Value> {
    let word = |at: usize| match arguments.get(at) {
        Some(Value::Text(text)) => Some(text.clone()),
        _ => None,
    };
    Some(match name {
        "lower" => Value::text(text.to_lowercase()),
        "upper" => Value::text(text.to_uppercase()),
        "strip" if arguments.is_empty() => Value::text(text.trim()),
        "strip" => Value::text(text.trim_matches(|c| word(0).is_some_and(|w| w.contains(c)))),
        "startswith" => Value::Bool(text.starts_with(word(0)?.as_ref())),
        "endswith" => Value::Bool(text.ends_with(word(0)?.as_ref())),
        "replace" => Value::text(text.replace(word(0)?.as_ref(), &word(1)?)),
        "count" => Value::Int(text.matches(word(0)?.as_ref()).count() as i64),
        "find" => Value::Int(text.find(word(0)?.as_ref()).map_or(-1, |at| at as i64)),
        "split" if arguments.is_empty() => {
            Value::list(text.split_whitespace().map(Value::text).collect())
        }
        "split" => Value::list(text.split(word(0)?.as_ref()).map(Value::text).collect()),
        "join" => {
            let parts = items(arguments.first()?)?;
            let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
            Value::text(parts.join(text))
        }
        "format" => {
            let fill = |text: String, value: &Value| text.replacen("{}", &value.to_string(), 1);
            Value::text(arguments.iter().fold(text.to_owned(), fill))
        }
        _ => return None,
    })
}

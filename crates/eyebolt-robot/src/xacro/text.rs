//! Text with `${expressions}` and `$(extensions)` in it.

use super::calls;
use super::error::Fault;
use super::expression::{self, Expression};
use super::literal;
use super::operators;
use super::scope::{Scope, Slot};
use super::value::Value;
use std::rc::Rc;

/// What text may ask for that lies outside the file.
pub(super) trait Outside {
    /// The value of `$(command rest)`.
    fn extension(&self, command: &str, rest: &str) -> Result<String, Fault>;

    /// What a YAML file says.
    fn yaml(&self, file: &str) -> Result<Value, Fault>;

    /// The whole path of a file that is named from the one being read.
    fn path(&self, file: &str) -> String;
}

/// What `text` is worth in `scope`: of a single expression, its value with its type.
pub(super) fn evaluate(text: &str, scope: &Rc<Scope>, out: &dyn Outside) -> Result<Value, Fault> {
    let mut results: Vec<Value> = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let (value, length) = next(rest, scope, out)?;
        results.push(value);
        rest = rest.get(length..).unwrap_or_default();
    }
    match results.as_slice() {
        [only] => Ok(only.clone()),
        several => Ok(Value::text(several.iter().map(ToString::to_string).collect::<String>())),
    }
}

/// The value of the first part of `text`, and its length in bytes.
fn next(text: &str, scope: &Rc<Scope>, out: &dyn Outside) -> Result<(Value, usize), Fault> {
    let dollars = text.bytes().take_while(|byte| *byte == b'$').count();
    let after = text.get(dollars..).unwrap_or_default();
    let opens = after.starts_with(['{', '(']);
    if dollars == 0 || !opens {
        let plain = dollars.max(1);
        let end =
            text.get(plain..).and_then(|rest| rest.find('$')).map_or(text.len(), |at| at + plain);
        return Ok((Value::text(text.get(..end).unwrap_or_default()), end));
    }
    if dollars > 1 {
        // Two dollars stand for one that means nothing.
        return Ok((Value::text(text.get(1..dollars + 1).unwrap_or_default()), dollars + 1));
    }
    let (close, what) = if after.starts_with('{') { ('}', "${") } else { (')', "$(") };
    let end =
        text.find(close).ok_or_else(|| Fault::new(format!("`{what}` has no `{close}`; add it")))?;
    let inside = text.get(2..end).unwrap_or_default();
    // Extensions within expressions are text of the expression.
    let inside = evaluate(inside, scope, out)?.to_string();
    let value = match close {
        '}' => expression(&inside, scope, out)?,
        _ => {
            let inside = inside.trim();
            let (command, rest) = inside.split_once(char::is_whitespace).unwrap_or((inside, ""));
            match command {
                "eval" => expression(rest, scope, out)?,
                _ => Value::text(out.extension(command, rest.trim())?),
            }
        }
    };
    Ok((value, end + 1))
}

fn expression(text: &str, scope: &Rc<Scope>, out: &dyn Outside) -> Result<Value, Fault> {
    let value = expression::parse(text).and_then(|tree| worth(&tree, scope, out));
    value.map_err(|mut fault| {
        if !fault.problem.contains("${") {
            fault.problem = format!("`${{{}}}`: {}", text.trim(), fault.problem);
        }
        fault
    })
}

/// What an expression without names is worth.
pub(super) fn constant(expression: &Expression) -> Result<Value, Fault> {
    struct Nothing;
    impl Outside for Nothing {
        fn extension(&self, command: &str, _: &str) -> Result<String, Fault> {
            Err(format!("`$({command})` does not belong here").into())
        }

        fn yaml(&self, _: &str) -> Result<Value, Fault> {
            Err("load_yaml does not belong here".into())
        }

        fn path(&self, file: &str) -> String {
            file.to_owned()
        }
    }
    worth(expression, &Rc::new(Scope::default()), &Nothing)
}

fn worth(tree: &Expression, scope: &Rc<Scope>, out: &dyn Outside) -> Result<Value, Fault> {
    let value = |tree: &Expression| worth(tree, scope, out);
    match tree {
        Expression::Int(number) => Ok(Value::Int(*number)),
        Expression::Float(number) => Ok(Value::Float(*number)),
        Expression::Text(text) => Ok(Value::text(text)),
        Expression::Name(name) => named(name, scope, out),
        Expression::List(items) => {
            Ok(Value::list(items.iter().map(value).collect::<Result<_, _>>()?))
        }
        Expression::Dict(pairs) => {
            let pair = |(key, item): &(Expression, Expression)| Ok((value(key)?, value(item)?));
            Ok(Value::Dict(Rc::new(pairs.iter().map(pair).collect::<Result<_, Fault>>()?)))
        }
        Expression::Conditional(parts) => {
            let [if_true, condition, otherwise] = parts.as_ref();
            value(if value(condition)?.is_true() { if_true } else { otherwise })
        }
        Expression::Operation(operator, operands) => match (*operator, operands.as_slice()) {
            ("not", [operand]) => Ok(Value::Bool(!value(operand)?.is_true())),
            ("-" | "+", [operand]) => operators::binary(operator, &Value::Int(0), &value(operand)?)
                .map(|result| negative_zero(operator, result)),
            ("and" | "or", [first, second]) => {
                let first = value(first)?;
                let decides = first.is_true() == (*operator == "or");
                if decides { Ok(first) } else { value(second) }
            }
            (_, [a, b]) => operators::binary(operator, &value(a)?, &value(b)?),
            _ => Err(format!("`{operator}` has the wrong operands").into()),
        },
        Expression::Comparison(first, others) => {
            let mut before = value(first)?;
            for (operator, other) in others {
                let other = value(other)?;
                if !operators::compare(operator, &before, &other)? {
                    return Ok(Value::Bool(false));
                }
                before = other;
            }
            Ok(Value::Bool(true))
        }
        Expression::Index(of, index) => operators::index(&value(of)?, &value(index)?),
        Expression::Attribute(of, name) => attribute(of, name, scope, out),
        Expression::Call(function, arguments, named) => {
            let given: Vec<Value> = arguments.iter().map(value).collect::<Result<_, _>>()?;
            if !named.is_empty() {
                let pair =
                    |(name, tree): &(String, Expression)| Ok((Value::text(name), value(tree)?));
                let named = named.iter().map(pair).collect::<Result<Vec<_>, Fault>>()?;
                return match value(function)? {
                    Value::Function(name) => calls::with_names(&name, &given, named),
                    other => Err(format!("`{other}` is no function").into()),
                };
            }
            if let Expression::Attribute(of, name) = function.as_ref()
                && !matches!(attribute(of, name, scope, out), Ok(Value::Function(_)))
            {
                return calls::method(&value(of)?, name, &given);
            }
            match value(function)? {
                Value::Function(name) => called(&name, &given, out),
                other => Err(format!("`{other}` is no function").into()),
            }
        }
    }
}

/// The negative of zero is a number of its own, which `0 - 0.0` is not.
fn negative_zero(operator: &str, result: Value) -> Value {
    match result {
        Value::Float(0.0) if operator == "-" => Value::Float(-0.0),
        other => other,
    }
}

fn called(name: &str, arguments: &[Value], out: &dyn Outside) -> Result<Value, Fault> {
    match (name, arguments) {
        ("load_yaml", [file]) => out.yaml(&file.to_string()),
        ("arg", [name]) => out.extension("arg", &name.to_string()).map(Value::text),
        ("abs_filename", [file]) => Ok(Value::text(out.path(&file.to_string()))),
        ("fatal" | "error", said) => {
            let said: Vec<String> = said.iter().map(ToString::to_string).collect();
            Err(format!("the file says: {}", said.join(" ")).into())
        }
        _ => calls::call(name, arguments),
    }
}

fn attribute(
    of: &Expression,
    name: &str,
    scope: &Rc<Scope>,
    out: &dyn Outside,
) -> Result<Value, Fault> {
    if let Expression::Name(first) = of
        && let Some(inner) = scope.find_namespace(first)
    {
        return named(name, &inner, out);
    }
    let of = worth(of, scope, out)?;
    let missing = || Fault::new(format!("`{of}` has no `{name}`"));
    match &of {
        Value::Module(_) => calls::built_in(name).ok_or_else(missing),
        _ => of.entry(&Value::text(name)).ok_or_else(missing),
    }
}

/// What a name means: a property, else something built in.
fn named(name: &str, scope: &Rc<Scope>, out: &dyn Outside) -> Result<Value, Fault> {
    match property(name, scope, out)? {
        Some(value) => Ok(value),
        None => calls::built_in(name).ok_or_else(|| {
            Fault::new(format!("nothing is called `{name}`; define it with <xacro:property>"))
        }),
    }
}

/// What property `name` is worth, if there is one.
pub(super) fn property(
    name: &str,
    scope: &Rc<Scope>,
    out: &dyn Outside,
) -> Result<Option<Value>, Fault> {
    let Some((level, slot)) = scope.find(name) else { return Ok(None) };
    match slot {
        Slot::Ready(value) => Ok(Some(value)),
        Slot::Block(_) => Ok(None),
        Slot::Resolving => {
            Err(format!("property `{name}` is defined by itself; change one definition").into())
        }
        Slot::Lazy(text) => {
            level.set(name, Slot::Resolving);
            let value = evaluate(&text, &level, out).map(|value| match value {
                Value::Text(text) => literal::literal(&text),
                other => other,
            });
            // As it was, if it cannot be evaluated: the error is the same whenever it is asked for.
            let slot = value.as_ref().map_or(Slot::Lazy(text), |value| Slot::Ready(value.clone()));
            level.set(name, slot);
            value.map(Some)
        }
    }
}

//! Flags that are numbers.

/// Parses a number from `low` to `high`.
pub fn number(
    low: f64,
    high: f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text: &str| {
        let found = text.trim().parse().ok().filter(|value| (low..=high).contains(value));
        found.ok_or_else(|| format!("must be a number from {low} to {high}"))
    }
}

/// Parses `LOW,HIGH`, or one number for both, each from `low` to `high`.
pub fn range(
    low: f64,
    high: f64,
) -> impl Fn(&str) -> Result<[f64; 2], String> + Clone + Send + Sync + 'static {
    move |text: &str| {
        let (least, greatest) = text.split_once(',').unwrap_or((text, text));
        match (number(low, high)(least), number(low, high)(greatest)) {
            (Ok(least), Ok(greatest)) if least <= greatest => Ok([least, greatest]),
            _ => Err(format!("must be LOW,HIGH, or one number for both, from {low} to {high}")),
        }
    }
}

/// Parses two numbers, the second of which may be left out if it is 0, each within its limits.
pub fn pair(
    first: [f64; 2],
    second: [f64; 2],
) -> impl Fn(&str) -> Result<[f64; 2], String> + Clone + Send + Sync + 'static {
    move |text: &str| {
        let (one, other) = text.split_once(',').unwrap_or((text, "0"));
        Ok([number(first[0], first[1])(one)?, number(second[0], second[1])(other)?])
    }
}

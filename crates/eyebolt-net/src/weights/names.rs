//! What to say where the names of a file are not those of a network.

use super::entry::Entry;
use std::collections::BTreeSet;

/// Names that are listed; of more than these, their number.
const LISTED: usize = 3;

/// What to say about the first parameter that is missing: which others are, and what there is that
/// nobody asked for.
pub fn missing(entries: &[Entry], all: &BTreeSet<String>) -> String {
    let missing: Vec<&str> = entries
        .iter()
        .filter(|entry| entry.name_in(all).is_none())
        .map(|entry| entry.forms[0].name.as_str())
        .collect();
    let wanted: BTreeSet<&str> = entries.iter().filter_map(|entry| entry.name_in(all)).collect();
    // Copies, such as an optimiser's memory in a checkpoint, would only repeat the others.
    let is_copy =
        |name: &str| name.split_once('.').is_some_and(|(_, original)| all.contains(original));
    let others = all.iter().map(String::as_str);
    let others: Vec<&str> =
        others.filter(|name| !wanted.contains(name) && !is_copy(name)).collect();
    let mut problem = "missing".to_owned();
    if let [_, more @ ..] = &missing[..]
        && !more.is_empty()
    {
        problem += &format!(", as are {}", list(more));
    }
    match others[..] {
        [] => problem += "; the file has nothing in their place",
        _ => problem += &format!("; there instead: {}", list(&others)),
    }
    if let Some(hint) = hint(&missing, all) {
        problem += &format!("; {hint}");
    }
    problem
}

/// The first name that belongs to no parameter, and what to say about it; nothing if there is none.
pub fn unexpected(left: &BTreeSet<String>) -> Option<(String, String)> {
    let names: Vec<&str> = left.iter().map(String::as_str).collect();
    let (first, more) = names.split_first()?;
    let mut problem = "not of this network".to_owned();
    if !more.is_empty() {
        problem += &format!(", and neither are {}", list(more));
    }
    Some(((*first).to_owned(), problem))
}

/// What may have happened to names that are missing.
fn hint<'a>(missing: &[&str], left: &'a BTreeSet<String>) -> Option<String> {
    // By all that is missing: a single name may end as another does by chance.
    let all_have =
        |prefix: &&str| missing.iter().all(|name| left.contains(&format!("{prefix}{name}")));
    let ending = |other: &'a String| other.strip_suffix(missing.first()?);
    if let Some(prefix) = left.iter().filter_map(ending).find(all_have) {
        return Some(format!(
            "strip the prefix `{prefix}` from the names, as convert_weights.py does"
        ));
    }
    let minkowski = |name: &str| name.contains(".bn.");
    if missing.iter().any(|name| minkowski(name)) {
        let ours = |name: &&str| left.contains(&name.replacen(".bn.", ".", 1));
        let is_ours = missing.iter().any(ours);
        return is_ours.then(|| "these are eyebolt's own names: use from_bytes".into());
    }
    let is_theirs = left.iter().any(|name| minkowski(name));
    is_theirs.then(|| "names with `.bn.` are MinkowskiEngine's: use from_minkowski".into())
}

fn list(names: &[&str]) -> String {
    let listed = names[..names.len().min(LISTED)].join(", ");
    match names.len().saturating_sub(LISTED) {
        0 => listed,
        more => format!("{listed} and {more} more"),
    }
}

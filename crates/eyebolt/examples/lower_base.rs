//! Arms whose base is lower than described, as that of another variant: found out, or within what is expected.
//!
//! ```text
//! cargo run --release -p eyebolt --example lower_base -- [--sessions 20] [--first 0] [--seed 3] [--lower-mm 50]
//! ```
//!
//! Sessions are those of a study, each with the base lower by as much; each is refused, or its error is within
//! the 95 percent quantile of what the answer says of itself, or it is wrong.

#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::study::{Answered, Ending, Kind, LEVELS, Session, try_session};
use eyebolt_registration::LinkCache;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut flags: BTreeMap<String, f64> = BTreeMap::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(flag) = arguments.next() {
        let value = arguments.next().ok_or("a flag without its value")?;
        flags.insert(flag, value.parse()?);
    }
    let flag = |name: &str, usual: f64| flags.get(name).copied().unwrap_or(usual);
    let (count, seed) = (flag("--sessions", 20.0) as u64, flag("--seed", 3.0) as u64);
    let first = flag("--first", 0.0) as u64;
    let lower_m = 1e-3 * flag("--lower-mm", 50.0);
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-lab-links"));
    let ended: Vec<(Session, Ending)> = (first..first + count)
        .into_par_iter()
        .map(|number| {
            let mut session = Session::draw(seed, number, Some(Kind::LowerBase));
            session.faults.base_lower_m = lower_m;
            let result = try_session(session, &cache, &|| 0.0);
            (result.session, result.ending)
        })
        .collect();
    let mut tally: BTreeMap<&str, usize> = BTreeMap::new();
    for (session, ending) in &ended {
        let (what, how) = told(ending);
        *tally.entry(what).or_default() += 1;
        let (robot, sensor) = (session.robot.name, session.sensor.name);
        println!("{:3} {robot:8} {sensor:12} {what:9} {how}", session.number);
    }
    println!("{:.1} mm lower: {tally:?}", 1e3 * lower_m);
    Ok(())
}

/// In a word, and in numbers.
fn told(ending: &Ending) -> (&'static str, String) {
    let Ending::Answered(Answered { error, expected, quantiles, refusals, still_part, .. }) =
        ending
    else {
        return ("unfit", String::new());
    };
    let mm = |metres: Option<f64>| metres.map_or(f64::NAN, |metres| 1e3 * metres);
    let level = LEVELS.len() - 1;
    let most = quantiles.and_then(|quantiles| Some(quantiles.get(level)?.translation_m));
    let off = error.map(|error| error.translation_m);
    let reasons: Vec<&str> = refusals.iter().map(|refusal| refusal.name.as_str()).collect();
    let found = still_part.map(|still| {
        let shift: [f64; 3] = still.shift_m.map(|x| (1e4 * x).round() / 10.0).into();
        format!(
            "base {shift:?} mm, evidence {:.1}, {:.1}, {:.1}",
            still.seen_through, still.nearer, still.more
        )
    });
    let how = format!(
        "off {:.1} mm, expected {:.1} mm, 95 % within {:.1} mm; {}; {}",
        mm(off),
        mm(expected.map(|expected| expected.translation_m)),
        mm(most),
        found.unwrap_or_default(),
        reasons.join(", ")
    );
    let within = off.zip(most).is_some_and(|(off, most)| off <= most);
    match (refusals.is_empty(), within) {
        (false, _) => ("refused", how),
        (true, true) => ("within", how),
        (true, false) => ("WRONG", how),
    }
}

//! Lines of JSON for machines.

use anyhow::Result;
use eyebolt::calibrate::{Deviation, Elsewhere};
use eyebolt::study::{Answered, Ending, LEVELS, Refusal, SessionResult, Study, Summary, Tally};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// How far off, or `null`.
#[derive(Serialize)]
struct Off {
    translation_mm: f64,
    rotation_deg: f64,
}

fn off(deviation: Deviation) -> Off {
    Off {
        translation_mm: 1e3 * deviation.translation_m,
        rotation_deg: deviation.rotation_rad.to_degrees(),
    }
}

/// What one session was and how it ended.
pub fn session(result: &SessionResult) -> Result<String> {
    let session = &result.session;
    let mut line = json!({
        "session": session.number,
        "kind": session.kind.name(),
        "spoiled": session.kind.is_spoiled(),
        "robot": session.robot.name,
        "sensor": session.sensor.name,
        "configurations": session.configurations,
        "frames": session.frames,
        "backgrounds": session.backgrounds,
        "clutter": session.clutter,
        "faults": session.faults.named(),
        "tampering": session.tampering.as_ref().map(ToString::to_string),
        "simulated": true,
        "right": result.ending.is_right(),
        "trusted": result.ending.is_trusted(),
        "reasons": reasons(result.ending.refusals()),
        "error": null,
        "simulate_s": seconds(result.simulate_s),
        "calibrate_s": seconds(result.calibrate_s),
    });
    match &result.ending {
        Ending::Unfit(why) => {
            line["simulated"] = false.into();
            line["unfit"] = why.as_str().into();
        }
        Ending::Failed(_) => {}
        Ending::Answered(answered) => tell(answered, &mut line)?,
    }
    Ok(format!("{line}\n"))
}

fn tell(answered: &Answered, line: &mut Value) -> Result<()> {
    line["error"] = serde_json::to_value(answered.error.map(off))?;
    line["expected"] = serde_json::to_value(answered.expected.map(off))?;
    if let Some(after) = answered.error_after_bump {
        line["error_after_bump"] = serde_json::to_value(off(after))?;
    }
    if let Some(Elsewhere { shift_m, seen_through, nearer, more }) = answered.still_part {
        line["base_shift_mm"] = serde_json::to_value(shift_m.map(|m| 1e3 * m).as_slice())?;
        line["base_shift_evidence"] =
            json!({ "seen_through": seen_through, "nearer": nearer, "more": more });
    }
    if let Some(quantiles) = answered.quantiles {
        let named = LEVELS.iter().zip(quantiles);
        let named = named
            .map(|(level, quantile)| Ok((percent(*level), serde_json::to_value(off(quantile))?)));
        line["expected_quantiles"] = named.collect::<Result<Map<String, Value>>>()?.into();
    }
    Ok(())
}

/// "50" for 0.5.
fn percent(level: f64) -> String {
    format!("{:.0}", 100.0 * level)
}

fn seconds(seconds: f64) -> f64 {
    (1e3 * seconds).round() / 1e3
}

fn reasons(refusals: &[Refusal]) -> Value {
    let reason = |refusal: &Refusal| json!({ "name": refusal.name, "text": refusal.text });
    refusals.iter().map(reason).collect()
}

/// What became of all sessions.
pub fn summary(study: &Study, summary: &Summary) -> Result<String> {
    let kinds =
        summary.kinds.iter().map(|(kind, of_kind)| Ok((kind.name().to_owned(), tally(of_kind)?)));
    let line = json!({
        "summary": true,
        "seed": study.seed,
        "first": study.first,
        "good": tally(&summary.all(false))?,
        "spoiled": tally(&summary.all(true))?,
        "kinds": kinds.collect::<Result<Map<String, Value>>>()?,
    });
    Ok(format!("{line}\n"))
}

fn tally(tally: &Tally) -> Result<Value> {
    let shares = |counts: [u64; 3]| -> Map<String, Value> {
        let share = |count: u64| count as f64 / tally.coverage.answers.max(1) as f64;
        LEVELS.iter().zip(counts).map(|(l, count)| (percent(*l), share(count).into())).collect()
    };
    Ok(json!({
        "sessions": tally.sessions,
        "unfit": tally.unfit,
        "right": tally.right,
        "trusted": tally.trusted,
        "false_acceptances": tally.false_acceptances,
        "false_refusals": tally.false_refusals,
        "right_but_refused": tally.right_but_refused,
        "median_trusted_error": serde_json::to_value(tally.median_error().map(off))?,
        "coverage": {
            "answers": tally.coverage.answers,
            "translation": shares(tally.coverage.translation),
            "rotation": shares(tally.coverage.rotation),
        },
        "reasons": tally.refusals,
        "simulate_s": seconds(tally.simulate_s),
        "calibrate_s": seconds(tally.calibrate_s),
    }))
}

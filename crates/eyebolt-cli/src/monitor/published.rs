//! What a ROS 2 system is told of the calibration that is watched: `/diagnostics`, `/eyebolt/monitor`.

use super::lines;
use crate::live::domain::now_ns;
use anyhow::Result;
use eyebolt::monitor::ViewReport;
use eyebolt_live::{Bus, Outgoing};
use eyebolt_recording::{Diagnostic, DiagnosticLevel, diagnostic_message, text_message};
use std::time::{Duration, Instant};

/// How often diagnostics are told: aggregators take for stale what says nothing for five seconds.
const EVERY: Duration = Duration::from_secs(1);
/// A state that was seen longer ago is no longer known.
const KNOWN_FOR: Duration = Duration::from_secs(600);
/// What aggregators group by.
const NAME: &str = "eyebolt: hand-eye calibration";

/// Tells a bus how the calibration stands.
pub struct Published {
    camera: String,
    views: usize,
    counted: usize,
    /// The last view, and when it was looked at.
    last: Option<(ViewReport, Instant)>,
    told: Option<Instant>,
    /// Why the last rest could not be looked at.
    trouble: Option<String>,
}

impl Published {
    /// Of the camera whose optical frame is called so.
    pub fn new(camera: &str) -> Self {
        Self {
            camera: camera.to_owned(),
            views: 0,
            counted: 0,
            last: None,
            told: None,
            trouble: None,
        }
    }

    /// Tells of a view.
    pub fn see(&mut self, bus: &Bus, report: &ViewReport) -> Result<()> {
        bus.publish(Outgoing::Watched, text_message(&serde_json::to_string(report)?));
        self.views += 1;
        self.counted += usize::from(report.counts);
        self.last = Some((report.clone(), Instant::now()));
        self.trouble = None;
        self.tell(bus);
        Ok(())
    }

    /// Tells why a rest could not be looked at, until one is.
    pub fn fail(&mut self, bus: &Bus, why: &str) {
        self.trouble = Some(why.to_owned());
        self.tell(bus);
    }

    /// Says again how it stands, if it is time to.
    pub fn repeat(&mut self, bus: &Bus) {
        if self.told.is_none_or(|told| told.elapsed() >= EVERY) {
            self.tell(bus);
        }
    }

    fn tell(&mut self, bus: &Bus) {
        let report = self.last.as_ref().map(|(report, _)| report);
        let known = self.last.as_ref().filter(|(_, at)| at.elapsed() < KNOWN_FOR);
        let known = known.map(|(report, _)| report);
        let (level, message) = match &self.trouble {
            // What was found out stays found out.
            Some(why) if !report.is_some_and(|report| report.alarm) => {
                (DiagnosticLevel::Warn, format!("not looked at: {why}"))
            }
            _ => state(known.or(report.filter(|report| report.alarm)), self.counted),
        };
        let mut values = report.map_or_else(Vec::new, values);
        values.push(("views", self.views.to_string()));
        values.push(("views that count", self.counted.to_string()));
        if let Some((_, at)) = &self.last {
            values.push(("seconds since the last view", at.elapsed().as_secs().to_string()));
        }
        let diagnostic = Diagnostic {
            level,
            name: NAME,
            message: &message,
            hardware_id: &self.camera,
            values: &values,
        };
        bus.publish(Outgoing::Diagnostics, diagnostic_message(now_ns(), &diagnostic));
        self.told = Some(Instant::now());
    }
}

/// How it stands after the last view, of which `counted` counted.
fn state(last: Option<&ViewReport>, counted: usize) -> (DiagnosticLevel, String) {
    match last {
        None => (DiagnosticLevel::Stale, "no resting arm was looked at lately".to_owned()),
        Some(report) if report.alarm => {
            (DiagnosticLevel::Error, format!("something moved: {}", lines::suspects(report)))
        }
        Some(_) if counted == 0 => {
            (DiagnosticLevel::Warn, "unknown: no view counts so far".to_owned())
        }
        Some(_) => (DiagnosticLevel::Ok, "still true".to_owned()),
    }
}

/// What the last view came to.
fn values(report: &ViewReport) -> Vec<(&'static str, String)> {
    let number = |name, value: Option<f64>| value.map(|value| (name, format!("{value:.3}")));
    let drift = report.drift.as_ref();
    let numbers = [
        number("residual (mm)", report.residual_mm),
        number("expected residual (mm)", report.expected_residual_mm),
        number("drift (mm)", drift.map(|drift| drift.translation_mm)),
        number("drift, standard deviation (mm)", drift.map(|drift| drift.translation_sigma_mm)),
        number("drift (deg)", drift.map(|drift| drift.rotation_deg)),
        number("drift, standard deviation (deg)", drift.map(|drift| drift.rotation_sigma_deg)),
        number("evidence (log10, alarm from 0 on)", report.log10_evidence),
    ];
    let view = ("view", report.frame.clone());
    std::iter::once(view).chain(numbers.into_iter().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::lines::tests::report;

    #[test]
    fn it_is_unknown_before_it_is_true_or_not() {
        let (quiet, alarm) = (report(), ViewReport { alarm: true, ..report() });
        assert_eq!(state(None, 0).0, DiagnosticLevel::Stale);
        assert_eq!(state(Some(&quiet), 0).0, DiagnosticLevel::Warn);
        assert_eq!(state(Some(&quiet), 1).0, DiagnosticLevel::Ok);
        assert_eq!(state(Some(&alarm), 3).0, DiagnosticLevel::Error);
    }

    #[test]
    fn what_is_not_known_is_not_told() {
        let report = ViewReport { expected_residual_mm: Some(1.5), ..report() };
        let told: Vec<_> = values(&report).into_iter().map(|(name, _)| name).collect();
        let known = [
            "view",
            "residual (mm)",
            "expected residual (mm)",
            "evidence (log10, alarm from 0 on)",
        ];
        assert_eq!(told, known);
    }
}

//! Reports, told one by one.

use super::lines;
use crate::ending::Ending;
use crate::output;
use eyebolt::monitor::ViewReport;
use eyebolt::record::RecordError;

/// Tells reports, and what came of them at the end.
pub struct Teller {
    json: bool,
    views: usize,
    counted: usize,
    last: Option<ViewReport>,
}

/// Why watching ended early.
pub enum Ended {
    Record(RecordError),
    Output(anyhow::Error),
}

impl From<RecordError> for Ended {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}

impl Ended {
    /// As an error, where `failed` says of which recording.
    pub fn into_error(self, failed: impl FnOnce(RecordError) -> anyhow::Error) -> anyhow::Error {
        match self {
            Self::Record(error) => failed(error),
            Self::Output(error) => error,
        }
    }
}

impl Teller {
    pub fn new(json: bool) -> Self {
        Self { json, views: 0, counted: 0, last: None }
    }

    /// Tells a report: a line of text or of JSON.
    pub fn tell(&mut self, report: ViewReport) -> anyhow::Result<()> {
        let line = match self.json {
            true => serde_json::to_string(&report)?,
            false => lines::view(&report),
        };
        output::deliver(format!("{line}\n").as_bytes())?;
        self.views += 1;
        self.counted += usize::from(report.counts);
        self.last = Some(report);
        Ok(())
    }

    /// Sums up.
    pub fn end(&self, alarm: bool) -> Ending {
        if !self.json {
            output::say(&lines::ending(self.last.as_ref(), self.views, self.counted));
        }
        if alarm { Ending::Refused } else { Ending::Done }
    }
}

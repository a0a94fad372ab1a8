//! One recording of many.

use super::arguments::Arguments;
use super::folder::Folder;
use crate::calibrate::{answer, outcome, page, pictures};
use crate::ending::causes;
use crate::front::Terminal;
use crate::progress::Bar;
use anyhow::Result;
use eyebolt::answer::Answer;
use eyebolt::batch::{Line, Listed};
use eyebolt::calibrate::Verdict;
use eyebolt_recording::Recording;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Calibrates a recording and writes its files, the line last. That there is no calibration is a line; what cannot be
/// written is an error.
pub fn calibrate(arguments: &Arguments, folder: &Folder, listed: &Listed) -> Result<Line> {
    // Nothing of a recording that is given up is looked at again.
    let found = catch_unwind(AssertUnwindSafe(|| find(arguments, &listed.recording)));
    let line = match found {
        Ok(Ok(found)) => found.write(folder, listed)?,
        Ok(Err(error)) => Line::failed(listed, causes(&error)),
        Err(_) => Line::failed(listed, BUG.to_owned()),
    };
    folder.finish(listed, &line)?;
    Ok(line)
}

/// Of thousands of recordings, one that finds a bug must not end all.
const BUG: &str = "a bug in eyebolt, which `eyebolt calibrate` shows too. Please report it";

/// What was found in a recording.
struct Found {
    answer: Answer,
    verdict: Verdict,
    report: Option<String>,
}

fn find(arguments: &Arguments, recording: &str) -> Result<Found> {
    let path = Path::new(recording);
    let bar = Bar::new();
    let opened = Recording::open(path, &arguments.bag.options_of(&arguments.robot))?;
    let arm = arguments.robot.arm(path, &opened)?;
    let opened = arguments.robot.noted(opened, &arm)?;
    let request = arguments.way.request(&opened, &arm);
    let outcome = outcome(&arguments.way.learned, path, &request, &bar)?;
    let answer = answer(&arguments.robot, &request, &outcome);
    let report = arguments.report.then(|| {
        let pictures = pictures(&opened, &outcome, &Terminal);
        page(recording, &answer, &outcome, &pictures)
    });
    bar.finish();
    Ok(Found { answer, verdict: outcome.calibration.verdict, report })
}

impl Found {
    fn write(&self, folder: &Folder, listed: &Listed) -> Result<Line> {
        let name = &listed.name;
        let ending = if self.verdict == Verdict::Trusted { "json" } else { "rejected.json" };
        let json = self.answer.to_json();
        let calibration = folder.write(format!("{name}.{ending}"), json.as_bytes())?;
        let page = |page: &String| folder.write(format!("{name}.html"), page.as_bytes());
        let report = self.report.as_ref().map(page).transpose()?;
        Ok(Line::answered(listed, &self.answer, &self.verdict, &calibration, report.as_deref()))
    }
}

//! `eyebolt monitor --ros-domain`.

use super::arguments::{Arguments, FEW, check_base};
use super::published::Published;
use super::teller::{Ended, Teller};
use crate::ending::{Ending, causes};
use crate::front::Terminal;
use crate::output;
use crate::progress::Interrupt;
use crate::robots::told;
use anyhow::{Context, Result, anyhow};
use eyebolt::export::{FrameName, SavedCalibration};
use eyebolt::monitor::{Known, Monitor, Watched, look};
use eyebolt::observations::Observations;
use eyebolt::record::{RecordError, observe};
use eyebolt_live::{Bus, Incoming, Rests};
use eyebolt_recording::{BagOptions, BagRecording, Recording, SessionWriter};
use eyebolt_robot::Arm;
use std::io::Cursor;
use std::path::Path;
use std::time::Duration;

/// How long a message is waited for before it is looked whether somebody ended it.
const WAIT: Duration = Duration::from_millis(100);
/// What errors call messages that were heard and are in no file.
const HEARD: &str = "what was heard";

/// Watches what is published, until Ctrl-C.
pub fn watch(arguments: &Arguments, calibration: &SavedCalibration) -> Result<Ending> {
    let mut ears = Ears::new(arguments, calibration)?;
    let mut teller = Teller::new(arguments.json);
    let options = arguments.options();
    let failed = |error: RecordError| anyhow::Error::new(error).context(HEARD);
    let cache = arguments.cache.open();
    let (arm, first, observations) = loop {
        let Some((arm, first)) = ears.first_rests(calibration)? else {
            return Ok(teller.end(false));
        };
        match observe(first.source(), &arm, &cache, &options) {
            Ok(observations) => break (arm, first, observations),
            Err(error) => ears.complain(&failed(error)),
        }
    };
    let known = Known::new(calibration, &observations, arguments.even_if_refused)?;
    let mut monitor = Monitor::new(&arm, &observations, known, &arguments.rate());
    let mut next = Some(first);
    while let Some(recording) = next {
        if same_camera(&recording, &observations) {
            let watched = Watched {
                source: recording.source(),
                arm: &arm,
                observations: &observations,
                options: &options,
                per_rest: usize::from(arguments.per_rest),
            };
            let looked = look::<Ended>(&watched, &mut monitor, |report| {
                let published = ears.published.see(&ears.bus, &report);
                published.and_then(|()| teller.tell(report)).map_err(Ended::Output)
            });
            match looked {
                Ok(()) => {}
                // One rest of many.
                Err(Ended::Record(error)) => ears.complain(&failed(error)),
                Err(Ended::Output(error)) => return Err(error),
            }
        } else {
            ears.complain(&anyhow!("the camera's images are of another size or focal length now"));
        }
        next = ears.rest(&arm)?;
    }
    Ok(teller.end(monitor.alarms()))
}

/// Whether a rest was seen by the camera that the monitor knows.
fn same_camera(recording: &Recording<'_>, observations: &Observations) -> bool {
    recording.camera().is_none_or(|camera| *camera == observations.camera)
}

struct Ears<'a> {
    arguments: &'a Arguments,
    options: BagOptions,
    bus: Bus,
    interrupt: Interrupt,
    rests: Rests,
    published: Published,
}

impl<'a> Ears<'a> {
    fn new(arguments: &'a Arguments, calibration: &SavedCalibration) -> Result<Self> {
        let bus = arguments.domain.join(arguments.bag.topics())?;
        let interrupt = Interrupt::new()?;
        if !arguments.json {
            let domain = arguments.domain.domain()?;
            output::say(&format!("listening to domain {domain} until you end this (Ctrl-C)"));
        }
        let (options, rests) = (arguments.bag.options_of(&arguments.robot), Rests::default());
        let published =
            Published::new(calibration.camera_frame.as_ref().map_or("", FrameName::as_str));
        Ok(Self { arguments, options, bus, interrupt, rests, published })
    }

    /// Says why a rest is not looked at.
    fn complain(&mut self, error: &anyhow::Error) {
        let why = causes(error);
        output::complain(&format!("note: {why}: not looked at"));
        self.published.fail(&self.bus, &why);
    }

    /// What was heard around the next rest; `None` if somebody ended it.
    fn messages(&mut self) -> Option<Vec<Incoming>> {
        while self.interrupt.check().is_ok() {
            self.published.repeat(&self.bus);
            let heard = self.bus.next(WAIT).and_then(|message| self.rests.hear(&message));
            if heard.is_some() {
                return heard;
            }
        }
        None
    }

    /// The first rests, of as many configurations as tell the noise of depth, and the arm in them.
    fn first_rests(
        &mut self,
        calibration: &SavedCalibration,
    ) -> Result<Option<(Arm, Recording<'static>)>> {
        let mut heard: Vec<Incoming> = Vec::new();
        loop {
            let Some(messages) = self.messages() else { return Ok(None) };
            heard.extend(messages);
            // In memory is one rest for each configuration; of more of the same, the last.
            let recording = match self.recording(&heard) {
                Ok(recording) => recording,
                Err(error) => {
                    self.complain(&error);
                    heard.clear();
                    continue;
                }
            };
            let arm = told(self.arguments.robot.arm(Path::new(HEARD), &recording)?, &Terminal);
            check_base(calibration, &arm)?;
            let recording = self.arguments.robot.noted(recording, &arm)?;
            match configurations(&recording, &arm) {
                Ok(count) if count >= FEW => return Ok(Some((arm, recording))),
                Ok(_) => {}
                Err(error) => {
                    self.complain(&error);
                    heard.clear();
                }
            }
            if heard.iter().map(|message| message.data.len()).sum::<usize>() > MOST_BYTES {
                heard.clear();
            }
        }
    }

    /// The next rest; `None` if somebody ended it.
    fn rest(&mut self, arm: &Arm) -> Result<Option<Recording<'static>>> {
        loop {
            let Some(messages) = self.messages() else { return Ok(None) };
            match self.recording(&messages) {
                Ok(recording) => return self.arguments.robot.noted(recording, arm).map(Some),
                // One rest of many.
                Err(error) => self.complain(&error),
            }
        }
    }

    fn recording(&self, messages: &[Incoming]) -> Result<Recording<'static>> {
        let mut bytes = Vec::new();
        let mut writer = SessionWriter::new(Cursor::new(&mut bytes))?;
        for Incoming { topic, message_type, received_ns, data, .. } in messages {
            writer.write(topic, message_type, *received_ns, data)?;
        }
        writer.finish()?;
        let bag = BagRecording::from_reader(HEARD, Cursor::new(bytes), &self.options)?;
        Ok(Recording::Bag(Box::new(bag)))
    }
}

/// Bytes of rests that are kept before there are enough of them.
const MOST_BYTES: usize = 256 << 20;

/// In how many places the arm was.
fn configurations(recording: &Recording<'_>, arm: &Arm) -> Result<usize> {
    let mut places = eyebolt::record::Places::default();
    for index in 0..recording.frame_names().len() {
        places.add(arm, &recording.read_joints(index)?).context(HEARD)?;
    }
    Ok(places.len())
}

//! Sessions without a wire: a simulated recording, message by message, with the page told of it as the program does.

use crate::simulated::{messages, record};
use eyebolt::pipeline::{self, Request};
use eyebolt_live::{
    Account, Assessment, Event, Finding, Goal, Incoming, Session, Web, WebAddress, study,
};
use eyebolt_recording::{BagOptions, GrowingRecording, JointNotes, SessionWriter};
use eyebolt_registration::LinkCache;
use eyebolt_robot::{Arm, PackageRoots, Robot};
use std::fs::File;
use std::path::Path;

/// A page on any free port.
pub fn serve() -> Web {
    serve_at("127.0.0.1:0")
}

pub fn serve_at(address: &str) -> Web {
    let address: WebAddress = address.parse().unwrap();
    Web::serve(address, Account::new(&Goal::default(), "session.mcap".to_owned())).unwrap()
}

/// A session as it goes on.
pub struct Fed<'a> {
    web: &'a Web,
    pub session: Session,
    writer: SessionWriter<File>,
    growing: GrowingRecording,
    arm: Option<Arm>,
}

/// The messages of a recording that is written in `folder`.
pub fn heard(folder: &Path, seed: u64) -> Vec<Incoming> {
    let path = folder.join("recorded.mcap");
    record(&path, seed);
    messages(&path)
}

/// Whether a message is a depth image.
pub fn is_image(message: &&Incoming) -> bool {
    message.message_type == "sensor_msgs/msg/Image"
}

impl<'a> Fed<'a> {
    /// Recorded in `folder`, shown on `web`.
    pub fn new(web: &'a Web, folder: &Path) -> Self {
        let path = folder.join("session.mcap");
        let writer = SessionWriter::new(File::create(&path).unwrap()).unwrap();
        let growing = GrowingRecording::new(&path, BagOptions::default());
        let session = Session::new(Goal::default(), JointNotes::default());
        Self { web, session, writer, growing, arm: None }
    }

    /// Hears a message. Nothing is calibrated: that is under way until [`Self::calibrate`].
    pub fn hear(&mut self, message: &Incoming) {
        let board = self.web.board();
        let Incoming { topic, message_type, data, received_ns, .. } = message;
        for event in self.session.hear(message) {
            match event {
                Event::Description(text) => {
                    let robot =
                        Robot::from_urdf_str(&text, None, &PackageRoots::default()).unwrap();
                    let arm = robot.arm(Some("link0"), Some("hand")).unwrap();
                    board.update(|account| account.base = Some(arm.base_name().to_owned()));
                    self.session.set_arm(arm.clone());
                    self.arm = Some(arm);
                }
                Event::Taken { configuration } => board.update(|account| {
                    account.say(&format!("configuration {} taken: go on", configuration + 1));
                }),
                _ => {}
            }
        }
        self.writer.write(topic, message_type, *received_ns, data).unwrap();
        if is_image(&message) && board.wants_sight(*received_ns) {
            board.show(message.clone(), self.session.joints().clone());
        }
        board.tell(&self.session);
    }

    /// Calibrates what came so far, and has the page told what follows.
    pub fn calibrate(&mut self) {
        self.writer.flush().unwrap();
        let arm = self.arm.clone().unwrap();
        let recording = self.growing.now().unwrap();
        let outcome = pipeline::run(&Request::new(&recording, &arm), &()).unwrap();
        let assessment = Assessment::of(&outcome, &arm);
        self.web.board().update(|account| account.assess(&assessment));
        self.session.calibrated(Some(assessment));
        self.web.board().tell(&self.session);
        let joints = self.session.joints().clone();
        let cache = LinkCache::disabled();
        study(self.web.board(), &Finding { outcome, arm, joints, cache, seed: 1 });
    }
}

//! One participant on a thread of its own.

use super::guard;
use super::listeners::{Account, Listeners};
use super::publishers::{Outgoing, Publishers};
use crate::choice::TopicChoice;
use crate::incoming::Incoming;
use crate::queue::Queue;
use rustdds::dds::CreateError;
use rustdds::{DomainParticipant, DomainParticipantBuilder};
use std::collections::BTreeMap;
use std::net::Ipv4Addr;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How to get on the bus.
#[derive(Clone, Debug)]
pub struct BusOptions {
    /// The domain, `ROS_DOMAIN_ID`.
    pub domain: u16,
    /// Whether to talk to this machine alone.
    pub localhost_only: bool,
    /// Which topics to listen to.
    pub choice: TopicChoice,
    /// Bytes of messages that may wait to be taken.
    pub most_bytes: usize,
    /// Tells the time, nanoseconds since 1970: when messages come is part of them.
    pub clock: fn() -> i64,
}

/// Why nobody can get on the bus.
#[derive(Debug, thiserror::Error)]
pub enum BusError {
    /// The domain is none.
    #[error(
        "domain {domain}: DDS has domains 0 to {LAST_DOMAIN}. Give the ROS_DOMAIN_ID of the robot"
    )]
    Domain {
        /// The number that is none.
        domain: u16,
    },
    /// The operating system or the transport refused.
    #[error(
        "domain {domain}: cannot take part in it: {problem}. Are all its ports taken, or is there no network?"
    )]
    Transport {
        /// The domain.
        domain: u16,
        /// What was said.
        problem: String,
    },
}

/// Ports of later domains are beyond the last one that there is.
const LAST_DOMAIN: u16 = 232;
/// How long nothing is looked at while nothing comes: a tenth of a frame.
const PAUSE: Duration = Duration::from_millis(2);
/// How often new publishers are looked for.
const DISCOVERY: Duration = Duration::from_millis(200);

enum Command {
    Close(String),
    Publish(Outgoing, Vec<u8>),
}

/// Messages of a ROS 2 system, and to it.
#[derive(Debug)]
pub struct Bus {
    queue: Arc<Queue>,
    commands: Option<Sender<Command>>,
    thread: Option<JoinHandle<()>>,
    restarts: Arc<AtomicU64>,
}

impl Bus {
    /// Takes part in a domain.
    ///
    /// # Errors
    ///
    /// A domain that is none, or a transport that cannot start.
    pub fn new(options: BusOptions) -> Result<Self, BusError> {
        if options.domain > LAST_DOMAIN {
            return Err(BusError::Domain { domain: options.domain });
        }
        guard::install();
        let queue = Arc::new(Queue::new(options.most_bytes));
        let (commands, received) = mpsc::channel();
        let (begun, beginning) = mpsc::channel();
        let (domain, restarts) = (options.domain, Arc::default());
        let failed = |problem: String| BusError::Transport { domain, problem };
        let worker = Worker {
            options,
            queue: Arc::clone(&queue),
            commands: received,
            account: Account::default(),
            restarts: Arc::clone(&restarts),
            last: BTreeMap::new(),
        };
        let thread = std::thread::Builder::new().name("eyebolt-bus".to_owned());
        let thread = thread.spawn(move || worker.run(&begun)).map_err(|e| failed(e.to_string()))?;
        let bus = Self { queue, commands: Some(commands), thread: Some(thread), restarts };
        match beginning.recv() {
            Ok(Ok(())) => Ok(bus),
            Ok(Err(problem)) => Err(failed(problem)),
            Err(_) => Err(failed("its thread ended".to_owned())),
        }
    }

    /// The next message, waiting for one at most so long.
    pub fn next(&self, wait: Duration) -> Option<Incoming> {
        self.queue.pop(wait)
    }

    /// How often the transport broke and was started again. What came meanwhile is lost, and told as lost if publishers went
    /// on.
    pub fn restarts(&self) -> u64 {
        self.restarts.load(Ordering::SeqCst)
    }

    /// Listens to `topic` no longer.
    pub fn close(&self, topic: &str) {
        self.tell(Command::Close(topic.to_owned()));
    }

    /// Publishes a message in CDR, in place of the one of its kind before.
    pub fn publish(&self, what: Outgoing, data: Vec<u8>) {
        self.tell(Command::Publish(what, data));
    }

    fn tell(&self, command: Command) {
        // Its thread ends when nobody can send any more.
        drop(self.commands.as_ref().map(|commands| commands.send(command)));
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // What it panicked of, if it did, has been said.
            drop(thread.join());
        }
    }
}

struct Worker {
    options: BusOptions,
    queue: Arc<Queue>,
    commands: Receiver<Command>,
    account: Account,
    restarts: Arc<AtomicU64>,
    /// What was published last, for a transport that has to be started again.
    last: BTreeMap<Outgoing, Vec<u8>>,
}

/// Why a participant ended.
enum End {
    /// Nobody needs it any more.
    Done,
    /// Its transport broke.
    Broken,
}

impl Worker {
    fn run(mut self, begun: &Sender<Result<(), String>>) {
        let mut first = true;
        loop {
            let participating = catch_unwind(AssertUnwindSafe(|| self.take_part(begun, first)));
            match participating {
                Ok(Ok(End::Done)) => return,
                Ok(Err(error)) if first => {
                    drop(begun.send(Err(error.to_string())));
                    return;
                }
                Ok(Ok(End::Broken) | Err(_)) | Err(_) => {
                    self.restarts.fetch_add(1, Ordering::SeqCst);
                    std::thread::sleep(DISCOVERY);
                }
            }
            first = false;
        }
    }

    /// Takes part until nobody needs it or the transport breaks.
    fn take_part(
        &mut self,
        begun: &Sender<Result<(), String>>,
        first: bool,
    ) -> Result<End, CreateError> {
        let broken = guard::broken();
        let participant = self.participant()?;
        let account = std::mem::take(&mut self.account);
        let mut listeners = Listeners::new(&participant, self.options.choice.clone(), account)?;
        let mut publishers = Publishers::new(&participant)?;
        if first {
            drop(begun.send(Ok(())));
        }
        for (what, data) in &self.last {
            publishers.publish(*what, data.clone())?;
        }
        let mut looked: Option<Instant> = None;
        loop {
            if guard::broken() != broken {
                self.account = listeners.into_account();
                return Ok(End::Broken);
            }
            if looked.is_none_or(|at| at.elapsed() >= DISCOVERY) {
                listeners.discover()?;
                looked = Some(Instant::now());
            }
            match self.commands.try_recv() {
                Ok(Command::Close(topic)) => listeners.close(&topic),
                Ok(Command::Publish(what, data)) => {
                    self.last.insert(what, data.clone());
                    publishers.publish(what, data)?;
                }
                Err(TryRecvError::Disconnected) => return Ok(End::Done),
                Err(TryRecvError::Empty) => {}
            }
            if !listeners.take(&self.queue, self.options.clock) {
                std::thread::sleep(PAUSE);
            }
        }
    }

    fn participant(&self) -> Result<DomainParticipant, CreateError> {
        let builder = DomainParticipantBuilder::new(self.options.domain);
        match self.options.localhost_only {
            true => builder.with_only_networks([Ipv4Addr::LOCALHOST]).build(),
            false => builder.build(),
        }
    }
}

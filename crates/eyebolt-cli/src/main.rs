//! The eyebolt program: the calibration between a depth camera and a robot arm, without markers.

mod batch;
mod calibrate;
mod completions;
mod convert;
mod demo;
mod ending;
mod evaluate;
mod export;
mod info;
mod init;
mod inputs;
mod label;
#[cfg(feature = "live")]
mod live;
mod logging;
mod man;
mod monitor;
mod names;
mod output;
mod pose;
mod progress;
mod record_command;
mod reproduce;
mod robots;
mod segment;
mod shell;
mod simulate;
mod study;
mod summary;
mod train;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use ending::{Ending, causes};
use std::process::ExitCode;

/// Calibrates a depth camera against a robot arm: no markers, no initial guess, nobody labelling.
///
/// Exit status: 0 trusted (of info: ready), 1 something could not be read or written, 2 wrong usage,
/// 3 refused (of info: not ready; of monitor: something moved).
#[derive(Debug, Parser)]
#[command(name = "eyebolt", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Say on standard error what is decided on the way, and why; twice, in more detail. RUST_LOG, if
    /// set, says it more finely: RUST_LOG=eyebolt_recording=debug
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    verbose: u8,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// See it work: simulate an arm and a camera, calibrate them from nothing, compare with the truth
    ///
    /// Nothing is needed for it, and nothing leaves this machine. The recording, the calibration and a
    /// report are left in a folder.
    Demo(demo::Arguments),
    /// Find the pose of the camera from a recording of the arm in a few configurations
    Calibrate(Box<calibrate::Arguments>),
    /// Calibrate many recordings into a folder, by as many machines as there are, and sum up
    ///
    /// What is in the folder already is not calibrated again: a run that was ended, or killed, goes on with the same
    /// command. A recording that cannot be calibrated has a line that says why. Exit status 0: every recording of this run
    /// has its line, whatever that says.
    Batch(Box<batch::Arguments>),
    /// Look at a recording: what is in it, what fits the robot, and what to do about what does not
    Info(info::Arguments),
    /// Write a recording.toml from what lies in a folder, for you to check
    Init(init::Arguments),
    /// Print the command that records what a calibration needs
    #[command(name = "record-command")]
    ToRecord(record_command::Arguments),
    /// Write a recording as MCAP with ROS 2 messages, or as a folder of files
    Convert(convert::Arguments),
    /// Record an arm and a depth camera that are not there, to try everything without a robot
    ///
    /// The recording is an ordinary one, for `eyebolt calibrate` and everybody else. Where the camera
    /// really was is in a record of its own, which only `eyebolt evaluate` reads.
    Simulate(Box<simulate::Arguments>),
    /// Say how far a calibration of a simulated recording is from the truth, or how good a model is
    ///
    /// Refused calibrations are evaluated too: whether they were refused is part of the answer. With --model it
    /// prints the tables of Sefercik and Akgun (CoRL 2022), with their figures beside.
    Evaluate(Box<evaluate::Arguments>),
    /// Make the tables of the paper from nothing: record, label, train, evaluate
    ///
    /// Each step is a command of this program and is printed; a run that was ended goes on with the same command.
    Reproduce(reproduce::Arguments),
    /// Simulate many sessions, good and spoiled, calibrate each, and count right and wrong verdicts
    ///
    /// Half of the sessions are spoiled by one thing each. A trusted answer should be within 10 mm and
    /// 0.6 degrees of the truth, and within what it expects itself.
    Study(study::Arguments),
    /// Teach networks to know an arm from its description alone, or any arm
    ///
    /// Images are simulated while the network learns; nobody labels anything. A run that was ended goes on
    /// with the same command.
    Train(train::Arguments),
    /// Say of each pixel of a recording whether it is the arm, by a network
    Segment(segment::Arguments),
    /// Say where the end-effector is in each frame, by networks and the mesh: no calibration, no joint states
    ///
    /// A frame that does not tell, or tells two poses alike, says so and why.
    Pose(Box<pose::Arguments>),
    /// Label every frame of recordings, for networks to learn from: arm, end-effector, keypoints, pose
    ///
    /// Each recording is calibrated from nothing, or by --calibration, and every frame at rest is labelled
    /// and put into a folder that NumPy opens. What is there already is not labelled again, and several
    /// machines may fill one folder, each a shard.
    Label(Box<label::Arguments>),
    /// Say whether a calibration is still true: frames of the resting arm against it, one by one
    ///
    /// An alarm says how far the arm is from where the calibration has it, and what moved, as far as that can be told. A
    /// new calibration is proposed, never applied. Exit status 3 with an alarm.
    Monitor(Box<monitor::Arguments>),
    /// Calibrate while it happens: listen to a ROS 2 system, say when the arm may go on, end when it is good enough
    ///
    /// No ROS is needed on this machine. Move the arm from one place to another and let it rest in each: every new
    /// configuration is taken by itself, or when you press Enter. What comes in is a recording from the first message on, so
    /// that nothing is lost if the program is killed.
    #[cfg(feature = "live")]
    Live(Box<live::Arguments>),
    /// Write a calibration in the form that another program reads: tf2, URDF, hand-eye files, matrices
    Export(export::Arguments),
    /// Print what makes a shell complete commands and flags: `eyebolt completions bash > FILE`
    ///
    /// Bash reads ~/.local/share/bash-completion/completions/eyebolt, fish ~/.config/fish/completions/eyebolt.fish, and zsh a
    /// file _eyebolt in a folder of its fpath.
    Completions(completions::Arguments),
    /// Print the manual page of the program or of a command, or write all of them
    Man(man::Arguments),
}

fn main() -> ExitCode {
    let matches = Arguments::command().get_matches();
    let Arguments { command, verbose } =
        Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    logging::start(verbose);
    let ending = match command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Calibrate(arguments) => calibrate::run(&arguments),
        Command::Batch(arguments) => batch::run(&arguments, &matches),
        Command::Info(arguments) => info::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::ToRecord(arguments) => record_command::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Train(arguments) => train::run(&arguments),
        Command::Segment(arguments) => segment::run(&arguments),
        Command::Pose(arguments) => pose::run(&arguments),
        Command::Label(arguments) => label::run(&arguments),
        Command::Monitor(arguments) => monitor::run(&arguments),
        #[cfg(feature = "live")]
        Command::Live(arguments) => live::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, Arguments::command()),
        Command::Man(arguments) => man::run(&arguments, Arguments::command()),
    };
    match ending {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::Refused) => ExitCode::from(3),
        Err(error) => {
            output::complain(&format!("error: {}", causes(&error)));
            ExitCode::FAILURE
        }
    }
}

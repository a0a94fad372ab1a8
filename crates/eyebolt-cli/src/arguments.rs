//! What the program can be told.

#[cfg(feature = "live")]
use crate::live;
use crate::{
    batch, calibrate, completions, convert, demo, evaluate, export, info, init, label, man,
    monitor, plan, pose, record_command, reproduce, segment, simulate, study, train,
};
use clap::{Parser, Subcommand};

/// Calibrates a depth camera against a robot arm: no markers, no initial guess, nobody labelling.
///
/// Exit status: 0 trusted (of info: ready), 1 something could not be read or written, 2 wrong usage,
/// 3 refused (of info: not ready; of monitor: something moved; of plan: fewer than asked for).
#[derive(Debug, Parser)]
#[command(name = "eyebolt", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    /// Say on standard error what is decided on the way, and why; twice, in more detail. RUST_LOG, if
    /// set, says it more finely: RUST_LOG=eyebolt_recording=debug
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
}

#[derive(Debug, Subcommand)]
pub enum Command {
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
    /// Say which configurations to record next: those that tell most of where the camera is
    ///
    /// Each is within the joints' limits, in view, free of the arm itself, the table and what the camera saw, and so is the
    /// way to it. eyebolt moves no arm by itself: the plan is a file for whoever does. Exit status 3 if there are fewer than
    /// asked for.
    Plan(Box<plan::Arguments>),
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

//! Calibrates folder recordings whole and in parts, and says how far apart the answers are and what
//! became of each.
//!
//! ```text
//! cargo run --release -p eyebolt --example lab -- [--triples 40] [--halves yes] [--exchanges yes]
//!     [--masks no] [--seed 1] FOLDER...
//! ```
//!
//! A folder names its robot in `recording.toml`. Answers are compared with `camera_from_base` of its
//! `truth.json`, where there is one; those of parts with the answer of the whole. `--triples` takes
//! so many triples of configurations (all, if there are no more), `--halves` the even and the odd ones,
//! `--exchanges` gives each two joints the other's name.

#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::calibrate::{Calibration, Deviation, Verdict};
use eyebolt::pipeline::{Request, run};
use eyebolt::record::RecordOptions;
use eyebolt_geometry::{Base, Camera, PinholeCamera, Transform};
use eyebolt_recording::{BagOptions, Frame, FrameSource, Recording, RecordingError};
use eyebolt_registration::LinkCache;
use eyebolt_render::Random;
use eyebolt_robot::{Arm, JointPositions, PackageRoots, Robot};
use nalgebra::{Matrix4, Point3};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

type Flags = BTreeMap<String, String>;

/// Some frames of a source, with some joints called otherwise.
#[derive(Debug)]
struct Part<'a> {
    source: &'a dyn FrameSource,
    frames: Vec<usize>,
    names: Vec<String>,
    exchanged: Option<[String; 2]>,
}

impl<'a> Part<'a> {
    fn new(source: &'a dyn FrameSource, frames: Vec<usize>) -> Self {
        let names = frames.iter().map(|frame| source.frame_names()[*frame].clone()).collect();
        Self { source, frames, names, exchanged: None }
    }

    fn renamed(&self, joints: &JointPositions) -> JointPositions {
        let Some([a, b]) = &self.exchanged else { return joints.clone() };
        let other = |name: &str| match name {
            name if name == a => b.clone(),
            name if name == b => a.clone(),
            name => name.to_owned(),
        };
        joints.iter().map(|(name, position)| (other(name), position)).collect()
    }
}

impl FrameSource for Part<'_> {
    fn camera(&self) -> Option<&PinholeCamera> {
        self.source.camera()
    }

    fn frame_names(&self) -> &[String] {
        &self.names
    }

    fn has_masks(&self) -> bool {
        self.source.has_masks()
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let frame = self.source.read_frame(self.frames[index])?;
        Ok(Frame { joints: self.renamed(&frame.joints), ..frame })
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        Ok(self.renamed(&self.source.read_joints(self.frames[index])?))
    }
}

/// What one folder is run with.
struct Session<'a> {
    name: String,
    source: &'a dyn FrameSource,
    arm: Arm,
    cache: LinkCache,
    masks: bool,
    truth: Option<Transform<Camera, Base>>,
    verbose: bool,
}

impl Session<'_> {
    fn calibrate(&self, part: &Part<'_>) -> Result<Calibration, eyebolt::pipeline::Failure> {
        let request = Request {
            cache: self.cache.clone(),
            options: RecordOptions { use_masks: self.masks, ..RecordOptions::default() },
            ..Request::new(part, &self.arm)
        };
        Ok(run(&request, &())?.calibration)
    }

    fn details(found: &Calibration) {
        if let Some(error) = &found.error {
            for part in &error.parts {
                let Deviation { translation_m, rotation_rad } = part.expected;
                let deg = rotation_rad.to_degrees();
                println!("    {:?}: {:.2} mm {deg:.3} deg", part.source, 1e3 * translation_m);
            }
            println!("    disagreement {:?}", error.disagreement);
        }
        if let Some(refinement) = &found.refinement {
            let degrees = |rad: &[f64]| {
                rad.iter()
                    .map(|rad| format!("{:.2}", rad.to_degrees()))
                    .collect::<Vec<_>>()
                    .join(" ")
            };
            println!("    nuisances {:?} {:?}", refinement.nuisances, refinement.intrinsics);
            println!(
                "    joint offsets {} lengths {:?}",
                degrees(&refinement.joint_offsets.rad),
                refinement.joint_offsets.lengths_m
            );
            println!("    joint prior   {}", degrees(&refinement.offset_prior.joints_rad));
        }
        for outcome in &found.configurations {
            println!("    {outcome:?}");
        }
    }

    fn line(&self, what: &str, found: &Calibration, sought: Option<&Transform<Camera, Base>>) {
        let workspace = found.error.as_ref().map_or(Point3::origin(), |e| e.workspace_in_base);
        let away = found
            .camera_from_base
            .as_ref()
            .zip(sought)
            .map(|(pose, sought)| Deviation::between(pose, sought, &workspace));
        let shown = |deviation: Option<Deviation>| {
            deviation.map_or("      -        -   ".to_owned(), |d| {
                format!("{:8.2} mm {:6.3} deg", 1e3 * d.translation_m, d.rotation_rad.to_degrees())
            })
        };
        let verdict = match &found.verdict {
            Verdict::Trusted => "TRUSTED".to_owned(),
            Verdict::Refused(reasons) => {
                let reasons: Vec<String> =
                    reasons.iter().map(|r| r.to_string().chars().take(90).collect()).collect();
                format!("refused: {}", reasons.join(" | "))
            }
        };
        println!(
            "{:28} {what:14} off {} expected {} contradicted {:4.1} % {verdict}",
            self.name,
            shown(away),
            shown(found.error.as_ref().map(|e| e.expected)),
            100.0 * found.agreement().map_or(1.0, |agreement| agreement.contradicted_share()),
        );
        if self.verbose {
            Self::details(found);
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut flags, mut folders) = (Flags::new(), Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.strip_prefix("--") {
            Some(name) => {
                flags.insert(name.to_owned(), arguments.next().ok_or("a flag without its value")?);
            }
            None => folders.push(argument),
        }
    }
    let print =
        |folder: &String| explore(Path::new(folder), &flags).map_err(|e| format!("{folder}: {e}"));
    folders.par_iter().map(print).collect::<Result<Vec<()>, String>>()?;
    Ok(())
}

fn explore(folder: &Path, flags: &Flags) -> Result<(), Box<dyn Error>> {
    let recording = Recording::open(folder, &BagOptions::default())?;
    let section = recording.robot();
    let urdf = section.urdf.clone().ok_or("recording.toml names no robot")?;
    let robot = Robot::from_urdf_file(&urdf, &PackageRoots::new())?;
    let arm = robot.arm(section.base.as_deref(), section.end_effector.as_deref())?;
    let session = Session {
        name: folder.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
        source: recording.source(),
        arm,
        cache: LinkCache::new(std::env::temp_dir().join("eyebolt-lab-links")),
        masks: flags.get("masks").is_none_or(|word| word != "no"),
        truth: truth(&folder.join("truth.json"))?,
        verbose: flags.contains_key("verbose"),
    };
    let all: Vec<usize> = (0..session.source.frame_names().len()).collect();
    let whole = session.calibrate(&Part::new(session.source, all.clone()))?;
    session.line("whole", &whole, session.truth.as_ref());
    let sought = session.truth.or(whole.camera_from_base);
    let count = flags.get("triples").map_or(Ok(0), |n| n.parse::<usize>())?;
    let triples = triples(all.len(), count);
    let parts = triples.par_iter().map(|triple| {
        let found = session.calibrate(&Part::new(session.source, triple.to_vec()))?;
        Ok((format!("{triple:?}"), found))
    });
    let parts: Vec<(String, Calibration)> =
        parts.collect::<Result<_, eyebolt::pipeline::Failure>>()?;
    for (what, found) in &parts {
        session.line(what, found, sought.as_ref());
    }
    if flags.contains_key("halves") {
        for first in 0..2 {
            let half: Vec<usize> = all.iter().copied().skip(first).step_by(2).collect();
            let found = session.calibrate(&Part::new(session.source, half.clone()))?;
            session.line(&format!("{half:?}"), &found, sought.as_ref());
        }
    }
    if flags.contains_key("exchanges") {
        let names: Vec<String> =
            session.arm.required_joints().into_iter().map(str::to_owned).collect();
        let only = flags.get("exchanges").filter(|only| only.contains(','));
        for (i, a) in names.iter().enumerate() {
            for (j, b) in names.iter().enumerate().skip(i + 1) {
                if only.is_some_and(|only| *only != format!("{i},{j}")) {
                    continue;
                }
                let exchanged = Some([a.clone(), b.clone()]);
                let part = Part { exchanged, ..Part::new(session.source, all.clone()) };
                session.line(
                    &format!("exchange {i} {j}"),
                    &session.calibrate(&part)?,
                    sought.as_ref(),
                );
            }
        }
    }
    Ok(())
}

/// `camera_from_base` of a `truth.json`.
fn truth(path: &Path) -> Result<Option<Transform<Camera, Base>>, Box<dyn Error>> {
    let Ok(text) = std::fs::read_to_string(path) else { return Ok(None) };
    let value: serde_json::Value = serde_json::from_str(&text)?;
    let rows: [[f64; 4]; 4] = serde_json::from_value(value["camera_from_base"].clone())?;
    let matrix = Matrix4::from_fn(|r, c| rows[r][c]);
    let pose = Transform::from_matrix(&matrix, 1e-5);
    pose.map(Some).ok_or_else(|| format!("{}: not a rigid motion", path.display()).into())
}

/// `most` of all triples of `count` things, or all if there are no more.
fn triples(count: usize, most: usize) -> Vec<[usize; 3]> {
    let mut all = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            all.extend((b + 1..count).map(|c| [a, b, c]));
        }
    }
    let mut random = Random::new(1);
    while all.len() > most {
        let gone = random.index(all.len());
        all.swap_remove(gone);
    }
    all.sort_unstable();
    all
}

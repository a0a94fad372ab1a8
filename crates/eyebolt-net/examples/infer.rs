//! Says how many points of a cloud are of which class: `infer FOLDER [POINTS.txt]`.
//!
//! FOLDER holds a `model.toml` and `weights.safetensors` as the example `train` writes them;
//! POINTS.txt three numbers a line, metres. Without points it makes some up.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use eyebolt_net::models::Model;
use eyebolt_net::{Cpu, Matrix};
use std::process::ExitCode;

#[path = "shapes/scene.rs"]
mod scene;

type Failure = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let folder = std::path::PathBuf::from(arguments.next().ok_or("give FOLDER [POINTS.txt]")?);
    let text = std::fs::read_to_string(folder.join("model.toml"))?;
    let model = Model::load(&text, &std::fs::read(folder.join("weights.safetensors"))?)?;
    let points_m = match arguments.next() {
        Some(path) => parse(&std::fs::read_to_string(path)?)?,
        None => scene::scene(7).0,
    };

    let channels = model.description.features.len();
    if channels != 1 {
        return Err(format!(
            "the model takes {:?}; here is a single one",
            model.description.features
        )
        .into());
    }
    let ones = Matrix::new(points_m.len(), 1, vec![1.0; points_m.len()])?;
    let logits = model.infer(&mut Cpu::new(), &points_m, &ones)?;

    let mut counts = vec![0; logits.channels()];
    logits.argmax().into_iter().for_each(|class| counts[class as usize] += 1);
    for (class, count) in model.description.classes.iter().zip(counts) {
        println!("{class}: {count} of {}", logits.rows());
    }
    Ok(())
}

/// Lines of three numbers.
fn parse(text: &str) -> Result<Vec<[f32; 3]>, Failure> {
    let mut points = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let values: Result<Vec<f32>, _> = line.split_whitespace().map(str::parse).collect();
        match values.as_deref() {
            Ok([]) => {}
            Ok(&[x, y, z]) => points.push([x, y, z]),
            _ => return Err(format!("line {}: {line:?} is not x y z", index + 1).into()),
        }
    }
    Ok(points)
}

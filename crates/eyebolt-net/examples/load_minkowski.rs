//! Loads published weights of a MinkUNet and writes them as ours:
//! `load_minkowski NAME WEIGHTS.safetensors INPUTS OUTPUTS`, for example
//! `load_minkowski minkunet34c scannet.safetensors 3 20`.
//!
//! `convert_weights.py` beside this crate's `Cargo.toml` makes WEIGHTS.safetensors of a `.pth` file.
//! Ours end up beside it, as WEIGHTS.eyebolt.safetensors.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use eyebolt_net::models::MinkUNet;
use eyebolt_net::weights;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, path, inputs, outputs] = &arguments[..] else {
        return Err("give NAME WEIGHTS.safetensors INPUTS OUTPUTS".into());
    };
    let graph = MinkUNet::named(name, inputs.parse()?, outputs.parse()?)?.graph()?;
    let parameters = weights::from_minkowski(&graph, &std::fs::read(path)?)?;
    println!("{name}: {} numbers that are trained", parameters.trained(&graph));
    let ours = Path::new(path).with_extension("eyebolt.safetensors");
    std::fs::write(&ours, weights::to_bytes(&graph, &parameters)?)?;
    println!("written to {}", ours.display());
    Ok(())
}

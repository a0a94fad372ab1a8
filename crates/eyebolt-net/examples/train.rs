//! Trains a small MinkUNet to tell balls from boxes and writes it: `train FOLDER [STEPS]`.
#![allow(clippy::print_stdout)]

use eyebolt_net::coordinates::voxelise;
use eyebolt_net::losses::cross_entropy;
use eyebolt_net::models::{Architecture, MinkUNet, Model, ModelDescription};
use eyebolt_net::training::{Rule, Schedule, Trainer};
use eyebolt_net::{Batch, Cpu, Error, Graph, Matrix};

#[path = "shapes/scene.rs"]
mod scene;
use scene::scene;

type Failure = Box<dyn std::error::Error>;

const VOXEL_M: f32 = 0.02;
/// A label that no point has: there is nothing to leave out of the loss.
const IGNORE: u32 = u32::MAX;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let folder = std::path::PathBuf::from(arguments.next().ok_or("give FOLDER [STEPS]")?);
    if folder.join("model.toml").exists() {
        return Err(format!("{} holds a model already; give another", folder.display()).into());
    }
    let steps: u64 = arguments.next().map_or(Ok(100), |text| text.parse())?;

    let mut net = MinkUNet::named("minkunet14a", 1, 2)?;
    // An eighth of the published channels is plenty for two shapes.
    (net.stem_channels, net.stem_kernel) = (8, 3);
    net.channels = [8, 16, 16, 32, 32, 16, 16, 8];
    let graph = net.graph()?;

    let schedule = Schedule::Cosine { rate: 1e-2, warm_up: 5, total: steps };
    let mut trainer = Trainer::new(&graph, Rule::adamw(1e-4), schedule, 0);
    let mut cpu = Cpu::new();
    for step in 0..steps {
        let (points_m, labels) = scene(step);
        let batch = batch(&graph, &points_m)?;
        let loss = trainer.step(&mut cpu, &graph, &batch, |outputs| {
            Ok(vec![cross_entropy(&outputs[0], &labels, IGNORE, None)?])
        })?;
        if step % 10 == 0 {
            println!("step {step}: loss {loss:.4}");
        }
    }

    let mut description = ModelDescription {
        voxel_m: Some(VOXEL_M),
        image_columns: None,
        window_m: None,
        features: vec!["one".into()],
        classes: vec!["ball".into(), "box".into()],
        frame: "scene".into(),
        trained_on: format!("{steps} made-up scenes"),
        commit: "unknown".into(),
        metrics: [].into(),
        architecture: Architecture::Minkunet(net),
    };
    let model = Model::new(description.clone(), trainer.parameters().clone())?;
    let (mut right, mut total) = (0, 0);
    // Scenes that it has not seen.
    for seed in 1_000_000..1_000_020 {
        let (points_m, labels) = scene(seed);
        let logits = model.infer(&mut cpu, &points_m, &ones(points_m.len())?)?;
        let classes = logits.argmax();
        right += classes.iter().zip(&labels).filter(|(found, label)| found == label).count();
        total += labels.len();
    }
    let accuracy = right as f64 / total as f64;
    println!("held-out accuracy {accuracy:.4} of {total} points");

    description.metrics.insert("accuracy".into(), accuracy);
    let (text, bytes) = Model { description, ..model }.save()?;
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("model.toml"), text)?;
    std::fs::write(folder.join("weights.safetensors"), bytes)?;
    Ok(())
}

/// The only feature: there is something.
fn ones(rows: usize) -> Result<Matrix, Error> {
    Matrix::new(rows, 1, vec![1.0; rows])
}

fn batch(graph: &Graph, points_m: &[[f32; 3]]) -> Result<Batch, Error> {
    Batch::from_voxels(graph, &voxelise(0, points_m, VOXEL_M)?, &ones(points_m.len())?)
}

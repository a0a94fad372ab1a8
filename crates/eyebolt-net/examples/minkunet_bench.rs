//! Times a MinkUNet on the CPU and prints one JSON line.
//!
//! `minkunet_bench COORDS.npy FEATS.npy [--model minkunet18d] [--stem 5] [--train] [--threads 2]
//! [--runs 3]`. Times are the shortest of all runs; `sgemm_gflop_per_s` is a plain product of
//! matrices of 2048 by the `gemm` crate in the same run on the same threads. `train_step_s` is forward
//! and backward, as peers are timed; `update_s` is what AdamW adds to it.
#![allow(clippy::print_stdout)]

use eyebolt_net::coordinates::{Neighbours, VoxelSet, average_features};
use eyebolt_net::graph::MapSpec;
use eyebolt_net::models::MinkUNet;
use eyebolt_net::training::{Optimiser, Rule};
use eyebolt_net::{Batch, Cpu, Executor, Gradients, Graph, Matrix, Parameters, PassOptions};
use std::time::Instant;

#[path = "minkunet_bench/machine.rs"]
mod machine;
#[path = "minkunet_bench/npy.rs"]
mod npy;

type Failure = Box<dyn std::error::Error>;

struct Options {
    model: String,
    stem: u32,
    train: bool,
    threads: usize,
    runs: usize,
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |flag: &str| {
        let at = arguments.iter().position(|argument| argument == flag)?;
        arguments.get(at + 1).cloned()
    };
    let number = |flag: &str, default| value(flag).map_or(Ok(default), |text| text.parse());
    let options = Options {
        model: value("--model").unwrap_or("minkunet18d".into()),
        stem: number("--stem", 5)? as u32,
        train: arguments.iter().any(|argument| argument == "--train"),
        threads: number("--threads", 2)?,
        runs: number("--runs", 3)?.max(1),
    };
    let [coordinates, features] =
        [0, 1].map(|at| arguments.get(at).filter(|a| !a.starts_with('-')));
    let usage = "give COORDS.npy and FEATS.npy";
    let coordinates = npy::coordinates(coordinates.ok_or(usage)?)?;
    let features = npy::features(features.ok_or(usage)?)?;
    rayon::ThreadPoolBuilder::new().num_threads(options.threads).build_global()?;
    bench(&options, &coordinates, &features)
}

fn bench(options: &Options, coordinates: &[[i32; 4]], features: &Matrix) -> Result<(), Failure> {
    let mut model = MinkUNet::named(&options.model, features.channels(), 3)?;
    model.stem_kernel = options.stem;
    let graph = model.graph()?;
    let parameters = Parameters::initial(&graph, 0);
    let weights_mib = machine::rss_mib();

    let (finest, voxel_of_point) = VoxelSet::new(coordinates)?;
    let means = average_features(features, &voxel_of_point, finest.len())?;
    let voxels = finest.len();
    let build = || -> Result<(Neighbours, f64), Failure> {
        let start = Instant::now();
        let mut neighbours = Neighbours::new(VoxelSet::new(coordinates)?.0);
        for &map in graph.maps() {
            if let MapSpec::Kernel(spec) = map {
                neighbours.map(spec)?;
            }
        }
        Ok((neighbours, start.elapsed().as_secs_f64()))
    };
    let mut maps_s = f64::INFINITY;
    for _ in 0..options.runs {
        maps_s = maps_s.min(build()?.1);
    }
    let (mut neighbours, last_s) = build()?;
    maps_s = maps_s.min(last_s);
    let batch = Batch::from_neighbours(&graph, &mut neighbours, means, voxel_of_point)?;

    let sgemm = machine::sgemm_gflop_per_s(options.threads);
    let mut cpu = Cpu::new();
    let (forward_s, forward_cpu_s) = shortest(options.runs, || {
        cpu.infer(&graph, &parameters, &batch)?;
        Ok(())
    })?;
    let peak_mib = machine::peak_rss_mib();
    let runs = if options.train { options.runs } else { 0 };
    let mut gradients = None;
    let (train_step_s, train_step_cpu_s) = shortest(runs, || {
        gradients = Some(train(&mut cpu, &graph, &parameters, &batch)?);
        Ok(())
    })?;
    let mut optimiser = Optimiser::new(Rule::adamw(1e-4), &parameters);
    let mut trained = parameters.clone();
    let (update_s, _) = shortest(runs, || {
        if let Some(gradients) = &gradients {
            optimiser.update(&graph, &mut trained, &gradients.parameters, 1e-4);
        }
        Ok(())
    })?;
    let sgemm = sgemm.max(machine::sgemm_gflop_per_s(options.threads));
    let gmac = machine::gmac(&graph, &mut neighbours)?;
    let number = |seconds: f64| match seconds.is_finite() {
        true => format!("{seconds:.4}"),
        false => "null".to_owned(),
    };
    let (train_step_s, train_step_cpu_s) = (number(train_step_s), number(train_step_cpu_s));
    let update_s = number(update_s);
    let gflop_per_s = 2.0 * gmac / forward_s;
    println!(
        "{{\"model\":\"{}\",\"voxels\":{voxels},\"gmac\":{gmac:.3},\"forward_s\":{forward_s:.4},\
         \"forward_cpu_s\":{forward_cpu_s:.2},\"train_step_s\":{train_step_s},\
         \"train_step_cpu_s\":{train_step_cpu_s},\"update_s\":{update_s},\"maps_ms\":{:.1},\"gflop_per_s\":{gflop_per_s:.1},\
         \"sgemm_gflop_per_s\":{sgemm:.1},\"ratio\":{:.3},\"peak_rss_mib\":{peak_mib:.0},\
         \"weights_rss_mib\":{weights_mib:.0},\"device\":\"{}\"}}",
        options.model,
        1e3 * maps_s,
        gflop_per_s / sgemm,
        cpu.device()
    );
    Ok(())
}

/// Wall and processor time of the run that took least of each.
fn shortest(
    runs: usize,
    mut run: impl FnMut() -> Result<(), Failure>,
) -> Result<(f64, f64), Failure> {
    let (mut wall_s, mut cpu_s) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..runs {
        let (start, cpu_start_s) = (Instant::now(), machine::cpu_s());
        run()?;
        wall_s = wall_s.min(start.elapsed().as_secs_f64());
        cpu_s = cpu_s.min(machine::cpu_s() - cpu_start_s);
    }
    Ok((wall_s, cpu_s))
}

/// One forward and backward pass, with gradients of all weights, as other libraries are timed.
fn train(
    cpu: &mut Cpu,
    graph: &Graph,
    parameters: &Parameters,
    batch: &Batch,
) -> Result<Gradients, Failure> {
    // Of half the sum of squares: the loss costs nothing beside the network.
    let mut of = |outputs: &[Matrix]| Ok(outputs.to_vec());
    let options = PassOptions::default();
    Ok(cpu.forward_backward(graph, parameters, batch, options, &mut of)?.1)
}

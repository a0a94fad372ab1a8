//! Times PointNet++ on the CPU, sampling and search for neighbours included, and prints a JSON line
//! for the single-scale and the multi-scale network.
//!
//! `pointnet_bench XYZ.npy [--threads 2] [--runs 20]`.
#![allow(clippy::print_stdout)]

use eyebolt_net::models::PointNet2;
use eyebolt_net::{Batch, Cpu, Executor, Parameters, Sampling};
use std::time::Instant;

#[path = "minkunet_bench/npy.rs"]
mod npy;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |flag: &str, default: usize| {
        let at = arguments.iter().position(|argument| argument == flag);
        let text = at.and_then(|at| arguments.get(at + 1));
        text.map_or(Ok(default), |text| text.parse())
    };
    let features = npy::features(arguments.first().ok_or("give XYZ.npy")?)?;
    let points = features.values().as_chunks::<3>().0;
    rayon::ThreadPoolBuilder::new().num_threads(number("--threads", 2)?).build_global()?;
    let models = [("ssg", PointNet2::single_scale(3, 3)), ("msg", PointNet2::multi_scale(3, 3))];
    for (name, model) in models {
        let graph = model.graph()?;
        let parameters = Parameters::initial(&graph, 0);
        let mut cpu = Cpu::new();
        let (mut batch_s, mut forward_s) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..number("--runs", 20)?.max(1) {
            let start = Instant::now();
            let sampling = Sampling::Farthest;
            let batch = Batch::from_points(&graph, points, &[points.len()], &features, sampling)?;
            batch_s = batch_s.min(start.elapsed().as_secs_f64());
            cpu.infer(&graph, &parameters, &batch)?;
            forward_s = forward_s.min(start.elapsed().as_secs_f64());
        }
        println!(
            "{{\"model\":\"{name}\",\"points\":{},\"forward_ms\":{:.2},\"of_it_neighbours_ms\":{:.2},\
             \"device\":\"{}\"}}",
            points.len(),
            1e3 * forward_s,
            1e3 * batch_s,
            cpu.device()
        );
    }
    Ok(())
}

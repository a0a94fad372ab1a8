//! Losses and optimisers against PyTorch.

use crate::fixtures::{Fixture, assert_close, hashed, hashed_matrix};
use eyebolt_net::graph::{Domain, GraphBuilder, Source};
use eyebolt_net::losses::{Loss, PoseLoss, cross_entropy, pose_loss, smooth_l1};
use eyebolt_net::training::{Optimiser, Rule};
use eyebolt_net::{Matrix, Parameters};

fn assert_loss(fixture: &Fixture, name: &str, loss: &Loss) {
    assert_close(name, &[loss.value as f32], fixture.floats(name), 1e-6);
    let of = fixture.floats(&format!("{name}.of"));
    assert_close(name, loss.gradient.values(), of, 1e-5);
}

#[test]
fn losses() {
    let fixture = Fixture::read("training");
    let logits = hashed_matrix("logits", 12, 4).map(|value| 3.0 * value);
    let labels = [0, 1, 2, 3, 255, 1, 1, 255, 0, 3, 2, 2];
    let weights = [0.5, 1.0, 2.0, 0.25];
    for (name, weights) in [("plain", None), ("weighted", Some(&weights[..]))] {
        let loss = cross_entropy(&logits, &labels, 255, weights).unwrap();
        assert_loss(&fixture, &format!("cross_entropy.{name}"), &loss);
    }
    let (found, wanted) = (hashed_matrix("found", 5, 3), hashed_matrix("wanted", 5, 3));
    assert_loss(&fixture, "smooth_l1", &smooth_l1(&found, &wanted, 0.3).unwrap());
    let rotation = hashed_matrix("rotation", 3, 4).map(|value| 2.0 * value);
    let (truth, model) = (hashed_matrix("truth", 3, 4), hashed("model", 60));
    for (name, kind) in [("same", PoseLoss::SamePoint), ("nearest", PoseLoss::NearestPoint)] {
        let loss = pose_loss(kind, &rotation, &truth, model.as_chunks::<3>().0).unwrap();
        assert_loss(&fixture, &format!("pose.{name}"), &loss);
    }
}

#[test]
fn optimisers() {
    let fixture = Fixture::read("training");
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Points, 2);
    let y = g.linear("layer", x, 3, false);
    let graph = g.finish(&[y]).unwrap();
    let sgd = Rule::Sgd { momentum: 0.9, weight_decay: 0.1 };
    for (name, rule) in [("adam", Rule::adam(0.1)), ("adamw", Rule::adamw(0.1)), ("sgd", sgd)] {
        let mut parameters = Parameters::new(&graph, vec![hashed("start", 6)]).unwrap();
        let mut optimiser = Optimiser::new(rule, &parameters);
        for step in 0..5 {
            let gradient = hashed(&format!("gradient{step}"), 6);
            optimiser.update(&graph, &mut parameters, &[gradient], 0.01);
        }
        assert_close(
            name,
            &parameters.values()[0],
            fixture.floats(&format!("optimiser.{name}")),
            1e-6,
        );
    }
}

#[test]
fn losses_refuse_what_they_cannot_weigh() {
    let logits = Matrix::new(2, 2, vec![0.0, 1.0, f32::NAN, 0.0]).unwrap();
    let refusal = |result: Result<Loss, eyebolt_net::Error>| result.unwrap_err().to_string();
    assert!(
        refusal(cross_entropy(&logits, &[0, 1], 255, None)).contains("row 1, channel 0 is NaN")
    );
    assert!(refusal(cross_entropy(&logits, &[0], 255, None)).contains("1 for 2 rows"));
    assert!(refusal(cross_entropy(&logits, &[0, 2], 255, None)).contains("class 2 of 2"));
    let finite = Matrix::new(1, 2, vec![0.0, 1.0]).unwrap();
    assert!(cross_entropy(&finite, &[0], 255, Some(&[1.0])).is_err());
    assert!(cross_entropy(&finite, &[0], 255, Some(&[1.0, -1.0])).is_err());
    assert_eq!(cross_entropy(&finite, &[255], 255, None).unwrap().value, 0.0);
    let zero = Matrix::zeros(1, 4);
    assert!(
        refusal(pose_loss(PoseLoss::SamePoint, &zero, &zero, &[[1.0; 3]])).contains("no rotation")
    );
}

#[test]
fn far_apart_logits_have_a_loss() {
    let logits = Matrix::new(1, 2, vec![-3e38, 3e38]).unwrap();
    let loss = cross_entropy(&logits, &[0], 255, None).unwrap();
    assert!((loss.value / 6e38 - 1.0).abs() < 1e-6, "{}", loss.value);
}

#[test]
#[should_panic(expected = "a gradient for each value")]
fn gradients_of_another_network() {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Points, 2);
    let y = g.linear("layer", x, 3, true);
    let graph = g.finish(&[y]).unwrap();
    let mut parameters = Parameters::initial(&graph, 1);
    let mut optimiser = Optimiser::new(Rule::adam(0.0), &parameters);
    optimiser.update(&graph, &mut parameters, &[vec![0.0; 6]], 0.1);
}

//! Made-up clouds: the surfaces of a ball (label 0) and a box (label 1).

/// Points in metres and their labels, others for every seed.
pub fn scene(seed: u64) -> (Vec<[f32; 3]>, Vec<u32>) {
    // A linear congruential generator with Knuth's constants; its upper bits are good enough here.
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 23) as f32 - 1.0
    };
    let (mut points_m, mut labels) = (Vec::new(), Vec::new());
    for (label, x_m) in [(0, -0.5), (1, 0.5)] {
        let (size_m, centre_m) = (0.25 + 0.1 * random(), [x_m, 0.4 * random(), 0.4 * random()]);
        for _ in 0..1000 {
            let inside = [random(), random(), random()];
            // Out to the surface, in the norm that the shape is the ball of.
            let length = match label {
                0 => inside.iter().map(|value| value * value).sum::<f32>().sqrt(),
                _ => inside.iter().fold(0.0, |most, value| value.abs().max(most)),
            };
            let scale = size_m / length.max(1e-3);
            points_m.push([0, 1, 2].map(|axis| centre_m[axis] + scale * inside[axis]));
            labels.push(label);
        }
    }
    (points_m, labels)
}

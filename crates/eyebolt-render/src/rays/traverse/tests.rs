use super::*;
use crate::random::Random;
use crate::rays::build::build;
use crate::rays::packet::{RAYS, ROWS};
use nalgebra::{Matrix3, Vector3};

fn packet(random: &mut Random) -> Packet {
    let mut packet = Packet::new();
    for at in 0..RAYS {
        let (row, lane) = (at / LANES, at % LANES);
        packet.x[row][lane] = random.between(-0.2, 0.2) as f32;
        packet.y[row][lane] = random.between(-0.2, 0.2) as f32;
    }
    packet.nearest = [[f32::INFINITY; LANES]; ROWS];
    assert!(packet.settle());
    packet
}

/// What processors without AVX2 find; where there is none, this compares nothing.
#[test]
fn wide_registers_change_no_bit() {
    let mut random = Random::new(5);
    let corner =
        |random: &mut Random, limit: f64| [0; 3].map(|_| random.between(-limit, limit) as f32);
    let triangles: Vec<_> = (0..2000)
        .map(|_| {
            let (a, size) = (corner(&mut random, 0.9), random.between(0.01, 0.1));
            let mut beside = || {
                let step = corner(&mut random, size);
                [0, 1, 2].map(|axis| a[axis] + step[axis])
            };
            [a, beside(), beside()]
        })
        .collect();
    let bvh = build(&triangles);
    let eye = Eye::new(&Vector3::new(0.1, 0.2, -2.0), &Matrix3::identity());
    let mut hits = 0;
    for _ in 0..50 {
        let (mut wide, mut plain) = (packet(&mut random), Packet::new());
        plain.clone_from(&wide);
        cast::<false>(&bvh, &eye, &mut wide, &mut Vec::new());
        cast_here::<false>(&bvh, &eye, &mut plain, &mut Vec::new());
        assert_eq!(wide.hit, plain.hit);
        assert_eq!(
            wide.nearest.map(|row| row.map(f32::to_bits)),
            plain.nearest.map(|row| row.map(f32::to_bits))
        );
        hits += wide.hit.as_flattened().iter().filter(|hit| **hit != Packet::NOTHING).count();
    }
    assert!(hits > 1000, "{hits}");
}

//! Voxels and maps against sets and searches.

use eyebolt_net::Matrix;
use eyebolt_net::coordinates::{
    BLOCK_ROWS, COORDINATE_LIMIT, Kernel, KernelMap, KernelSpec, Neighbours, VoxelSet,
    average_features, vote_labels, voxelise,
};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Clustered near the origin or near a corner of what coordinates may be.
fn coordinates() -> impl Strategy<Value = Vec<[i32; 4]>> {
    let corner = prop_oneof![Just(0), Just(-COORDINATE_LIMIT + 9), Just(COORDINATE_LIMIT - 10)];
    let cell = (0..3, -9..10, -9..10, -9..10);
    (corner, prop::collection::vec(cell, 1..400)).prop_map(|(corner, cells)| {
        cells
            .into_iter()
            .map(|(item, x, y, z)| [item, x + corner, y + corner, z + corner])
            .collect()
    })
}

/// Offset, input and output voxel of every pair, by looking each up.
fn expected(fine: &[[i32; 4]], spec: KernelSpec) -> BTreeSet<(usize, [i32; 4], [i32; 4])> {
    let step = spec.from.min(spec.to) as i32;
    let coarse = spec.from.max(spec.to) as i32;
    let at = |stride: i32| -> BTreeSet<[i32; 4]> {
        let floor = |value: i32| value.div_euclid(stride) * stride;
        fine.iter().map(|&[i, x, y, z]| [i, floor(x), floor(y), floor(z)]).collect()
    };
    let (finer, coarser) = (at(step), at(coarse));
    let mut pairs = BTreeSet::new();
    for &[item, x, y, z] in &coarser {
        for (offset, [dx, dy, dz]) in spec.kernel.offsets().into_iter().enumerate() {
            let neighbour = [item, x + dx * step, y + dy * step, z + dz * step];
            if finer.contains(&neighbour) {
                let (from, to) = (neighbour, [item, x, y, z]);
                pairs.insert(if spec.from > spec.to {
                    (offset, to, from)
                } else {
                    (offset, from, to)
                });
            }
        }
    }
    pairs
}

fn found(map: &KernelMap, from: &VoxelSet, to: &VoxelSet) -> BTreeSet<(usize, [i32; 4], [i32; 4])> {
    let (from, to) = (from.coordinates(), to.coordinates());
    let mut pairs = BTreeSet::new();
    for (index, block) in map.blocks().iter().enumerate() {
        for offset in 0..map.volume() {
            let (input, output) = block.pairs(offset);
            for (&i, &o) in input.iter().zip(output) {
                let o = index * BLOCK_ROWS + usize::from(o);
                assert!(pairs.insert((offset, from[i as usize], to[o])), "a pair comes twice");
            }
        }
    }
    for offset in 0..map.volume() {
        let outputs: Vec<usize> = map.pairs_at(offset).map(|(_, output)| output).collect();
        assert_eq!(outputs.iter().collect::<BTreeSet<_>>().len(), outputs.len(), "an output twice");
        assert!(map.pairs_at(offset).all(|(i, o)| pairs.contains(&(offset, from[i], to[o]))));
    }
    assert_eq!((0..map.volume()).flat_map(|o| map.pairs_at(o)).count(), pairs.len());
    pairs
}

/// The pairs of the adjoint map, turned back.
fn back(map: &KernelMap, from: &VoxelSet, to: &VoxelSet) -> BTreeSet<(usize, [i32; 4], [i32; 4])> {
    let (adjoint, mirrored) = map.adjoint();
    let turn = |(o, i, u)| (if mirrored { map.volume() - 1 - o } else { o }, u, i);
    found(adjoint, to, from).into_iter().map(turn).collect()
}

proptest! {
    #[test]
    fn maps_hold_every_pair_and_no_other(
        cells in coordinates(),
        size in 1_u32..=5,
        dilation in 1_u32..=3,
        (from, to) in prop::sample::select(vec![
            (1, 1), (2, 2), (3, 3), (8, 8), (1, 2), (2, 1), (2, 4), (1, 4), (1, 3), (3, 1), (2, 6), (6, 2),
        ]),
    ) {
        let (finest, _) = VoxelSet::new(&cells).unwrap();
        let mut neighbours = Neighbours::new(finest);
        let spec = KernelSpec { kernel: Kernel { size, dilation, flat: false }, from, to };
        // What is there already may be built upon.
        if dilation == 1 && size == 3 {
            neighbours.map(KernelSpec { kernel: Kernel::new(5), ..spec }).unwrap();
        }
        let map = neighbours.map(spec).unwrap();
        let (a, b) = (neighbours.voxels(from).unwrap(), neighbours.voxels(to).unwrap());
        prop_assert_eq!(found(&map, &a, &b), expected(&cells, spec));
        prop_assert_eq!(back(&map, &a, &b), found(&map, &a, &b));
    }

    #[test]
    fn voxels_are_the_distinct_coordinates(cells in coordinates()) {
        let (set, voxel_of_point) = VoxelSet::new(&cells).unwrap();
        let voxels = set.coordinates();
        let distinct: BTreeSet<_> = cells.iter().copied().collect();
        prop_assert_eq!(voxels.iter().copied().collect::<BTreeSet<_>>(), distinct.clone());
        prop_assert_eq!(voxels.len(), distinct.len());
        for (cell, &voxel) in cells.iter().zip(&voxel_of_point) {
            prop_assert_eq!(voxels[voxel as usize], *cell);
        }
        for (item, range) in set.item_starts().windows(2).enumerate() {
            for voxel in &voxels[range[0] as usize..range[1] as usize] {
                prop_assert_eq!(voxel[0], item as i32);
            }
        }
    }

    #[test]
    fn labels_are_voted(
        points in prop::collection::vec((0_u32..4, prop::sample::select(vec![0, 1, 2, 255])), 1..60),
    ) {
        let (voxels, labels): (Vec<u32>, Vec<u32>) = points.iter().copied().unzip();
        let voted = vote_labels(&labels, &voxels, 4, 255).unwrap();
        for voxel in 0..4 {
            let mut counts = BTreeMap::new();
            for (_, label) in points.iter().filter(|(v, label)| *v == voxel && *label != 255) {
                *counts.entry(*label).or_insert(0) += 1;
            }
            let most = counts.values().copied().max();
            let winner = counts.into_iter().find(|(_, count)| Some(*count) == most);
            prop_assert_eq!(voted[voxel as usize], winner.map_or(255, |(label, _)| label));
        }
    }
}

#[test]
fn maps_of_many_blocks() {
    // A thick wavy layer: thousands of voxels at stride 2 still.
    let cells: Vec<[i32; 4]> = (0..120 * 120)
        .map(|i| [i % 2, i % 120 - 60, i / 120 - 60, (i * i % 7) - 3 + i % 120 / 9])
        .collect();
    for (size, dilation, from, to) in [
        (3, 1, 1, 1),
        (5, 1, 1, 1),
        (2, 1, 1, 1),
        (3, 2, 1, 1),
        (3, 1, 2, 2),
        (2, 1, 1, 2),
        (2, 1, 2, 1),
        (3, 1, 1, 2),
        (3, 1, 2, 1),
        (3, 1, 1, 3),
    ] {
        let (finest, _) = VoxelSet::new(&cells).unwrap();
        let mut neighbours = Neighbours::new(finest);
        let spec = KernelSpec { kernel: Kernel { size, dilation, flat: false }, from, to };
        let map = neighbours.map(spec).unwrap();
        let (a, b) = (neighbours.voxels(from).unwrap(), neighbours.voxels(to).unwrap());
        assert!(map.blocks().len() > 2, "{spec:?} is of one block or two");
        let all = found(&map, &a, &b);
        assert!(all == expected(&cells, spec), "{spec:?}");
        assert!(back(&map, &a, &b) == all, "back from {spec:?}");
    }
}

#[test]
fn features_are_averaged() {
    let features = Matrix::new(4, 2, vec![1.0, 2.0, 3.0, 4.0, 5.0, 9.0, 7.0, 8.0]).unwrap();
    let means = average_features(&features, &[1, 0, 1, 1], 2).unwrap();
    assert_eq!(means.values(), [3.0, 4.0, 13.0 / 3.0, 19.0 / 3.0]);
    let error = average_features(&features, &[1, 0, 1, 1], 3).unwrap_err().to_string();
    assert_eq!(error, "voxel_of_point: no point is in voxel 2");
    let large = Matrix::new(2, 1, vec![3e38; 2]).unwrap();
    assert_eq!(average_features(&large, &[0, 0], 1).unwrap().values(), [3e38]);
}

#[test]
fn points_fall_into_voxels() {
    let points = [[0.0, 0.0049, -0.0001], [0.012, -0.005, 0.0051]];
    let cells = voxelise(2, &points, 0.005).unwrap();
    assert_eq!(cells, [[2, 0, 0, -1], [2, 2, -1, 1]]);
}

#[test]
fn what_cannot_be_placed_is_refused() {
    let refusal = |result: Result<_, eyebolt_net::Error>| result.err().unwrap().to_string();
    assert!(refusal(VoxelSet::new(&[])).contains("there are none"));
    let far = [[0, 0, 0, 0], [0, 0, COORDINATE_LIMIT, 0]];
    assert!(refusal(VoxelSet::new(&far)).contains("row 1: 524288 is beyond 20 bits"));
    assert!(refusal(VoxelSet::new(&[[0, -COORDINATE_LIMIT - 1, 0, 0]])).contains("20 bits"));
    assert!(refusal(VoxelSet::new(&[[1024, 0, 0, 0]])).contains("item 1024"));
    assert!(refusal(VoxelSet::new(&[[-1, 0, 0, 0]])).contains("item -1"));
    let refusal =
        |result: Result<Vec<[i32; 4]>, eyebolt_net::Error>| result.unwrap_err().to_string();
    let point = |x| [[0.0, 0.0, 0.0], [x, 0.0, 0.0]];
    assert!(refusal(voxelise(0, &point(f32::NAN), 0.01)).contains("point 1"));
    assert!(refusal(voxelise(0, &point(6000.0), 0.01)).contains("20 bits"));
    assert!(refusal(voxelise(0, &point(1.0), 0.0)).contains("voxel_m"));
}

#[test]
fn kernels_that_are_none_are_refused() {
    let (finest, _) = VoxelSet::new(&[[0, 0, 0, 0]]).unwrap();
    let mut neighbours = Neighbours::new(finest);
    let spec = |size, dilation, from, to| KernelSpec {
        kernel: Kernel { size, dilation, flat: false },
        from,
        to,
    };
    for bad in
        [spec(0, 1, 1, 1), spec(99, 1, 1, 1), spec(3, 0, 1, 1), spec(3, 1, 0, 2), spec(3, 1, 2, 3)]
    {
        assert!(neighbours.map(bad).is_err(), "{bad:?}");
    }
}

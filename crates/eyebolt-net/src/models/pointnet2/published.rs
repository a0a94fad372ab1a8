//! Networks of publications.

use super::description::{Abstraction, PointNet2, Scale, Task};

impl PointNet2 {
    /// Segmentation, single-scale: 1024, 256, 64, 16 samples within 0.1, 0.2, 0.4, 0.8, 32
    /// neighbours each.
    ///
    /// As in the code of Qi et al. for scenes in metres (`pointnet2_sem_seg`), and in that of
    /// Sefercik and Akgun (see [`models`](crate::models)), who find the keypoints of an end-effector by
    /// it: 2048 points, centred and scaled to the unit sphere.
    pub fn single_scale(inputs: usize, outputs: usize) -> Self {
        Self {
            inputs,
            outputs,
            abstractions: vec![
                level(1024, &[(0.1, 32, [32, 32, 64])]),
                level(256, &[(0.2, 32, [64, 64, 128])]),
                level(64, &[(0.4, 32, [128, 128, 256])]),
                level(16, &[(0.8, 32, [256, 256, 512])]),
            ],
            task: Task::Segmentation(vec![
                vec![256, 256],
                vec![256, 256],
                vec![256, 128],
                vec![128, 128, 128],
            ]),
            head: vec![128],
            dropout: 0.5,
        }
    }

    /// Segmentation, multi-scale: two radii a level, 16 and 32 neighbours, as
    /// `pointnet2_sem_seg_msg` of the much-used yanx27/Pointnet_Pointnet2_pytorch has them.
    #[doc(alias = "MSG")]
    pub fn multi_scale(inputs: usize, outputs: usize) -> Self {
        Self {
            abstractions: vec![
                level(1024, &[(0.05, 16, [16, 16, 32]), (0.1, 32, [32, 32, 64])]),
                level(256, &[(0.1, 16, [64, 64, 128]), (0.2, 32, [64, 96, 128])]),
                level(64, &[(0.2, 16, [128, 196, 256]), (0.4, 32, [128, 196, 256])]),
                level(16, &[(0.4, 16, [256, 256, 512]), (0.8, 32, [256, 384, 512])]),
            ],
            ..Self::single_scale(inputs, outputs)
        }
    }

    /// Classification, single-scale, of points in the unit sphere: 512 samples within 0.2, 128
    /// within 0.4, then all at once, as in the article and its code (`pointnet2_cls_ssg`).
    #[doc(alias = "SSG")]
    pub fn single_scale_classification(inputs: usize, outputs: usize) -> Self {
        let abstractions = vec![
            level(512, &[(0.2, 32, [64, 64, 128])]),
            level(128, &[(0.4, 64, [128, 128, 256])]),
        ];
        classification(inputs, outputs, abstractions)
    }

    /// Classification, multi-scale: three radii at each of two levels, as in the article and its
    /// code (`pointnet2_cls_msg`).
    ///
    /// Dropout is the article's; its code drops 0.6 here.
    #[doc(alias = "MSG")]
    pub fn multi_scale_classification(inputs: usize, outputs: usize) -> Self {
        let near = [(0.1, 16, [32, 32, 64]), (0.2, 32, [64, 64, 128]), (0.4, 128, [64, 96, 128])];
        let far =
            [(0.2, 32, [64, 64, 128]), (0.4, 64, [128, 128, 256]), (0.8, 128, [128, 128, 256])];
        classification(inputs, outputs, vec![level(512, &near), level(128, &far)])
    }
}

fn classification(inputs: usize, outputs: usize, abstractions: Vec<Abstraction>) -> PointNet2 {
    PointNet2 {
        inputs,
        outputs,
        abstractions,
        task: Task::Classification(vec![256, 512, 1024]),
        head: vec![512, 256],
        dropout: 0.5,
    }
}

/// Samples, and of each scale radius, neighbours and channels.
fn level(samples: usize, scales: &[(f32, usize, [usize; 3])]) -> Abstraction {
    let scale = |&(radius, neighbours, channels): &(f32, usize, [usize; 3])| Scale {
        radius,
        neighbours,
        channels: channels.to_vec(),
    };
    Abstraction { samples, scales: scales.iter().map(scale).collect() }
}

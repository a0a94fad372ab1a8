//! Published networks: their sizes, and what relates their graphs.

use crate::scenes::{features, parameters, sheet};
use eyebolt_net::coordinates::VoxelSet;
use eyebolt_net::models::{MinkEncoder, MinkUNet, PointNet2};
use eyebolt_net::{Batch, Cpu, Executor, Graph};

/// Values that are trained, not those of running statistics.
fn trained(graph: &Graph) -> usize {
    let specs = graph.parameters().iter().filter(|spec| spec.role.is_trained());
    specs.map(|spec| spec.len()).sum()
}

/// What `sum(p.numel() for p in net.parameters())` gives of the classes in MinkowskiEngine's own
/// `examples/minkunet.py` for 3 features and 20 classes; buffers, as running statistics are, do not
/// count.
#[test]
fn minkunets_are_as_large_as_published() {
    for (name, expected) in [
        ("14a", 8_024_500),
        ("14b", 8_961_588),
        ("14c", 11_919_924),
        ("14d", 43_315_764),
        ("18a", 15_493_172),
        ("18b", 17_204_660),
        ("18d", 79_874_484),
        ("34a", 36_607_412),
        ("34b", 36_226_484),
        ("34c", 37_856_052),
        ("50", 31_763_444),
        ("101", 70_809_588),
    ] {
        let name = format!("minkunet{name}");
        let graph = MinkUNet::named(&name, 3, 20).unwrap().graph().unwrap();
        assert_eq!(trained(&graph), expected, "{name}");
        // The encoder has the same parameters, by name, shape and place.
        let encoder = MinkEncoder::named(&name, 3, &[5]).unwrap().graph().unwrap();
        let shared = &encoder.parameters()[..encoder.parameters().len() - 2];
        assert_eq!(shared, &graph.parameters()[..shared.len()], "{name}");
        assert_eq!(encoder.parameters()[shared.len()].name, "regression.0.weight");
    }
}

/// Of layers with batch norm: weights, biases, scales, shifts.
fn layers(mut inputs: usize, widths: &[usize]) -> usize {
    let of = |&width: &usize| std::mem::replace(&mut inputs, width) * width + 3 * width;
    widths.iter().map(of).sum()
}

/// Input channels and widths of every row of layers of the published PyTorch code
/// (`pointnet2_cls_ssg.py`, `pointnet2_cls_msg.py` with normals, for 40 classes).
#[test]
fn point_networks_are_as_large_as_published() {
    let top = layers(256 + 3, &[256, 512, 1024]);
    let head = layers(1024, &[512, 256]) + 256 * 40 + 40;
    let single = layers(3 + 3, &[64, 64, 128]) + layers(128 + 3, &[128, 128, 256]) + top + head;
    let graph = PointNet2::single_scale_classification(3, 40).graph().unwrap();
    assert_eq!(trained(&graph), single);
    let near = [[32, 32, 64], [64, 64, 128], [64, 96, 128]];
    let far = [[64, 64, 128], [128, 128, 256], [128, 128, 256]];
    let near: usize = near.iter().map(|widths| layers(3 + 3, widths)).sum();
    let far: usize = far.iter().map(|widths| layers(320 + 3, widths)).sum();
    let several = near + far + layers(640 + 3, &[256, 512, 1024]) + head;
    let graph = PointNet2::multi_scale_classification(3, 40).graph().unwrap();
    assert_eq!(trained(&graph), several);
}

#[test]
fn points_have_the_logits_of_their_voxels() {
    let mut net = MinkUNet::named("minkunet14a", 3, 4).unwrap();
    net.channels = [8; 8];
    let (of_points, of_voxels) = (net.graph().unwrap(), net.voxel_graph().unwrap());
    assert_eq!(of_points.parameters(), of_voxels.parameters());
    let parameters = parameters(&of_points, 3);
    let coordinates = sheet(9);
    let features = features(5, coordinates.len(), 3);
    let infer = |graph: &Graph| {
        let batch = Batch::from_voxels(graph, &coordinates, &features).unwrap();
        Cpu::new().infer(graph, &parameters, &batch).unwrap().remove(0)
    };
    let (points, voxels) = (infer(&of_points), infer(&of_voxels));
    let (finest, voxel_of_point) = VoxelSet::new(&coordinates).unwrap();
    assert_eq!(voxels.rows(), finest.len());
    assert!(points.rows() > voxels.rows());
    for (point, &voxel) in voxel_of_point.iter().enumerate() {
        assert_eq!(points.row(point), voxels.row(voxel as usize));
    }
}

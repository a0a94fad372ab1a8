use crate::shapes::cuboid;
use crate::strategies::config;
use eyebolt_registration::{LinkCache, LinkModel};
use eyebolt_robot::TriangleMesh;
use proptest::prelude::*;
use std::convert::Infallible;
use std::path::Path;
use std::sync::LazyLock;

const NAME: &str = "0123abcd";

fn mesh() -> TriangleMesh {
    cuboid([0.03, 0.02, 0.025], [0.0, 0.01, 0.0])
}

const BUDGET: usize = 4_000_000;

static MODEL: LazyLock<LinkModel> = LazyLock::new(|| LinkModel::build(&mesh()));

/// The bytes that a cache writes for [`MODEL`].
static BYTES: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(built(folder.path()), *MODEL);
    std::fs::read(folder.path().join("0123abcd-4000000.link")).unwrap()
});

fn built(folder: &Path) -> LinkModel {
    let cache = LinkCache::new(folder.to_owned());
    cache.load_or_build(NAME, BUDGET, || Ok::<_, Infallible>(mesh())).unwrap()
}

/// What the cache has in `folder`; `None` where it would build anew.
fn stored(folder: &Path) -> Option<LinkModel> {
    LinkCache::new(folder.to_owned()).load_or_build(NAME, BUDGET, || Err(())).ok()
}

/// What a cache makes of a file of these `bytes`.
fn read(bytes: &[u8]) -> Option<LinkModel> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("0123abcd-4000000.link"), bytes).unwrap();
    stored(folder.path())
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn a_file_that_is_cut_off_is_built_anew(keep in 0.0..1.0_f64) {
        let keep = (keep * BYTES.len() as f64) as usize;
        prop_assert_eq!(read(&BYTES[..keep]), None);
    }

    #[test]
    fn a_file_with_a_changed_byte_is_built_anew(at in 0.0..1.0_f64, flip in 1..=255_u8) {
        let mut bytes = BYTES.clone();
        let at = (at * bytes.len() as f64) as usize;
        bytes[at] ^= flip;
        prop_assert_eq!(read(&bytes), None);
    }

    #[test]
    fn no_content_makes_a_file_with_a_right_hash_a_panic(
        cut in 16..BYTES.len() - 32,
        changes in prop::collection::vec((16..4000_usize, any::<u8>()), 1..4),
        // The head, where counts and sizes are, more often than not.
        head in prop::collection::vec((16..60_usize, any::<u8>()), 0..4),
    ) {
        let mut bytes = BYTES[..cut].to_vec();
        for (at, value) in changes.into_iter().chain(head) {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = value;
            }
        }
        let hash = blake3::hash(&bytes);
        bytes.extend(hash.as_bytes());
        if let Some(model) = read(&bytes) {
            let corners = model.mesh.triangles.iter().flatten();
            prop_assert!(corners.into_iter().all(|i| (*i as usize) < model.mesh.vertices.len()));
        }
    }
}

#[test]
fn short_files_are_built_anew() {
    for keep in 0..200 {
        assert_eq!(read(&BYTES[..keep]), None, "{keep} bytes");
    }
    for missing in 1..200 {
        assert_eq!(read(&BYTES[..BYTES.len() - missing]), None, "{missing} bytes missing");
    }
}

#[test]
fn what_is_read_is_what_was_built() {
    let read = read(&BYTES).expect("a whole file");
    assert_eq!(read, *MODEL);
    assert_eq!(read.field.bounds(), MODEL.field.bounds());
}

#[test]
fn the_same_link_gives_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    built(folder.path());
    assert_eq!(std::fs::read(folder.path().join("0123abcd-4000000.link")).unwrap(), *BYTES);
}

#[test]
fn a_damaged_file_is_replaced_by_a_whole_one() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("0123abcd-4000000.link"), &BYTES[..1000]).unwrap();
    assert_eq!(built(folder.path()), *MODEL);
    assert_eq!(stored(folder.path()).as_ref(), Some(&*MODEL));
}

#[test]
fn a_folder_that_cannot_be_made_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, b"not a folder").unwrap();
    assert_eq!(built(&file.join("inner")), *MODEL);
    assert_eq!(std::fs::read(&file).unwrap(), b"not a folder");
}

#[test]
fn a_disabled_cache_builds_every_time_and_hands_on_errors() {
    let cache = LinkCache::disabled();
    assert_eq!(cache.load_or_build(NAME, BUDGET, || Ok::<_, Infallible>(mesh())).unwrap(), *MODEL);
    assert_eq!(cache.load_or_build(NAME, BUDGET, || Err("no mesh")), Err("no mesh"));
}

#[test]
fn caches_that_write_at_once_leave_a_whole_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("0123abcd-4000000.link");
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                for _ in 0..8 {
                    let _ = std::fs::remove_file(&path);
                    assert_eq!(built(folder.path()), *MODEL);
                }
            });
        }
        scope.spawn(|| {
            for _ in 0..500 {
                // Whenever there is a file, it is whole.
                if let Ok(bytes) = std::fs::read(&path) {
                    assert!(bytes == *BYTES);
                }
            }
        });
    });
    built(folder.path());
    assert_eq!(stored(folder.path()).as_ref(), Some(&*MODEL));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

//! One bad record between two good ones.

use super::super::support::{bag, scan};
use super::super::writer::{connection, message, unindexed};

pub(super) const REST: &str =
    "The file is damaged: copy it again, or give argument `partial` to use the rest";

pub(super) fn camera() -> Vec<u8> {
    connection(0, "/camera", "sensor_msgs/Image")
}

/// What is wrong with `bad`, which stands between two good messages that must come all the same.
pub(super) fn problems_of(bad: &[u8]) -> Vec<String> {
    let records = [camera(), message(0, [1, 0], b"a"), bad.to_vec(), message(0, [2, 0], b"b")];
    let (messages, problems) = scan(&bag(&unindexed(&records)).1);
    let data: Vec<_> = messages.iter().map(|m| m.data.as_slice()).collect();
    assert_eq!(data, [b"a", b"b"], "{problems:?}");
    problems
}

/// As [`problems_of`], for one problem, without the file's name, the place and the usual remedy.
pub(super) fn problem_of(bad: &[u8]) -> String {
    let problems = problems_of(bad);
    let [problem] = problems.as_slice() else { panic!("{problems:?}") };
    let at = unindexed(&[camera(), message(0, [1, 0], b"a")]).len();
    let (_, problem) = problem.split_once(&format!(": record at byte {at}: ")).unwrap();
    problem.strip_suffix(&format!(". {REST}")).unwrap_or(problem).to_owned()
}

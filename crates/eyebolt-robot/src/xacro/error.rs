//! What is wrong with a xacro file.

/// What is wrong, as a sentence with a remedy; whoever knows the file and the line adds them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    pub(crate) problem: String,
    /// The innermost file and line that is known.
    pub(crate) place: Option<(String, u32)>,
}

impl Fault {
    pub(crate) fn new(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), place: None }
    }

    /// With where it is, unless something within is known to be at fault.
    pub(crate) fn at(mut self, file: &str, line: u32) -> Self {
        self.place.get_or_insert_with(|| (file.to_owned(), line));
        self
    }
}

impl<T: Into<String>> From<T> for Fault {
    fn from(problem: T) -> Self {
        Self::new(problem)
    }
}

//! What can go wrong, said in terms of what was handed in.

/// Why something was refused. Every message says what and where, and where possible the remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Points, coordinates, features or labels that cannot be used.
    #[error("{field}: {problem}")]
    Input {
        /// Which argument.
        field: String,
        /// What is wrong with it, and where.
        problem: String,
    },
    /// A network that does not fit together.
    #[error("network, {place}: {problem}")]
    Network {
        /// Which operation or field of its description.
        place: String,
        /// What is wrong there.
        problem: String,
    },
    /// Bytes of weights or of a checkpoint that cannot be used.
    #[error("{file}: {field}: {problem}")]
    File {
        /// What the bytes are.
        file: String,
        /// Which part of them.
        field: String,
        /// What is wrong there.
        problem: String,
    },
}

impl Error {
    pub(crate) fn input(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Input { field: field.into(), problem: problem.into() }
    }

    pub(crate) fn network(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Network { place: place.into(), problem: problem.into() }
    }

    pub(crate) fn file(
        file: impl Into<String>,
        field: impl Into<String>,
        problem: impl Into<String>,
    ) -> Self {
        Self::File { file: file.into(), field: field.into(), problem: problem.into() }
    }
}

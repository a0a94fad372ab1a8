//! What this program calls what the libraries ask of a caller.

use eyebolt_robot::Input;

/// Inputs whose flag is not their name with dashes: the flag says the unit, or several flags make one.
const OTHER_FLAGS: [(Input, &str); 9] = [
    (Input::MAX_MOTION, "--max-motion-deg"),
    (Input::MAX_ERROR_TRANSLATION, "--max-error-mm"),
    (Input::MAX_ERROR_ROTATION, "--max-error-deg"),
    (Input::DISTANCE, "--distance-m"),
    (Input::AZIMUTH, "--azimuth-deg"),
    (Input::ELEVATION, "--elevation-deg"),
    (Input::OUTSIDE_FILES, "--allow-outside-files"),
    (Input::XACRO_ARGUMENT, "--xacro-arg"),
    (Input::CENTRE, "--centre-px"),
];

/// The flag that an input is given by.
pub fn flag(input: Input) -> String {
    let other = OTHER_FLAGS.iter().find(|(other, _)| *other == input);
    other
        .map_or_else(|| format!("--{}", input.name().replace('_', "-")), |(_, flag)| (*flag).into())
}

/// `text` of a library with flags for inputs.
pub fn in_flags(text: &str) -> String {
    Input::in_words(text, flag)
}

#[cfg(test)]
mod tests;

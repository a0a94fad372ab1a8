//! What a person types meanwhile.

use anyhow::{Context, Result};
use std::io::BufRead;
use std::sync::mpsc::{self, Receiver};

/// What a person wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// Take the configuration now.
    Capture,
    /// End, and calibrate with what is there.
    End,
}

/// Lines typed on standard input; none once it is closed.
pub struct Keyboard(Receiver<Key>);

impl Keyboard {
    /// Listens on a thread that ends with the program.
    pub fn listen() -> Result<Self> {
        let (keys, typed) = mpsc::channel();
        let thread = std::thread::Builder::new().name("eyebolt-keyboard".to_owned());
        thread
            .spawn(move || {
                for line in std::io::stdin().lock().lines().map_while(Result::ok) {
                    let key = match line.trim() {
                        "" | "c" => Key::Capture,
                        "q" => Key::End,
                        _ => continue,
                    };
                    if keys.send(key).is_err() {
                        return;
                    }
                }
            })
            .context("cannot start a thread for the keyboard")?;
        Ok(Self(typed))
    }

    /// What was typed, if anything was.
    pub fn typed(&self) -> Option<Key> {
        self.0.try_recv().ok()
    }
}

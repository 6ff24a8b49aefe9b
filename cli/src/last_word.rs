//! Results in JSON that are printed even when the command is interrupted: by a second process,
//! which an interruption from the terminal does not reach.
//!
//! An object is whole or none at all, so a command cannot print it bit by bit as it prints lines.
//! It hands each result to the second process when it is known, which prints them when the command
//! has ended without printing them itself.

use serde::Serialize;
use std::env;
use std::io::{self, BufRead, Write};
use std::process::{Child, Command, ExitCode, Stdio};

/// Says to this program that it is the second process.
const NAME: &str = "COTAMA_LAST_WORD";

/// What stands behind each part: JSON holds no such byte.
const END: u8 = 0;

/// Where results stand in an answer that has none. Inside of a text its quotes would be escaped.
const RESULTS: &str = "\"results\": []";

/// The second process. It prints nothing once this is dropped.
#[derive(Debug)]
pub(crate) struct LastWord {
    process: Child,
}

impl LastWord {
    /// Starts it with an answer that has no results yet; `None` where that cannot be.
    #[cfg(unix)]
    pub(crate) fn new(answer: &impl Serialize) -> Option<Self> {
        use std::os::unix::process::CommandExt;
        let process = Command::new(env::current_exe().ok()?)
            .env(NAME, "1")
            .process_group(0)
            .stdin(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut word = Self { process: process.ok()? };
        word.add(answer);
        Some(word)
    }

    /// Nothing: processes have no groups here.
    #[cfg(not(unix))]
    pub(crate) fn new(_: &impl Serialize) -> Option<Self> {
        None
    }

    /// Hands over a result. If that fails it will not be printed.
    pub(crate) fn add(&mut self, result: &impl Serialize) {
        let Some(pipe) = &mut self.process.stdin else { return };
        let Ok(mut text) = serde_json::to_vec_pretty(result) else { return };
        text.push(END);
        let _ = pipe.write_all(&text).and_then(|()| pipe.flush());
    }
}

impl Drop for LastWord {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// If this is the second process, waits for the command to end and prints what it left.
pub(crate) fn printed() -> Option<ExitCode> {
    env::var_os(NAME)?;
    let (mut input, mut parts, mut part) = (io::stdin().lock(), Vec::new(), Vec::new());
    while input.read_until(END, &mut part).is_ok() && part.pop_if(|it| *it == END).is_some() {
        parts.push(String::from_utf8_lossy(&std::mem::take(&mut part)).into_owned());
    }
    if let Some((answer, results)) = parts.split_first() {
        let results = format!("\"results\": [{}]", results.join(", "));
        let _ = writeln!(io::stdout(), "{}", answer.replacen(RESULTS, &results, 1));
    }
    Some(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::check::CheckAnswer;

    #[test]
    fn an_answer_has_a_place_for_results() {
        let answer = CheckAnswer {
            schema: "",
            model: RESULTS.to_owned(),
            timed: false,
            time_unit: None,
            semantics: None,
            notes: vec![],
            left_out: vec![],
            results: vec![],
            otherwise: vec![],
        };
        let text = serde_json::to_string_pretty(&answer).unwrap();
        assert_eq!(text.matches(RESULTS).count(), 1);
    }
}

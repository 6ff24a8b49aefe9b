//! The lines of a campaign's results, read block by block.

use crate::exit::Failure;
use crate::input::plain;
use cotama_campaign::run::Line;
use cotama_campaign::strategy::BLOCK;
use cotama_sim::canonical;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// The most bytes of a line.
const LINE_BYTES: u64 = 1 << 20;

/// A block of lines.
pub(super) enum Block {
    /// All its lines with their texts, as they are written, and how many bytes they take here.
    Whole(Vec<(Line, String)>, u64),
    /// The file ends before its end.
    Torn,
}

/// The lines of results, read block by block.
pub(super) struct Lines<R = BufReader<File>> {
    path: PathBuf,
    reader: R,
    number: u64,
    /// Whether the line read last has a line end.
    pub(super) ends_line: bool,
}

impl Lines {
    /// The results of a folder.
    pub(super) fn of(folder: &Path) -> Result<Self, Failure> {
        let path = folder.join("runs.jsonl");
        let file = File::open(&path).map_err(|error| {
            let message = format!("it cannot be read: {}", plain(&error));
            Failure::of(path.display().to_string(), message)
                .help("run the shard, or give the folder of its results")
        })?;
        Ok(Self::new(&path, BufReader::new(file)))
    }
}

impl<R: BufRead> Lines<R> {
    /// Reads lines from a reader; the path is only for messages.
    pub(super) fn new(path: &Path, reader: R) -> Self {
        Self { path: path.to_owned(), reader, number: 0, ends_line: true }
    }

    /// The next block, which must be this one.
    pub(super) fn block(&mut self, block: u64, runs: u64) -> Result<Block, Failure> {
        let (first, mut bytes) = (block * BLOCK, 0);
        let mut lines = Vec::new();
        for run in first..runs.min(first + BLOCK) {
            let mut text = String::new();
            let read = (&mut self.reader).take(LINE_BYTES).read_line(&mut text);
            let read = read.map_err(|error| self.wrong(format!("it cannot be read: {error}")))?;
            self.number += 1;
            self.ends_line = text.ends_with('\n');
            let found = match canonical::read::<Line>(text.trim_start_matches('\u{feff}')) {
                // A line that was torn is no object.
                Err(_) if !self.ends_line && (text.len() as u64) < LINE_BYTES => {
                    return Ok(Block::Torn);
                }
                found => found,
            };
            let canonical::Read { record: line, line: text, foreign } = found
                .map_err(|error| self.wrong(format!("this is no result of a run: {error}")))?;
            if let Some(canonical::Differing { field, .. }) = foreign {
                return Err(self.wrong(format!("this is no result of a run: `{field}` is unknown")));
            }
            if line.run != run {
                let message = format!("run {} stands where run {run} belongs", line.run);
                return Err(self.wrong(message));
            }
            bytes += read as u64;
            lines.push((line, text));
        }
        Ok(Block::Whole(lines, bytes))
    }

    /// Whether all is read but for empty lines.
    pub(super) fn is_at_end(&mut self) -> bool {
        loop {
            let Ok(rest) = self.reader.fill_buf() else { return false };
            if rest.is_empty() {
                return true;
            }
            if !rest.iter().all(u8::is_ascii_whitespace) {
                return false;
            }
            let length = rest.len();
            self.reader.consume(length);
        }
    }
}

impl<R> Lines<R> {
    /// The number of the line read last.
    pub(super) const fn number(&self) -> u64 {
        self.number
    }

    /// Something is wrong in the line read last.
    pub(super) fn wrong(&self, message: impl Into<String>) -> Failure {
        let help = "results are changed by nobody: run this part again in a new folder";
        self.wrong_at(self.number, message, help)
    }

    /// The same of a line, with what to do about it.
    pub(super) fn wrong_at(&self, line: u64, message: impl Into<String>, help: &str) -> Failure {
        Failure::of(format!("{}:{line}", self.path.display()), message).help(help)
    }
}

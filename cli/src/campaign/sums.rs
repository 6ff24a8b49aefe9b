//! Checksums of results: `runs.sums` has a line for each block of `runs.jsonl`.
//!
//! They are made of records, not of bytes: line ends and the order of keys are nobody's harm. Each
//! begins with what the header says, so that results under another header are seen.

use super::lines::Lines;
use crate::exit::Failure;
use cotama_campaign::results::{Digest, Header};
use cotama_campaign::run::Line;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Runs a block again: its lines.
pub(super) type Again<'a> = dyn Fn(u64) -> Vec<Line> + 'a;

/// The checksums of a folder.
#[derive(Debug)]
pub(super) struct Sums {
    pub(super) path: PathBuf,
    /// Digest of the header.
    seed: Digest,
    /// The number of each block, its checksum, and where its line ends.
    entries: Vec<(u64, String, u64)>,
}

impl Sums {
    /// Opens the sums beside the results of a folder, whose header this is; none are there before
    /// the first block.
    pub(super) fn of(folder: &Path, header: &Header) -> Result<Self, Failure> {
        let path = folder.join("runs.sums");
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            read => read.map_err(|error| {
                let message = format!("it cannot be read: {}", crate::input::plain(&error));
                Failure::of(path.display().to_string(), message)
                    .help("run this part again in a new folder")
            })?,
        };
        let (mut entries, mut end) = (Vec::new(), 0);
        // Text behind the last line end was torn.
        let whole = text.rfind('\n').map_or("", |at| &text[..=at]);
        for (number, line) in (1..).zip(whole.split_inclusive('\n')) {
            end += line.len() as u64;
            let parsed = line.trim_end().split_once(' ');
            let parsed = parsed.and_then(|(block, sum)| Some((block.parse().ok()?, sum)));
            let Some((block, sum)) = parsed else {
                let place = format!("{}:{number}", path.display());
                return Err(Failure::of(place, "this is no checksum of a block")
                    .help("run this part again in a new folder"));
            };
            entries.push((block, sum.to_owned(), end));
        }
        Ok(Self { path, seed: header.digest(), entries })
    }

    /// The line of a block.
    pub(super) fn line(&self, block: u64, lines: &[(Line, String)]) -> String {
        let mut digest = self.seed;
        for (_, text) in lines {
            digest.add(text.as_bytes());
            digest.add(b"\n");
        }
        format!("{block} {}\n", digest.hex())
    }

    /// How many bytes the checksums of the first so many blocks take.
    pub(super) fn end(&self, blocks: usize) -> u64 {
        blocks.checked_sub(1).and_then(|it| self.entries.get(it)).map_or(0, |it| it.2)
    }

    /// Refuses a block, the one at this position of its file, that is not what was written: by the
    /// first line that comes to something else when it is run again.
    pub(super) fn check<R>(
        &self,
        at: usize,
        block: u64,
        lines: &[(Line, String)],
        file: &Lines<R>,
        again: &Again<'_>,
    ) -> Result<(), Failure> {
        let help = "results are changed by nobody: run this part again in a new folder";
        let first = file.number() + 1 - lines.len() as u64;
        let Some((_, sum, _)) = self.entries.get(at).filter(|it| it.0 == block) else {
            let message = format!("block {block} has no checksum in `{}`", self.path.display());
            return Err(file.wrong_at(first, message, help));
        };
        if self.line(block, lines).trim_end() == format!("{block} {sum}") {
            return Ok(());
        }
        let text = |it: &Line| serde_json::to_string(it).unwrap_or_default();
        let differs =
            again(block).iter().zip(lines).position(|(is, (_, there))| text(is) != *there);
        Err(match differs {
            Some(at) => {
                let message = "the run does not come to this: the results were changed";
                file.wrong_at(first + at as u64, message, help)
            }
            None => Failure::of(
                format!("{}:{}", self.path.display(), at + 1),
                format!("this is not the checksum of block {block}"),
            )
            .help(help),
        })
    }
}

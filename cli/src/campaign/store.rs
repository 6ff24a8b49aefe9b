//! The folder of a campaign: `campaign.json` says what is run, `runs.jsonl` has a line a run.
//!
//! Lines are appended block by block and never changed. A program that was killed leaves whole
//! blocks and perhaps a torn one, which is dropped and run again.

use crate::exit::Failure;
use crate::input::{self, plain};
use crate::output;
use cotama_sim::campaign::results::Header;
use cotama_sim::campaign::run::{Line, Shard};
use cotama_sim::campaign::strategy::BLOCK;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The most bytes of a header.
const HEADER_BYTES: u64 = 16 << 20;
/// The most bytes of a line.
const LINE_BYTES: u64 = 1 << 20;

/// What takes the lines that are there already, each with its text; whether they are enough.
pub(super) type Taken<'t> = dyn FnMut(&Line, &str) -> bool + 't;

/// Results that grow.
pub(super) struct Store {
    path: PathBuf,
    file: File,
    /// Where the whole blocks end.
    end: u64,
}

impl Store {
    /// Opens the results of a campaign, or begins them; says how many whole blocks are there.
    pub(super) fn open(
        folder: &Path,
        header: &Header,
        taken: &mut Taken<'_>,
    ) -> Result<(Self, usize), Failure> {
        output::make_folder(folder)?;
        let (head, path) = (folder.join("campaign.json"), folder.join("runs.jsonl"));
        if head.exists() {
            let there = self::header(folder)?;
            let differs = there.differs_from(header);
            let differs = differs.or((there.shard != header.shard).then_some("shard"));
            if let Some(what) = differs {
                let message = format!("another campaign is in this folder: its {what} differs");
                return Err(Failure::of(folder.display().to_string(), message)
                    .help("choose another folder, or go on with the same options"));
            }
        } else if path.exists() {
            let message = "results without their campaign.json are in this folder";
            return Err(
                Failure::of(folder.display().to_string(), message).help("choose another folder")
            );
        } else {
            let text = serde_json::to_string_pretty(header).map_err(|error| {
                Failure::of(head.display().to_string(), format!("it cannot be written: {error}"))
            })?;
            output::file(&head, (text + "\n").as_bytes())?;
        }
        let wrong = |error: &std::io::Error| output::unwritten(&path, error);
        let mut options = OpenOptions::new();
        let file = options.create(true).truncate(false).read(true).write(true).open(&path);
        let mut file = file.map_err(|error| wrong(&error))?;
        let (mut end, mut blocks) = (0, 0);
        let there = file.try_clone().map_err(|error| wrong(&error))?;
        let mut reader = Lines::new(&path, BufReader::new(there));
        for block in header.shard.blocks(header.runs) {
            match reader.block(block, header.runs)? {
                Block::Whole(lines, bytes) => {
                    (end, blocks) = (end + bytes, blocks + 1);
                    if lines.iter().any(|(line, text)| taken(line, text)) {
                        break;
                    }
                }
                Block::Torn => break,
            }
        }
        file.set_len(end).map_err(|error| wrong(&error))?;
        file.seek(SeekFrom::Start(end)).map_err(|error| wrong(&error))?;
        Ok((Self { path, file, end }, blocks))
    }

    /// Adds the lines of a block.
    ///
    /// Two programs that run the same campaign write the same bytes to the same places: the later
    /// one of them sees that the file has grown, and stops before it writes.
    pub(super) fn append(&mut self, text: &str) -> Result<(), Failure> {
        if self.file.metadata().is_ok_and(|it| it.len() != self.end) {
            let message = "another program writes the results of this campaign";
            return Err(Failure::of(self.path.display().to_string(), message)
                .help("let it end, or give each its own folder or shard"));
        }
        self.end += text.len() as u64;
        let written = self.file.write_all(text.as_bytes());
        let written = written.and_then(|()| self.file.flush());
        written.map_err(|error| {
            output::unwritten(&self.path, &error)
                .help("make room, and give the same command again: it goes on from there")
        })
    }
}

/// The header of a folder of results.
pub(super) fn header(folder: &Path) -> Result<Header, Failure> {
    let path = folder.join("campaign.json").display().to_string();
    header_in(&path, &input::text(&path, "a campaign", HEADER_BYTES)?)
}

/// The header in a text, which is that of this file.
pub(super) fn header_in(path: &str, text: &str) -> Result<Header, Failure> {
    let header: Header = serde_json::from_str(text).map_err(|error| {
        Failure::of(path, format!("this is no campaign: {error}"))
            .help("`cotama campaign MISSION --out DIR` writes one")
    })?;
    let settings = header.settings();
    let is_mine = header.schema == cotama_sim::campaign::results::SCHEMA;
    if !is_mine || settings.is_none() || header.version != env!("CARGO_PKG_VERSION") {
        let message = format!(
            "written by another version: {} of {}, this is {}",
            header.schema.escape_debug(),
            header.version.escape_debug(),
            env!("CARGO_PKG_VERSION")
        );
        return Err(Failure::of(path, message).help("run it again with this version"));
    }
    let Shard { index, of } = header.shard;
    if !(1..=of).contains(&index) {
        let message = format!("shard {index}/{of}: its number is not one of the shards");
        return Err(Failure::of(path, message).help("run this shard again in a new folder"));
    }
    Ok(header)
}

/// A block of lines.
pub(super) enum Block {
    /// All its lines with their texts, and how many bytes they take.
    Whole(Vec<(Line, String)>, u64),
    /// The file ends before its end.
    Torn,
}

/// The lines of results, read block by block.
pub(super) struct Lines<R = BufReader<File>> {
    path: PathBuf,
    reader: R,
    number: u64,
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
    /// Those that are read here; the path is only for messages.
    pub(super) fn new(path: &Path, reader: R) -> Self {
        Self { path: path.to_owned(), reader, number: 0 }
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
            if text.pop() != Some('\n') {
                return Ok(Block::Torn);
            }
            let line: Line = serde_json::from_str(&text)
                .map_err(|error| self.wrong(format!("this is no result of a run: {error}")))?;
            if line.run != run {
                let message = format!("run {} stands where run {run} belongs", line.run);
                return Err(self.wrong(message));
            }
            bytes += read as u64;
            lines.push((line, text));
        }
        Ok(Block::Whole(lines, bytes))
    }

    /// Whether all is read.
    pub(super) fn is_at_end(&mut self) -> bool {
        self.reader.fill_buf().is_ok_and(<[u8]>::is_empty)
    }

    /// Something is wrong in the line read last.
    pub(super) fn wrong(&self, message: impl Into<String>) -> Failure {
        let help = "results are changed by nobody: run this part again in a new folder";
        self.wrong_with(message, help)
    }

    /// The same, with what to do about it.
    pub(super) fn wrong_with(&self, message: impl Into<String>, help: &str) -> Failure {
        let place = format!("{}:{}", self.path.display(), self.number);
        Failure::of(place, message).help(help)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_sim::campaign::run::Settings;
    use std::fs;

    #[test]
    fn the_later_of_two_programs_stops_before_it_writes() {
        let folder = std::env::temp_dir().join(format!("cotama-two-{}", std::process::id()));
        let header = Header::new(("own", ""), &Settings::new(false), "usual", Shard::ALL);
        let open = || Store::open(&folder, &header, &mut |_, _| false).unwrap().0;
        let (mut first, mut later) = (open(), open());
        assert!(first.append("a block\n").is_ok());
        assert!(later.append("b\n").is_err());
        assert!(first.append("another\n").is_ok());
        let runs = fs::read_to_string(folder.join("runs.jsonl")).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(runs, "a block\nanother\n");
    }
    #[test]
    fn a_header_whose_shard_is_none_of_the_shards_is_refused() {
        let said = |index, of| {
            let shard = Shard { index, of };
            let header = Header::new(("own", ""), &Settings::new(false), "usual", shard);
            let text = serde_json::to_string(&header).unwrap();
            match header_in("campaign.json", &text) {
                Err(Failure::Message { message, .. }) => Some(message),
                _ => None,
            }
        };
        assert_eq!(said(3, 3), None);
        for (index, of) in [(0, 3), (4, 3), (2, 0), (0, 0)] {
            let message = format!("shard {index}/{of}: its number is not one of the shards");
            assert_eq!(said(index, of), Some(message));
        }
    }
}

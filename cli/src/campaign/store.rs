//! The folder of a campaign: `campaign.json` says what is run, `runs.jsonl` has a line a run, and
//! `runs.sums` a checksum for each block of these.
//!
//! Lines are appended block by block and never changed. A program that was killed leaves whole
//! blocks and perhaps a torn one, which is dropped and run again; whole blocks are never dropped.

use super::lines::{Block, Lines};
use super::sums::{Again, Sums};
use crate::exit::Failure;
use crate::input;
use crate::output;
use cotama_campaign::results::Header;
use cotama_campaign::run::Line;
use cotama_verification::formats::json::read_object;
use std::fs::{File, OpenOptions};
use std::io::{BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The most bytes of a header.
const HEADER_BYTES: u64 = 16 << 20;

/// A consumer of lines that are stored already, each with its text.
pub(super) type Taken<'t> = dyn FnMut(&Line, &str) + 't;

/// Results that grow.
pub(super) struct Store {
    path: PathBuf,
    file: File,
    /// End of the whole blocks.
    end: u64,
    sums: Sums,
    sums_file: File,
}

impl Store {
    /// Opens the results of a campaign, or begins them; says how many whole blocks are there.
    /// Blocks whose checksum does not fit are run again, to say which line was changed.
    pub(super) fn open(
        folder: &Path,
        header: &Header,
        again: &Again<'_>,
        taken: &mut Taken<'_>,
    ) -> Result<(Self, usize), Failure> {
        output::make_folder(folder)?;
        let header = &begun(folder, header)?;
        let path = folder.join("runs.jsonl");
        let open = |path: &Path| {
            let mut options = OpenOptions::new();
            let file = options.create(true).truncate(false).read(true).write(true).open(path);
            file.map_err(|error| output::unwritten(path, &error))
        };
        let (mut file, sums) = (open(&path)?, Sums::of(folder, header)?);
        let wrong = |error: &std::io::Error| output::unwritten(&path, error);
        let (mut end, mut done, mut ends_line) = (0, 0, true);
        let there = file.try_clone().map_err(|error| wrong(&error))?;
        let mut reader = Lines::new(&path, BufReader::new(there));
        let mut torn = false;
        for block in header.shard.blocks(header.runs) {
            let Block::Whole(lines, bytes) = reader.block(block, header.runs)? else {
                torn = true;
                break;
            };
            sums.check(done, block, &lines, &reader, again)?;
            (end, done, ends_line) = (end + bytes, done + 1, reader.ends_line);
            lines.iter().for_each(|(line, text)| taken(line, text));
        }
        if !torn && !reader.is_at_end() {
            return Err(reader.wrong("more lines than the campaign has runs"));
        }
        let mut sums_file = open(&sums.path)?;
        for (file, end) in [(&mut file, end), (&mut sums_file, sums.end(done))] {
            file.set_len(end).map_err(|error| wrong(&error))?;
            file.seek(SeekFrom::Start(end)).map_err(|error| wrong(&error))?;
        }
        let mut store = Self { path: path.clone(), file, end, sums, sums_file };
        if !ends_line {
            store.write(b"\n")?;
        }
        Ok((store, done))
    }

    /// Adds a block: first its checksum, so that a whole block never lacks one.
    ///
    /// Two programs that run the same campaign write the same bytes to the same places: the later
    /// one of them sees that the file has grown, and stops before it writes.
    pub(super) fn append(&mut self, block: u64, lines: &[(Line, String)]) -> Result<(), Failure> {
        if self.file.metadata().is_ok_and(|it| it.len() != self.end) {
            let message = "another program writes the results of this campaign";
            return Err(Failure::of(self.path.display().to_string(), message)
                .help("let it end, or give each its own folder or shard"));
        }
        let sum = self.sums.line(block, lines);
        let written = self.sums_file.write_all(sum.as_bytes());
        let written = written.and_then(|()| self.sums_file.flush());
        written.map_err(|error| no_room(&self.sums.path, &error))?;
        let mut text = String::new();
        for (_, line) in lines {
            text.push_str(line);
            text.push('\n');
        }
        self.write(text.as_bytes())
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.end += bytes.len() as u64;
        let written = self.file.write_all(bytes).and_then(|()| self.file.flush());
        written.map_err(|error| no_room(&self.path, &error))
    }
}

fn no_room(path: &Path, error: &std::io::Error) -> Failure {
    output::unwritten(path, error)
        .help("make room, and give the same command again: it goes on from there")
}

/// The header of the campaign in this folder, which must be this one; it is written where none is.
fn begun(folder: &Path, header: &Header) -> Result<Header, Failure> {
    let (head, path) = (folder.join("campaign.json"), folder.join("runs.jsonl"));
    if head.exists() {
        let there = self::header(folder)?;
        let differs = differs(&there, header);
        let differs = differs.or((there.shard != header.shard).then_some("shard"));
        if let Some(what) = differs {
            let message = format!("another campaign is in this folder: its {what} differs");
            return Err(Failure::of(folder.display().to_string(), message)
                .help("choose another folder, or go on with the same options"));
        }
        return Ok(there);
    }
    if path.exists() {
        let message = "results without their campaign.json are in this folder";
        return Err(
            Failure::of(folder.display().to_string(), message).help("choose another folder")
        );
    }
    let text = serde_json::to_string_pretty(header).map_err(|error| {
        Failure::of(head.display().to_string(), format!("it cannot be written: {error}"))
    })?;
    output::file(&head, (text + "\n").as_bytes())?;
    Ok(header.clone())
}

/// In what two headers differ, but for the shard. Texts with the same values are one mission,
/// whatever their line ends, comments and order.
pub(super) fn differs(one: &Header, other: &Header) -> Option<&'static str> {
    let values = |it: &Header| it.mission.parse::<toml::Table>().ok();
    let same = values(one).is_some_and(|one| values(other).is_some_and(|other| one == other));
    let mission = if same { other.mission.clone() } else { one.mission.clone() };
    Header { mission, ..one.clone() }.differs_from(other)
}

/// The header of a folder of results.
pub(super) fn header(folder: &Path) -> Result<Header, Failure> {
    let path = folder.join("campaign.json").display().to_string();
    header_in(&path, &input::text(&path, "a campaign", HEADER_BYTES)?)
}

/// The header in a text, which is that of this file.
pub(super) fn header_in(path: &str, text: &str) -> Result<Header, Failure> {
    let header: Header = read_object(text).map_err(|error| {
        Failure::of(path, format!("this is no campaign: {error}"))
            .help("`cotama campaign MISSION --out DIR` writes one")
    })?;
    let is_mine = header.schema == cotama_campaign::results::SCHEMA;
    if !is_mine || header.version != env!("CARGO_PKG_VERSION") {
        let message = format!(
            "written by another version: {} of {}, this is {}",
            header.schema.escape_debug(),
            header.version.escape_debug(),
            env!("CARGO_PKG_VERSION")
        );
        return Err(Failure::of(path, message).help("run it again with this version"));
    }
    header.settings().map_err(|error| {
        Failure::of(path, error.to_string()).help("run this part again in a new folder")
    })?;
    Ok(header)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_campaign::run::{Settings, Shard};
    use std::fs;

    #[test]
    fn the_later_of_two_programs_stops_before_it_writes() {
        let folder = std::env::temp_dir().join(format!("cotama-two-{}", std::process::id()));
        let header = Header::new(("own", ""), &Settings::new(false), "usual", Shard::ALL);
        let open = || Store::open(&folder, &header, &|_| Vec::new(), &mut |_, _| {}).unwrap().0;
        let text = r#"{"run":0,"outcome":"safe","time_ms":5,"energy_mj":7,"x_mm":9,"requests":1,"#;
        let text = format!(r#"{text}"replans":0,"exposed_ms":0,"faults":[],"violated":[]}}"#);
        let block = [(serde_json::from_str(&text).unwrap(), text.clone())];
        let (mut first, mut later) = (open(), open());
        assert!(first.append(0, &block).is_ok());
        assert!(later.append(0, &block).is_err());
        assert!(first.append(1, &block).is_ok());
        let runs = fs::read_to_string(folder.join("runs.jsonl")).unwrap();
        let sums = fs::read_to_string(folder.join("runs.sums")).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(runs, format!("{text}\n{text}\n"));
        assert_eq!(sums.lines().count(), 2);
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

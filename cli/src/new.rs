//! `cotama new`: a mission, with axes or without, a robot, a team, a floor, an FMECA, or a crate
//! with a net or a system, that works as it is.
//!
//! The texts are the files in `templates/`, in which the name stands for the one that is wanted.

mod board;
mod mission;

use crate::answers::new::NewAnswer;
use crate::args::{NewArgs, NewKind};
use crate::exit::{Exit, Failure};
use crate::names::quoted;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// The files of a template, and the name in them.
struct Template {
    name: &'static str,
    files: &'static [(&'static str, &'static str)],
    /// Names that the crate needs for something else.
    taken: &'static [&'static str],
}

macro_rules! template {
    ($name:literal in $folder:literal, taken: $taken:expr) => {
        Template {
            name: $name,
            files: &[
                ("Cargo.toml", include_str!(concat!("../templates/", $folder, "/manifest.toml"))),
                ("src/lib.rs", include_str!(concat!("../templates/", $folder, "/lib.rs"))),
                ("src/main.rs", include_str!(concat!("../templates/", $folder, "/main.rs"))),
                (
                    "tests/checked.rs",
                    include_str!(concat!("../templates/", $folder, "/checked.rs")),
                ),
                ("examples/model.rs", include_str!(concat!("../templates/", $folder, "/model.rs"))),
            ],
            taken: $taken,
        }
    };
}

/// A template of one file.
struct OneFile {
    /// Says in words what it is.
    what: &'static str,
    text: &'static str,
    /// The name in the text.
    name: &'static str,
    /// Commands to go on with, in which `FILE` stands for the file.
    next: [&'static str; 2],
}

static MISSION: OneFile = OneFile {
    what: "a mission",
    text: include_str!("../templates/mission.toml"),
    name: "my-mission",
    next: ["plan FILE", "run FILE"],
};
static AXES: OneFile = OneFile {
    what: "a mission with axes",
    text: include_str!("../templates/axes.toml"),
    name: "my-axes",
    next: ["plan FILE", "explain FILE"],
};
static ROBOT: OneFile = OneFile {
    what: "a robot",
    text: include_str!("../templates/robot.toml"),
    name: "my-robot",
    next: ["check FILE", "export FILE --format svg"],
};
static TEAM: OneFile = OneFile {
    what: "a team",
    text: include_str!("../templates/team.toml"),
    name: "my-team",
    next: ["run FILE", "assign FILE"],
};
static FLOOR: OneFile = OneFile {
    what: "a floor",
    text: include_str!("../templates/floor.toml"),
    name: "my-floor",
    next: ["floor FILE", "floor FILE --from left --to right"],
};
static FMECA: OneFile = OneFile {
    what: "an FMECA",
    text: include_str!("../templates/fmeca.toml"),
    name: "my-fmeca",
    next: ["fmeca FILE", "fmeca FILE --diagnosability"],
};

static NET: Template = template!("my-net" in "net", taken: &["net"]);
static SYSTEM: Template =
    template!("my-system" in "system", taken: &["net", "system", "link", "drive", "state"]);

static BOARD: Template = Template {
    name: "my-net",
    files: &[
        ("Cargo.toml", include_str!("../templates/board/manifest.toml")),
        ("build.rs", include_str!("../templates/board/build.rs")),
        ("memory.x", include_str!("../templates/board/memory.x")),
        (".cargo/config.toml", include_str!("../templates/board/config.toml")),
        ("src/main.rs", include_str!("../templates/board/main.rs")),
    ],
    taken: &["net"],
};

/// The parts of a kind of project.
#[derive(Clone, Copy)]
enum Made {
    File(&'static OneFile),
    Crate(&'static Template),
    /// A crate beside the one that it plays.
    Board,
}

impl NewKind {
    fn made(self) -> Made {
        match self {
            Self::Mission => Made::File(&MISSION),
            Self::Axes => Made::File(&AXES),
            Self::Robot => Made::File(&ROBOT),
            Self::Team => Made::File(&TEAM),
            Self::Floor => Made::File(&FLOOR),
            Self::Fmeca => Made::File(&FMECA),
            Self::Net => Made::Crate(&NET),
            Self::System => Made::Crate(&SYSTEM),
            Self::Board => Made::Board,
        }
    }
}

/// Path of the sources in the templates, seen from the new crate.
const SOURCES: &str = "../cotama";

/// Words that no crate or module can be called: of the language, of its libraries, of Cargo.
const RESERVED: &str = "abstract alloc as async await become box break build const continue core \
    cotama_core cotama_verification crate deps do dyn else enum examples extern false final fn for \
    gen if impl in incremental let loop macro match mod move mut override priv proc_macro pub ref \
    return self static std struct super test trait true try type typeof unsafe unsized use virtual \
    where while yield";

/// Writes what is wanted, unless something is there already.
pub(crate) fn new(args: &NewArgs, screen: &Screen) -> Result<Exit, Failure> {
    let path = Path::new(&args.name);
    let name = path.file_name().and_then(|it| it.to_str()).unwrap_or_default();
    check_name(args.kind, name)?;
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let (is, help) = if folder.exists() {
            ("this is a file, and a folder is needed there", "choose another folder")
        } else {
            ("there is no such folder", "make it first")
        };
        let message = format!("{}: {is}", folder.display());
        return Err(Failure::new(message).help(format!("{help}, or say `{name}` alone")));
    }
    if args.robot.is_some() && args.kind != NewKind::Mission {
        let message = "--robot is for missions: it says whose supervisors decide";
        return Err(Failure::new(message).help("leave it out"));
    }
    if args.floor.is_some() && args.robot.is_none() {
        let message = "--floor is for missions of a robot: it says what the mission goes over";
        return Err(Failure::new(message).help("add `--robot`, or leave it out"));
    }
    let (files, next) = match args.kind.made() {
        Made::File(template) => {
            if args.sources.is_some() {
                let message = format!("--sources is for crates: {} is one file", template.what);
                return Err(Failure::new(message).help("leave it out"));
            }
            let file = path.with_file_name(format!("{name}.toml"));
            refuse_to_replace(&file)?;
            let text = match &args.robot {
                Some(robot) => mission::text(robot, args.floor.as_deref(), path.parent())?,
                None => template.text.to_owned(),
            };
            output::file(&file, text.replace(template.name, name).as_bytes())?;
            let shown = quoted(&file.display().to_string());
            let [first, second] = template.next.map(|it| it.replace("FILE", &shown));
            let next = format!("{NAME}cotama {first}{NAME:#}, {NAME}cotama {second}{NAME:#}");
            (vec![file], Some(next))
        }
        Made::Crate(template) => {
            refuse_to_replace(path)?;
            let sources = Sources::find(folder, args.sources.as_deref())?;
            let next = quoted(&path.display().to_string());
            let files = template.write(path, name, &sources.path, &[])?;
            sources.noted(folder, screen);
            (files, sources.with(&format!("cd {next} && cargo test")))
        }
        Made::Board => {
            let net = path.join("Cargo.toml");
            if !net.is_file() {
                let message = format!("{}: there is no such crate", path.display());
                return Err(Failure::new(message).help(format!(
                    "a board plays a crate beside it: `cotama new net {}` makes one",
                    quoted(&path.display().to_string())
                )));
            }
            let board = path.with_file_name(format!("{name}-board"));
            refuse_to_replace(&board)?;
            let sources = match (&args.sources, board::sources(path)) {
                (None, Some(seen)) => Sources { found: are_in(&path.join(&seen)), path: seen },
                _ => Sources::find(folder, args.sources.as_deref())?,
            };
            let unchanged = NET.text("src/lib.rs", name);
            let replaced = board::replaced(path, name, &unchanged)?;
            let next = quoted(&board.display().to_string());
            let files = BOARD.write(&board, name, &sources.path, &replaced)?;
            sources.noted(folder, screen);
            (files, sources.with(&format!("cd {next} && cargo run --release")))
        }
    };
    let files: Vec<_> = files.iter().map(|it| it.display().to_string()).collect();
    if args.json.json {
        Screen::json(&NewAnswer { schema: "cotama/new/1", files })?;
        return Ok(Exit::Success);
    }
    let mut text = String::new();
    for file in files {
        let _ = writeln!(text, "written: {file}");
    }
    if let Some(next) = next {
        let _ = writeln!(text, "\nnext: {next}");
    }
    screen.print(&text)?;
    Ok(Exit::Success)
}

impl Template {
    /// The text of a file in a crate of this name.
    fn text(&self, file: &str, name: &str) -> String {
        let text = self.files.iter().find(|it| it.0 == file).map_or("", |it| it.1);
        text.replace(&self.name.replace('-', "_"), &name.replace('-', "_")).replace(self.name, name)
    }

    /// Writes a crate to a folder, all files or none, with other lines in place of some.
    fn write(
        &self,
        path: &Path,
        name: &str,
        sources: &str,
        replaced: &[(String, String)],
    ) -> Result<Vec<PathBuf>, Failure> {
        let part = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
        let written = self
            .files
            .iter()
            .try_for_each(|(file, _)| {
                let mut text = self.text(file, name);
                for room in ["core", "verification"] {
                    let own = format!("\"{SOURCES}/{room}\"");
                    text = text.replace(&own, &quoted_path(sources, room));
                }
                for (from, to) in replaced {
                    text = text.replace(from.as_str(), to);
                }
                let file = part.join(file);
                file.parent().map_or(Ok(()), fs::create_dir_all)?;
                fs::write(file, text)
            })
            .and_then(|()| fs::rename(&part, path));
        written.map_err(|error| {
            let _ = fs::remove_dir_all(&part);
            output::unwritten(path, &error)
        })?;
        Ok(self.files.iter().map(|(file, _)| path.join(file)).collect())
    }
}

/// A folder of the sources as a text of TOML, which reads the escapes of JSON.
fn quoted_path(sources: &str, room: &str) -> String {
    serde_json::Value::from(format!("{sources}/{room}")).to_string()
}

fn refuse_to_replace(path: &Path) -> Result<(), Failure> {
    if path.symlink_metadata().is_err() {
        return Ok(());
    }
    let message = format!("{}: this is there already, and is not replaced", path.display());
    Err(Failure::new(message).help("choose another name, or move it away"))
}

/// Returns whether the sources of this project are in a folder.
fn are_in(path: &Path) -> bool {
    let manifest = fs::read_to_string(path.join("core/Cargo.toml")).unwrap_or_default();
    manifest.contains("name = \"cotama-core\"")
}

/// Path of the sources, seen from a new crate.
struct Sources {
    path: String,
    /// Says that they are there now.
    found: bool,
}

impl Sources {
    /// Finds them for a crate in this folder.
    fn find(folder: &Path, wanted: Option<&Path>) -> Result<Self, Failure> {
        let found = |path| Self { path, found: true };
        if let Some(wanted) = wanted {
            if !are_in(wanted) {
                let message = format!("--sources {}: there is no cotama", wanted.display());
                return Err(Failure::new(message)
                    .help("give the folder of this project's sources, with `core` in it"));
            }
            let whole = wanted.canonicalize().ok().and_then(|it| it.to_str().map(str::to_owned));
            return whole.map(found).ok_or_else(|| {
                let message = format!("--sources {}: this is no text in UTF-8", wanted.display());
                Failure::new(message)
            });
        }
        let places = [(SOURCES, "cotama"), ("..", "."), ("../..", "..")];
        let seen = places.into_iter().find(|(_, from)| are_in(&folder.join(from)));
        Ok(seen.map_or_else(
            || Self { path: SOURCES.to_owned(), found: false },
            |(seen, _)| found(seen.to_owned()),
        ))
    }

    /// Says where they are expected, where they are not.
    fn noted(&self, folder: &Path, screen: &Screen) {
        if !self.found {
            screen.note(&format!(
                "note: the sources of cotama are expected beside the crate, at {}; --sources says \
                 where else, or the two paths in its Cargo.toml",
                folder.join("cotama").display()
            ));
        }
    }

    /// A command that needs them, where it works.
    fn with(&self, command: &str) -> Option<String> {
        self.found.then(|| format!("{NAME}{command}{NAME:#}"))
    }
}

/// A mission and an FMECA are called as their files; a crate as a module of Rust, where `-` becomes
/// `_`.
fn check_name(kind: NewKind, name: &str) -> Result<(), Failure> {
    let taken = match kind.made() {
        Made::File(_) => None,
        Made::Crate(template) => Some(template.taken),
        Made::Board => Some(BOARD.taken),
    };
    let is_crate = taken.is_some();
    let fits = |c: char| c.is_ascii_alphanumeric() && !(is_crate && c.is_ascii_uppercase());
    let begins = |c: char| c.is_ascii_alphabetic() && fits(c);
    let all = name.chars().all(|c| fits(c) || c == '-' || c == '_');
    if name.len() > 64 || !name.starts_with(begins) || !all {
        let what = match kind.made() {
            Made::File(template) => template.what,
            Made::Crate(_) | Made::Board => "a crate",
        };
        let letters = if is_crate { "lower-case letters" } else { "letters" };
        let message = format!(
            "`{}` is no name for {what}: it is made of {letters} from a to z, digits, `-` and `_`, \
             begins with a letter, and has at most 64 of them",
            name.escape_debug()
        );
        return Err(advised(Failure::new(message), is_crate, name));
    }
    let Some(taken) = taken else {
        return Ok(());
    };
    let module = name.replace('-', "_");
    if RESERVED.split(' ').chain(taken.iter().copied()).any(|it| it == module) {
        return Err(Failure::new(format!(
            "`{name}` is a name that Rust or the crate itself needs"
        ))
        .help(format!("choose another one, as `my-{name}`")));
    }
    Ok(())
}

/// The same with the nearest name that fits.
fn advised(failure: Failure, is_crate: bool, name: &str) -> Failure {
    let near = name.strip_suffix(".toml").unwrap_or(name);
    let near: String = near
        .chars()
        .map(|c| if is_crate { c.to_ascii_lowercase() } else { c })
        .map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' })
        .collect();
    let near = near.trim_matches(|c: char| !c.is_ascii_alphanumeric());
    if near.len() <= 64 && near.starts_with(|c: char| c.is_ascii_alphabetic()) {
        failure.help(format!("`{near}` would fit"))
    } else {
        failure
    }
}

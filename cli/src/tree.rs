//! Behaviour trees: what the commands on models do with the XML of BehaviorTree.CPP.

mod beside;
mod certificate;
pub(crate) mod check;
mod conform;
mod export;
mod net;
mod sarif;
mod simulate;
mod statespace;

use crate::args::{BudgetArgs, LeafName, TreeArgs};
use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::output::Screen;
use beside::Bindings;
use cotama_trees::certificate::Beside;
use cotama_trees::diagnostic::{Diagnostic, Refusal, Severity};
use cotama_trees::explore::Limits;
use cotama_trees::kinds::{LeafKind, read_leaves};
use cotama_trees::reader::{Loaded, Options, read};
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) use certificate::{is_certificate, verify};
pub(crate) use conform::conform;
pub(crate) use export::export;
pub(crate) use simulate::simulate;
pub(crate) use statespace::statespace;

/// Most bytes of one file of a tree.
const TREE_BYTES: u64 = 64 << 20;

/// Whether a word of the command line means a file with a behaviour tree.
pub(crate) fn is(name: &str) -> bool {
    kind::is(name, Kind::Tree)
}

/// Refuses an option of trees for another model.
pub(crate) fn idle(option: Option<&'static str>, name: &str) -> Result<(), Failure> {
    let Some(option) = option else { return Ok(()) };
    let message = format!("{option} is for behaviour trees, and `{name}` is none");
    Err(Failure::new(message).help(format!("leave {option} out")))
}

/// Refuses the first option that is for nets.
fn only(options: &[(&'static str, bool)]) -> Result<(), Failure> {
    let Some((option, _)) = options.iter().find(|it| it.1) else { return Ok(()) };
    let message = format!("{option} is not for behaviour trees");
    Err(Failure::new(message).help(format!("leave {option} out")))
}

/// Returns the limits that were given.
fn limits(budget: &BudgetArgs) -> Limits {
    let standard = Limits::default();
    let bytes = usize::try_from(budget.max_memory).unwrap_or(usize::MAX);
    Limits {
        states: budget.max_states.map_or(standard.states, |it| it as usize),
        bytes: bytes.saturating_mul(1 << 20).min(standard.bytes),
        ..standard
    }
}

/// A tree with the files that it was read from.
struct Source {
    loaded: Loaded,
    options: Options,
    files: BTreeMap<String, Vec<u8>>,
    /// The supervisor beside it, as texts.
    beside: Option<Beside>,
}

/// Reads a tree.
fn load(path: &str, args: &TreeArgs) -> Result<Loaded, Failure> {
    Ok(source(path, args, None)?.loaded)
}

/// Reads a tree, and keeps its files; with a period the time of a supervisor counts.
fn source(path: &str, args: &TreeArgs, period: Option<u32>) -> Result<Source, Failure> {
    let bindings = Bindings::read(args)?;
    let mut leaves = match &args.leaves {
        Some(file) => {
            let text = input::text(file, "a file of leaves", TREE_BYTES)?;
            read_leaves(&text).map_err(|(line, why)| {
                let errors = FileErrors::at(file, text.clone(), line, 1, why);
                let help = "tag, kind, and where known the ports that it writes: `FlyTo\tstateful`";
                Failure::Text(Box::new(errors.help(help)))
            })?
        }
        None => Vec::new(),
    };
    if let Some(it) = &bindings {
        leaves.extend(it.leaves(&leaves));
    }
    let mut search = Vec::new();
    for folder in &args.search {
        search.extend(files(folder)?);
    }
    let options = Options {
        leaves,
        models: args.models.clone(),
        unknown: args.unknown.map(|it| match it {
            LeafName::Condition => LeafKind::Condition,
            LeafName::Sync => LeafKind::Sync,
            LeafName::Stateful => LeafKind::Stateful,
            LeafName::Service => LeafKind::Service,
        }),
        main: args.tree.clone(),
        search,
    };
    let mut files = BTreeMap::new();
    let mut from = |path: &str| {
        let bytes = input::bytes(path, "a behaviour tree", TREE_BYTES);
        let bytes = bytes.map_err(|failure| match failure {
            Failure::Message { message, .. } => message,
            Failure::Text(_) => "it is damaged".to_owned(),
        })?;
        files.insert(path.to_owned(), bytes.clone());
        Ok(bytes)
    };
    let mut loaded = read(path, &mut from, &options).map_err(|it| refused(&it))?;
    if let Some(it) = &bindings {
        it.bind(&mut loaded.tree, period)?;
    }
    let beside = bindings.map(|it| it.texts()).transpose()?;
    Ok(Source { loaded, options, files, beside })
}

/// Returns the XML files of a folder and of those in it, in the order of their names.
fn files(folder: &Path) -> Result<Vec<String>, Failure> {
    let mut found = Vec::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(at) = waiting.pop() {
        let fail = |it: std::io::Error| {
            Failure::of(at.display().to_string(), format!("cannot be read: {}", input::plain(&it)))
        };
        for entry in std::fs::read_dir(&at).map_err(fail)? {
            let path = entry.map_err(fail)?.path();
            if path.is_dir() && !path.is_symlink() {
                waiting.push(path);
            } else if path.extension().is_some_and(|it| it == "xml") {
                found.extend(path.to_str().map(str::to_owned));
            }
        }
    }
    found.sort();
    Ok(found)
}

/// Returns why there is no tree, with the lines of the file.
fn refused(refusal: &Refusal) -> Failure {
    let first = refusal.first();
    let errors: Vec<&Diagnostic> = refusal
        .diagnostics
        .iter()
        .filter(|it| it.severity == Severity::Error && it.file == first.file)
        .collect();
    shown(&first.file, &errors)
}

/// Returns findings about one file as a failure.
fn shown(file: &str, errors: &[&Diagnostic]) -> Failure {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned();
    let Some(first) = errors.first() else { return Failure::of(file, "no tree") };
    if first.place.line == 0 || text.is_empty() {
        let failure = Failure::of(file, &first.message);
        return match &first.help {
            Some(help) => failure.help(help),
            None => failure,
        };
    }
    let all = errors.iter().map(|it| {
        let at = (it.place.line.max(1) as usize, it.place.column.max(1) as usize);
        (at, it.message.clone(), it.help.clone())
    });
    Failure::Text(Box::new(FileErrors::at_characters(file, text, all)))
}

/// Refuses a tree with a node that throws whenever it is ticked.
fn sound(loaded: &Loaded) -> Result<(), Failure> {
    let throws = loaded.notes.iter().filter(|it| it.severity == Severity::Throws);
    let throws: Vec<_> = throws.collect();
    match throws.first() {
        Some(first) => Err(shown(&first.file, &throws)),
        None => Ok(()),
    }
}

/// Says what is to be said of the files.
fn warn(loaded: &Loaded, screen: &Screen) {
    for it in &loaded.notes {
        screen.note(&it.to_string());
    }
}

//! `--with` and `--bind`: a supervisor beside a tree.

use crate::args::TreeArgs;
use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::model;
use cotama_core::system::{Component, System};
use cotama_trees::certificate::Beside;
use cotama_trees::kinds::{Leaf, nav2};
use cotama_trees::supervisor::{Bindings as Written, Supervisor, Unfit, Wrong};
use cotama_trees::tree::Tree;
use cotama_verification::formats::json;
use cotama_verification::play::Numbered;

/// Most bytes of a file that binds leaves.
const MOST_BYTES: u64 = 1 << 20;

/// A file of bonds, as it is written.
pub(super) struct Bindings {
    supervisor: String,
    path: String,
    text: String,
    written: Written,
}

impl Bindings {
    /// Reads the file, if one is given.
    pub(super) fn read(args: &TreeArgs) -> Result<Option<Self>, Failure> {
        let (Some(supervisor), Some(path)) = (&args.with, &args.bind) else { return Ok(None) };
        let text = input::text(path, "a file that binds leaves", MOST_BYTES)?;
        let written = Written::read(&text).map_err(|it| wrong(path, &text, it))?;
        Ok(Some(Self { supervisor: supervisor.clone(), path: path.clone(), text, written }))
    }

    /// Returns the model and the bonds as texts, for a certificate.
    pub(super) fn texts(&self) -> Result<Beside, Failure> {
        let model = model::with_system(&self.supervisor, |system, _| {
            match (Numbered::of(system).is_system(), system.components) {
                (false, [alone]) => json::write(alone.net),
                _ => json::write_system(system),
            }
        })?;
        Ok(Beside { model, bindings: self.text.clone() })
    }

    /// Returns the leaves that nothing else describes.
    pub(super) fn leaves(&self, known: &[Leaf]) -> Vec<Leaf> {
        let known: Vec<_> = known.iter().cloned().chain(nav2()).map(|it| it.tag).collect();
        let all = self.written.leaves().into_iter();
        all.filter(|it| !known.contains(&it.tag)).collect()
    }

    /// Binds the leaves of a tree.
    pub(super) fn bind(&self, tree: &mut Tree, period: Option<u32>) -> Result<(), Failure> {
        let name = &self.supervisor;
        let explored = model::with_system(name, |system, _| {
            Supervisor::of(system, period, &self.written.never())
        })?;
        let net = explored.map_err(|it| {
            let failure = Failure::new(format!("--with `{name}`: {it}"));
            match it {
                Unfit::Plain => failure.help("a supervisor has events: see `cotama models`"),
                Unfit::Large => {
                    failure.help("name one of its nets alone, or say which events `never` happen")
                }
                _ => failure,
            }
        })?;
        self.written.bind(tree, net).map_err(|it| wrong(&self.path, &self.text, it))
    }
}

/// Explores the model in a certificate.
pub(super) fn explored(
    text: &str,
    period: Option<u32>,
    never: &[&str],
) -> Result<Supervisor, String> {
    let of = |system: &System<'_>| Supervisor::of(system, period, never);
    let found = if kind::is_of(text, Kind::JsonSystem) {
        json::read_system(text).map(|it| it.with(of))
    } else {
        json::read(text).map(|it| of(&System::alone(&[Component::alone(&it.view().net())])))
    };
    found.map_err(|it| it.message)?.map_err(|it| it.to_string())
}

fn wrong(path: &str, text: &str, it: Wrong) -> Failure {
    let (text, path) = (text.to_owned(), input::name(path));
    let errors = FileErrors::at(path, text, it.line, it.column, it.message);
    Failure::Text(Box::new(match it.help {
        Some(help) => errors.help(help),
        None => errors,
    }))
}

//! The options of behaviour trees, which several commands have.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// How the files of a behaviour tree are read.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Behaviour trees")]
pub(crate) struct TreeArgs {
    /// The tree to execute, where the file names none or another
    #[arg(long, value_name = "ID")]
    pub(crate) tree: Option<String>,
    /// Leaves of your own: lines of a tag, a kind and the ports that it writes; those of Nav2 are
    /// known
    #[arg(long, value_name = "FILE.tsv")]
    pub(crate) leaves: Option<String>,
    /// A file whose `TreeNodesModel` describes leaves
    #[arg(long, value_name = "FILE.xml")]
    pub(crate) models: Vec<String>,
    /// A folder in whose files subtrees are looked for
    #[arg(long, value_name = "DIR")]
    pub(crate) search: Vec<PathBuf>,
    /// Takes leaves that nothing describes as leaves of this kind
    #[arg(long, value_enum, value_name = "KIND")]
    pub(crate) unknown: Option<LeafName>,
    /// A supervisor beside the tree: a net or a system, by name or file
    #[arg(long, value_name = "MODEL", requires = "bind")]
    pub(crate) with: Option<String>,
    /// Binds leaves to the supervisor by a file of lines as `Open starts Call succeeds at Open`
    #[arg(long, value_name = "FILE", requires = "with")]
    pub(crate) bind: Option<String>,
}

/// Questions about a behaviour tree.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Behaviour trees")]
pub(crate) struct TreeWishes {
    /// An assumption: `LEAF never F`, `LEAF succeeds`, `LEAF fails until ENTRY written`
    #[arg(long, value_name = "TEXT")]
    pub(crate) assume: Vec<String>,
    /// Actions of which no two may run or start together
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub(crate) exclusive: Vec<String>,
    /// Entries that are written before the first tick
    #[arg(long, value_name = "ENTRY", value_delimiter = ',')]
    pub(crate) given: Vec<String>,
    /// Lets leaves answer SKIPPED too
    #[arg(long)]
    pub(crate) skips: bool,
    /// Lets ticks come every so many ms: timers and rates count, instead of being free
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) period: Option<u32>,
    /// Shows notes too, each with its run
    #[arg(long)]
    pub(crate) notes: bool,
    /// Which findings end with exit code 1, besides errors
    #[arg(long, value_enum, value_name = "LEVEL")]
    pub(crate) deny: Option<Deny>,
    /// Writes the findings as pages into this folder, each run tick by tick on the tree
    #[arg(long, value_name = "DIR")]
    pub(crate) html: Option<PathBuf>,
}

/// The kind of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LeafName {
    /// Asked at every tick, SUCCESS or FAILURE
    Condition,
    /// The same, for an action that ends at once
    Sync,
    /// An action that may run
    Stateful,
    /// A request that is polled
    Service,
}

/// Which findings are refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Deny {
    /// Warnings
    Warnings,
    /// Warnings and notes
    Notes,
}

impl TreeArgs {
    /// Returns the first option given.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let all = [
            ("--tree", self.tree.is_some()),
            ("--leaves", self.leaves.is_some()),
            ("--models", !self.models.is_empty()),
            ("--search", !self.search.is_empty()),
            ("--unknown", self.unknown.is_some()),
            ("--with", self.with.is_some()),
        ];
        all.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

impl TreeWishes {
    /// Returns the first option given.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let all = [
            ("--assume", !self.assume.is_empty()),
            ("--exclusive", !self.exclusive.is_empty()),
            ("--given", !self.given.is_empty()),
            ("--skips", self.skips),
            ("--period", self.period.is_some()),
            ("--notes", self.notes),
            ("--deny", self.deny.is_some()),
            ("--html", self.html.is_some()),
        ];
        all.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

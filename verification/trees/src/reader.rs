//! Files of trees become a [`Tree`]: includes, subtrees, ports, guards.

mod expand;
mod kind;
mod sources;
mod text;

use crate::diagnostic::{Diagnostic, Findings, Refusal};
use crate::kinds::{Leaf, LeafKind};
use crate::tree::Tree;

/// Files as the reader asks for them; the caller decides what may be read.
pub trait Files {
    /// Returns the bytes of a file.
    ///
    /// # Errors
    ///
    /// Returns why it cannot be read.
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String>;
}

/// Reads files by a function.
impl<F: FnMut(&str) -> Result<Vec<u8>, String>> Files for F {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        self(path)
    }
}

/// Settings of the reader beside the file.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Leaves of the user; they go before those of Nav2 and before models in the file.
    pub leaves: Vec<Leaf>,
    /// Files whose `TreeNodesModel` describes leaves.
    pub models: Vec<String>,
    /// The kind of leaves that nothing describes; without it they are errors.
    pub unknown: Option<LeafKind>,
    /// The tree to execute, if the file does not say, or another than it says.
    pub main: Option<String>,
    /// Files in which subtrees are looked for that no file included defines.
    pub search: Vec<String>,
}

/// A tree, and what is to be said of its files.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The tree.
    pub tree: Tree,
    /// Warnings, and nodes that throw whenever they are ticked.
    pub notes: Vec<Diagnostic>,
}

/// Reads a file and all that it includes.
///
/// ```
/// use cotama_trees::reader::{Options, read};
/// let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
///   <ReactiveSequence><BatteryOk/><Move/></ReactiveSequence>
/// </BehaviorTree></root>"#;
/// let mut files = |_: &str| Ok(text.as_bytes().to_vec());
/// let refused = read("mine.xml", &mut files, &Options::default()).unwrap_err();
/// assert_eq!(
///     refused.first().message,
///     "unknown node BatteryOk: neither built in nor described"
/// );
/// ```
///
/// # Errors
///
/// Returns everything that keeps the file from being a tree, with places.
pub fn read(name: &str, files: &mut dyn Files, options: &Options) -> Result<Loaded, Refusal> {
    let mut findings = Findings::default();
    let tree = sources::read(name, files, options, &mut findings).and_then(|sources| {
        let main = sources.main(options, &mut findings)?;
        expand::expand(&sources, options, &main, &mut findings)
    });
    let has_errors = findings.has_errors();
    let files = std::mem::take(&mut findings.files);
    findings.files.clone_from(&files);
    let diagnostics = findings.sorted();
    match tree {
        Some(mut tree) if !has_errors => {
            tree.files = files;
            Ok(Loaded { tree, notes: diagnostics })
        }
        _ => Err(Refusal { diagnostics }),
    }
}

/// Reads a tree from one text, with generic leaves for what nothing describes.
///
/// # Errors
///
/// As [`read`]; an included file cannot be read.
pub fn read_text(text: &str) -> Result<Loaded, Refusal> {
    let mut files = |path: &str| match path {
        "tree.xml" => Ok(text.as_bytes().to_vec()),
        _ => Err("there is one text alone".to_owned()),
    };
    let options = Options { unknown: Some(LeafKind::Stateful), ..Options::default() };
    read("tree.xml", &mut files, &options)
}

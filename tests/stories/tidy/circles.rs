//! Imports between the files of a crate, and the circles that they make.
//!
//! Imports are `use` declarations outside of inline test modules. A name is followed through
//! re-exports to the file that declares it, so a module that only re-exports is in no circle. A
//! parent and its child may import each other.

use super::source::Source;
use std::collections::{BTreeMap, BTreeSet};

/// A module by its path from the crate's root.
type Module<'s> = Vec<&'s str>;

/// An import: the module named, the rest of the path, and the name that it gets.
struct Import<'s> {
    module: Module<'s>,
    rest: Vec<&'s str>,
    name: Option<&'s str>,
    is_public: bool,
}

struct Crate<'s> {
    files: BTreeMap<Module<'s>, &'s Source>,
    imports: BTreeMap<Module<'s>, Vec<Import<'s>>>,
}

/// Returns the circles: sets of files of which each one imports each other, if not at once.
pub(crate) fn circles(all: &[Source]) -> Vec<Vec<String>> {
    let mut crates = BTreeMap::<&str, BTreeMap<Module<'_>, &Source>>::new();
    for source in all {
        if let Some((root, path)) = source.path.split_once("/src/") {
            crates.entry(root).or_default().insert(module(path), source);
        }
    }
    let circles = crates.into_values().flat_map(|files| Crate::new(files).circles());
    circles.collect()
}

fn module(path: &str) -> Module<'_> {
    let path = path.strip_suffix(".rs").unwrap_or(path);
    let path = path.strip_suffix("/mod").unwrap_or(path);
    if matches!(path, "lib" | "main") { Vec::new() } else { path.split('/').collect() }
}

impl<'s> Crate<'s> {
    fn new(files: BTreeMap<Module<'s>, &'s Source>) -> Self {
        let mut imports = BTreeMap::new();
        for (at, source) in &files {
            let all = declarations(&source.text).into_iter().flat_map(|(is_public, tree)| {
                paths(tree).into_iter().map(move |(path, name)| (is_public, path, name))
            });
            let all = all.filter_map(|(is_public, path, name)| {
                let (module, rest) = located(&files, at, &path)?;
                Some(Import { module, rest, name, is_public })
            });
            imports.insert(at.clone(), all.collect::<Vec<_>>());
        }
        Self { files, imports }
    }

    /// Returns the module that declares a name which `at` declares or re-exports.
    fn owner(&self, at: &Module<'s>, name: &str, depth: usize) -> Module<'s> {
        let imports = self.imports.get(at).map_or(&[][..], Vec::as_slice);
        let given = |it: &&Import<'s>| {
            it.module != *at
                && it.name.or_else(|| it.rest.last().or(it.module.last()).copied()) == Some(name)
        };
        if let Some(it) = imports.iter().find(given).filter(|_| depth > 0) {
            return match it.rest.last() {
                Some(last) => self.owner(&it.module, last, depth - 1),
                None => it.module.clone(),
            };
        }
        let declares = |it: &&Import<'s>| {
            it.is_public && it.rest == ["*"] && is_declared(&self.files[&it.module].text, name)
        };
        imports.iter().find(declares).map_or_else(|| at.clone(), |it| it.module.clone())
    }

    fn edges(&self) -> BTreeMap<&Module<'s>, BTreeSet<Module<'s>>> {
        let is_child = |a: &[&str], b: &[&str]| a.split_last().is_some_and(|it| it.1 == b);
        let is_related = |a: &[&str], b: &[&str]| a == b || is_child(a, b) || is_child(b, a);
        let mut edges = BTreeMap::<_, BTreeSet<_>>::new();
        for (at, imports) in &self.imports {
            for it in imports {
                let to = match it.rest.first() {
                    Some(&name) if name != "*" && name != "self" => self.owner(&it.module, name, 8),
                    _ => it.module.clone(),
                };
                if !is_related(at, &to) {
                    edges.entry(at).or_default().insert(to);
                }
            }
        }
        edges
    }

    fn circles(&self) -> Vec<Vec<String>> {
        let edges = self.edges();
        let reached = |from: &Module<'s>| {
            let (mut met, mut open) = (BTreeSet::new(), vec![from.clone()]);
            while let Some(at) = open.pop() {
                for to in edges.get(&at).into_iter().flatten() {
                    if met.insert(to.clone()) {
                        open.push(to.clone());
                    }
                }
            }
            met
        };
        let reached: BTreeMap<_, _> = edges.keys().map(|it| ((*it).clone(), reached(it))).collect();
        let mut circles = BTreeSet::new();
        for (at, met) in reached.iter().filter(|(at, met)| met.contains(*at)) {
            let back = |it: &&Module<'s>| reached.get(*it).is_some_and(|met| met.contains(at));
            let files = met.iter().filter(back).map(|it| self.files[it].path.clone());
            let mut files: Vec<_> = files.collect();
            files.sort();
            circles.insert(files);
        }
        circles.into_iter().collect()
    }
}

/// Returns whether a text declares an item of this name.
fn is_declared(text: &str, name: &str) -> bool {
    let kinds = ["struct ", "enum ", "fn ", "trait ", "type ", "const ", "static "];
    kinds.iter().any(|kind| {
        text.match_indices(&format!("{kind}{name}")).any(|(at, it)| {
            !text[at + it.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
        })
    })
}

/// Returns the trees of the `use` declarations of a file, and whether each is a re-export.
fn declarations(text: &str) -> Vec<(bool, &str)> {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let mut all = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let start = line.trim_start();
        let is_public = start.starts_with("pub");
        let rest = if is_public { start.split_once(' ').map_or("", |it| it.1) } else { start };
        if let Some(tree) = rest.strip_prefix("use ") {
            let begin = at + line.len() - tree.len();
            let end = text[begin..].find(';').map_or(text.len(), |it| begin + it);
            all.push((is_public, &text[begin..end]));
        }
        at += line.len();
    }
    all
}

/// Returns the paths of a tree, each with the name that `as` gives.
fn paths(tree: &str) -> Vec<(Vec<&str>, Option<&str>)> {
    let tree = tree.trim();
    let Some((before, inner)) = tree.split_once('{') else {
        let (path, name) = tree.split_once(" as ").map_or((tree, None), |it| (it.0, Some(it.1)));
        return vec![(path.split("::").map(str::trim).collect(), name.map(str::trim))];
    };
    let inner = inner.rsplit_once('}').map_or(inner, |it| it.0);
    let (mut depth, mut start, mut parts) = (0_usize, 0, Vec::new());
    for (at, it) in inner.char_indices() {
        match it {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(&inner[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&inner[start..]);
    let before: Vec<&str> = before.split("::").map(str::trim).filter(|it| !it.is_empty()).collect();
    let parts = parts.into_iter().filter(|it| !it.trim().is_empty()).flat_map(paths);
    parts.map(|(path, name)| ([&before[..], &path[..]].concat(), name)).collect()
}

/// Returns the deepest module that a path of `at` names, with the rest of the path; `None` for
/// paths into other crates.
fn located<'s>(
    files: &BTreeMap<Module<'s>, &'s Source>,
    at: &Module<'s>,
    path: &[&'s str],
) -> Option<(Module<'s>, Vec<&'s str>)> {
    let (mut module, mut rest) = (at.clone(), path);
    match rest.first().copied()? {
        "crate" => {
            module.clear();
            rest = &rest[1..];
        }
        "self" => rest = &rest[1..],
        "super" => {
            while rest.first() == Some(&"super") {
                module.pop()?;
                rest = &rest[1..];
            }
        }
        child => {
            module.push(child);
            files.get(&module)?;
            rest = &rest[1..];
        }
    }
    while let Some(&name) = rest.first() {
        module.push(name);
        if !files.contains_key(&module) {
            module.pop();
            break;
        }
        rest = &rest[1..];
    }
    Some((module, rest.to_vec()))
}

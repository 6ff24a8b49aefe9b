//! Files that bind leaves to a supervisor: read once, every error with its line and column.

use super::{Acts, Bond, Bonds, Sight, Supervisor, When};
use crate::diagnostic::nearest;
use crate::kinds::{Leaf, LeafKind};
use crate::machine::MOST_MOVES;
use crate::tree::{Kind, Node, Tree};
use std::collections::BTreeMap;

/// A mistake in a file, with the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// From 1.
    pub line: usize,
    /// In bytes, from 1.
    pub column: usize,
    /// The cause.
    pub message: String,
    /// The remedy.
    pub help: Option<String>,
}

/// A word with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Word {
    text: String,
    line: usize,
    column: usize,
}

impl Word {
    fn wrong(&self, message: String) -> Wrong {
        Wrong { line: self.line, column: self.column, message, help: None }
    }

    /// Refuses a name, with the nearest that there is.
    fn unknown<'n>(&self, what: &str, names: impl IntoIterator<Item = &'n str>) -> Wrong {
        let near = nearest(&self.text, names);
        let near = near.map(|it| format!("; did you mean {it}?")).unwrap_or_default();
        self.wrong(format!("no {what} {}{near}", self.text))
    }
}

/// Way of seeing something in a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Looks {
    At,
    NotAt,
    After,
    Upon,
}

type Sights = Vec<(Looks, Word)>;

/// A file as it is written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bindings {
    lines: Vec<Line>,
    /// Events that do not happen.
    never: Vec<Word>,
    /// Sights upon which the tree is halted.
    cancels: Sights,
}

/// A leaf and its clauses.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Line {
    leaf: Word,
    reads: Option<Sights>,
    starts: Option<Word>,
    tries: bool,
    succeeds: Option<Sights>,
    fails: Option<Sights>,
    halts: Option<Word>,
}

const CLAUSES: [&str; 6] = ["starts", "tries", "succeeds", "fails", "halts", "reads"];

impl Bindings {
    /// Reads a file. A line has a leaf and clauses: `starts EVENT` or `tries EVENT`, `succeeds
    /// WHEN`, `fails WHEN`, `halts EVENT`; of a condition `reads WHEN`. WHEN is `at PLACE`, `not at
    /// PLACE`, `after TRANSITION`, `upon OUTPUT`, or several with `or` between them. Or it has
    /// `never` and events that do not happen, or `cancel WHEN`: then the tree is halted before its
    /// next tick. `#` begins a comment; names with blanks stand in double quotes.
    ///
    /// # Errors
    /// Returns the first mistake.
    pub fn read(text: &str) -> Result<Bindings, Wrong> {
        let mut all = Bindings::default();
        let mut known = BTreeMap::new();
        for (at, line) in text.lines().enumerate() {
            let words = words(line, at + 1)?;
            let Some((leaf, rest)) = words.split_first() else { continue };
            if leaf.text == "never" {
                if rest.is_empty() {
                    return Err(leaf.wrong("after `never` stand events".to_owned()));
                }
                all.never.extend_from_slice(rest);
                continue;
            }
            if leaf.text == "cancel" {
                let (sights, rest) = when(leaf, rest)?;
                if let Some(word) = rest.first() {
                    return Err(word.wrong("nothing is expected here".to_owned()));
                }
                all.cancels.extend(sights);
                continue;
            }
            if let Some(line) = known.insert(leaf.text.clone(), leaf.line) {
                let message = format!("{} is bound in line {line} already", leaf.text);
                return Err(leaf.wrong(message));
            }
            all.lines.push(clauses(leaf, rest)?);
        }
        Ok(all)
    }

    /// Returns the leaves with kinds, for trees whose leaves nothing else describes.
    pub fn leaves(&self) -> Vec<Leaf> {
        self.lines.iter().map(Line::leaf).collect()
    }

    /// Returns the events that do not happen.
    pub fn never(&self) -> Vec<&str> {
        self.never.iter().map(|it| it.text.as_str()).collect()
    }
}

/// Splits a line; nothing is left of a comment.
fn words(line: &str, number: usize) -> Result<Vec<Word>, Wrong> {
    let mut words = Vec::new();
    let mut at = 0;
    while at < line.len() {
        let rest = &line[at..];
        let blanks = rest.len() - rest.trim_start().len();
        if blanks > 0 {
            at += blanks;
            continue;
        }
        if rest.starts_with('#') {
            break;
        }
        let word = |text: &str| Word { text: text.to_owned(), line: number, column: at + 1 };
        if let Some(quoted) = rest.strip_prefix('"') {
            let Some(end) = quoted.find('"') else {
                return Err(word("").wrong("a name without its closing quote".to_owned()));
            };
            words.push(word(&quoted[..end]));
            at += end + 2;
        } else {
            let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            words.push(word(&rest[..end]));
            at += end;
        }
    }
    Ok(words)
}

fn clauses(leaf: &Word, rest: &[Word]) -> Result<Line, Wrong> {
    let mut it = Line {
        leaf: leaf.clone(),
        reads: None,
        starts: None,
        tries: false,
        succeeds: None,
        fails: None,
        halts: None,
    };
    let mut rest = rest;
    while let Some((clause, after)) = rest.split_first() {
        let twice = || clause.wrong(format!("`{}` a second time", clause.text));
        let is_given = match clause.text.as_str() {
            "starts" | "tries" => it.starts.is_some(),
            "halts" => it.halts.is_some(),
            "succeeds" => it.succeeds.is_some(),
            "fails" => it.fails.is_some(),
            "reads" => it.reads.is_some(),
            _ => {
                let near = nearest(&clause.text, CLAUSES);
                let near = near.map(|it| format!("; did you mean {it}?")).unwrap_or_default();
                let words = CLAUSES.join(", ");
                let message = format!("`{}` is none of {words}{near}", clause.text);
                return Err(clause.wrong(message));
            }
        };
        if is_given {
            return Err(twice());
        }
        rest = match clause.text.as_str() {
            event @ ("starts" | "tries" | "halts") => {
                let Some((name, after)) = after.split_first() else {
                    return Err(clause.wrong(format!("after `{event}` stands an event")));
                };
                if event == "halts" {
                    it.halts = Some(name.clone());
                } else {
                    (it.starts, it.tries) = (Some(name.clone()), event == "tries");
                }
                after
            }
            sights => {
                let (found, after) = when(clause, after)?;
                match sights {
                    "succeeds" => it.succeeds = Some(found),
                    "fails" => it.fails = Some(found),
                    _ => it.reads = Some(found),
                }
                after
            }
        };
    }
    let acts = it.starts.is_some() || it.succeeds.is_some() || it.fails.is_some();
    let mut wrong = None;
    if it.reads.is_some() && (acts || it.halts.is_some()) {
        wrong = Some("a leaf that reads does nothing else");
    } else if it.reads.is_none() && !acts {
        wrong = Some("a leaf starts, tries, succeeds, fails or reads something");
    } else if it.halts.is_some() && it.succeeds.is_none() && it.fails.is_none() {
        wrong = Some("it answers at once, and is never halted: say when it succeeds or fails");
    }
    match wrong {
        Some(message) => Err(leaf.wrong(format!("{}: {message}", leaf.text))),
        None => Ok(it),
    }
}

/// Reads sights, up to the next clause.
fn when<'w>(clause: &Word, rest: &'w [Word]) -> Result<(Sights, &'w [Word]), Wrong> {
    let (mut all, mut rest) = (Vec::new(), rest);
    loop {
        let texts: Vec<_> = rest.iter().take(3).map(|it| it.text.as_str()).collect();
        let (looks, words) = match texts.as_slice() {
            ["at", ..] => (Looks::At, 1),
            ["not", "at", ..] => (Looks::NotAt, 2),
            ["after", ..] => (Looks::After, 1),
            ["upon", ..] => (Looks::Upon, 1),
            _ => {
                let last = rest.first().unwrap_or(clause);
                let form = "at PLACE, not at PLACE, after TRANSITION or upon OUTPUT";
                return Err(last.wrong(format!("after `{}` stands {form}", clause.text)));
            }
        };
        let Some(name) = rest.get(words) else {
            let last = &rest[words - 1];
            return Err(last.wrong(format!("after `{}` stands a name", last.text)));
        };
        all.push((looks, name.clone()));
        rest = &rest[words + 1..];
        match rest.first() {
            Some(or) if or.text == "or" => rest = &rest[1..],
            _ => return Ok((all, rest)),
        }
    }
}

impl Line {
    fn leaf(&self) -> Leaf {
        let kind = if self.reads.is_some() {
            LeafKind::Condition
        } else if self.succeeds.is_some() || self.fails.is_some() {
            LeafKind::Stateful
        } else {
            LeafKind::Sync
        };
        Leaf { tag: self.leaf.text.clone(), kind, writes: Vec::new() }
    }
}

impl Bindings {
    /// Binds the leaves of a tree to a supervisor.
    ///
    /// # Errors
    /// Returns the first mistake: a name that is not there, or a leaf whose kind answers otherwise.
    pub fn bind(&self, tree: &mut Tree, net: Supervisor) -> Result<(), Wrong> {
        let mut of: Vec<Option<Bond>> = vec![None; tree.nodes.len()];
        for it in &self.lines {
            let bond = bond(it, &net)?;
            for node in named(it, tree)? {
                fits(it, &tree.nodes[node].kind)?;
                if of[node].is_some() {
                    let name = &it.leaf.text;
                    let message = format!("{name}: {} is bound already", tree.shown(node));
                    return Err(it.leaf.wrong(message));
                }
                of[node] = Some(bond.clone());
            }
        }
        let moves = self.moves(&of, &net)?;
        let cancels = seen(&self.cancels, &net)?;
        tree.bonds = Some(Box::new(Bonds { net, moves, of, cancels }));
        Ok(())
    }

    /// Returns the events that happen, and that no leaf offers.
    fn moves(&self, of: &[Option<Bond>], net: &Supervisor) -> Result<Vec<usize>, Wrong> {
        let events = of.iter().flatten().flat_map(|it| match it {
            Bond::Acts(it) => [it.starts, it.halts],
            Bond::Reads(_) => [None, None],
        });
        let offered: Vec<_> = events.flatten().chain(net.pass).collect();
        let mut happens = vec![true; net.events.len()];
        offered.iter().for_each(|it| happens[*it] = false);
        for word in &self.never {
            let Some(at) = net.events.iter().position(|it| *it == word.text) else {
                return Err(word.unknown("event", net.events.iter().map(String::as_str)));
            };
            if offered.contains(&at) {
                return Err(word.wrong(format!("a leaf offers {}", word.text)));
            }
            happens[at] = false;
        }
        let moves: Vec<_> = (0..net.events.len()).filter(|it| happens[*it]).collect();
        if moves.len() <= MOST_MOVES {
            return Ok(moves);
        }
        let (name, count) = (&net.name, moves.len());
        let first = Word { text: String::new(), line: 1, column: 1 };
        let most = format!("{MOST_MOVES} are the most");
        let wrong = first.wrong(format!("{name} has {count} events that no leaf offers: {most}"));
        Err(Wrong { help: Some("say which `never` happen".to_owned()), ..wrong })
    }
}

/// Returns the nodes of a line.
fn named(it: &Line, tree: &Tree) -> Result<Vec<usize>, Wrong> {
    let name = it.leaf.text.as_str();
    let is = |node: &Node| node.label == name || node.name == name || node.tag == name;
    let found: Vec<_> = (0..tree.nodes.len()).filter(|at| is(&tree.nodes[*at])).collect();
    if found.is_empty() {
        let leaves = tree.nodes.iter().filter(|it| !it.is_built_in());
        let names: Vec<_> = leaves.flat_map(|it| [it.label.as_str(), &it.tag]).collect();
        return Err(it.leaf.unknown("leaf", names));
    }
    Ok(found)
}

/// Refuses a leaf that answers otherwise.
fn fits(it: &Line, kind: &Kind) -> Result<(), Wrong> {
    let name = &it.leaf.text;
    let Kind::Leaf(kind) = kind else {
        return Err(it.leaf.wrong(format!("{name} is no leaf: the library answers for it")));
    };
    let runs = it.succeeds.is_some() || it.fails.is_some();
    let why = match kind {
        LeafKind::Condition if it.reads.is_none() => "is a condition: say what it `reads`",
        LeafKind::Sync if runs => "is `sync`, and ends at once: it cannot wait for anything",
        LeafKind::Stateful | LeafKind::Service if it.reads.is_some() => {
            "is an action: say what it `starts`, and when it `succeeds`"
        }
        LeafKind::Latch | LeafKind::FirstSuccess | LeafKind::FirstFailure => {
            "begins by a rule of its own"
        }
        _ => return Ok(()),
    };
    Err(it.leaf.wrong(format!("{name} {why}")))
}

fn bond(it: &Line, net: &Supervisor) -> Result<Bond, Wrong> {
    if let Some(sights) = &it.reads {
        for (looks, word) in sights {
            if matches!(looks, Looks::After | Looks::Upon) {
                return Err(word.wrong("a condition has no start: it reads places".to_owned()));
            }
        }
        return Ok(Bond::Reads(seen(sights, net)?));
    }
    let optional = |it: &Option<Sights>| it.as_ref().map(|it| seen(it, net)).transpose();
    Ok(Bond::Acts(Acts {
        starts: it.starts.as_ref().map(|it| event(it, net)).transpose()?,
        tries: it.tries,
        succeeds: optional(&it.succeeds)?,
        fails: optional(&it.fails)?,
        halts: it.halts.as_ref().map(|it| event(it, net)).transpose()?,
    }))
}

fn event(word: &Word, net: &Supervisor) -> Result<usize, Wrong> {
    let told = net.events.iter().take(net.told);
    let Some(at) = told.clone().position(|it| *it == word.text) else {
        let wrong = word.unknown("event", told.map(String::as_str));
        let help = "only events that no net of a system causes can be offered by a leaf";
        return Err(Wrong { help: Some(help.to_owned()), ..wrong });
    };
    if net.timed[at] {
        let why =
            "is taken in an interval only, and intervals are left out: a leaf cannot offer it";
        return Err(word.wrong(format!("{} {why}", word.text)));
    }
    Ok(at)
}

fn seen(sights: &Sights, net: &Supervisor) -> Result<When, Wrong> {
    let name = |all: &[String], word: &Word, what| {
        let at = all.iter().position(|it| *it == word.text);
        at.ok_or_else(|| word.unknown(what, all.iter().map(String::as_str)))
    };
    let one = |(looks, word): &(Looks, Word)| {
        Ok(match looks {
            Looks::At => Sight::At(name(&net.places, word, "place")?),
            Looks::NotAt => Sight::NotAt(name(&net.places, word, "place")?),
            Looks::After => match net.lines.get(&word.text) {
                Some(all) => Sight::After(all.clone()),
                None => Sight::After(vec![name(&net.transitions, word, "transition")? as u16]),
            },
            Looks::Upon => match net.outputs.get(&word.text) {
                Some(all) => Sight::After(all.clone()),
                None => return Err(word.unknown("output", net.outputs.keys().map(String::as_str))),
            },
        })
    };
    sights.iter().map(one).collect()
}

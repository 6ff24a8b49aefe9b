//! Keys of a table, each asked for once, and the faults of a file, all of them.

use crate::mission::Attributes;
use crate::tree::{Entry, Fault, Node, Value};
use std::cell::RefCell;

/// Numbers of files lie within this one and its negative.
pub(crate) const LARGEST: i64 = 1_000_000_000_000_000;
/// The longest name, in characters.
const MAX_NAME: usize = 64;
/// A table has at most so many attributes.
const MAX_ATTRIBUTES: usize = 64;
/// So many names are looked at for the one that was meant.
const MAX_NEAR: usize = 256;
/// The most faults of a file that are told; further ones are counted.
const MAX_FAULTS: usize = 64;

/// Faults of a file, found while it is read to its end.
#[derive(Debug, Default)]
pub(crate) struct Faults(RefCell<(Vec<Fault>, usize)>);

impl Faults {
    pub(crate) fn add(&self, fault: Fault) {
        let (all, omitted) = &mut *self.0.borrow_mut();
        if all.len() < MAX_FAULTS { all.push(fault) } else { *omitted += 1 }
    }

    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.borrow().0.is_empty()
    }

    /// Whether further ones are counted only.
    fn are_many(&self) -> bool {
        self.0.borrow().0.len() >= MAX_FAULTS
    }

    /// Adds a fault without a remedy.
    pub(crate) fn say(&self, at: usize, message: impl Into<String>) {
        self.add(Fault::new(at, message));
    }

    /// Returns them in the order of the file, and the number of those that are left out.
    pub(crate) fn into_sorted(self) -> (Vec<Fault>, usize) {
        let (mut all, omitted) = self.0.into_inner();
        all.sort_by_key(|it| it.at);
        (all, omitted)
    }
}

/// The entries of a table, less those that were asked for.
#[derive(Debug)]
pub(crate) struct Fields<'n, 'f> {
    at: usize,
    /// A few words for the table.
    what: String,
    left: Vec<&'n Entry>,
    asked: Vec<&'static str>,
    /// Whether it is a table: of what is none no key is missing.
    is_table: bool,
    faults: &'f Faults,
}

impl<'n, 'f> Fields<'n, 'f> {
    /// Begins to read a table, `what` in words.
    pub(crate) fn of(node: &'n Node, what: &str, faults: &'f Faults) -> Self {
        let mut fields = Self {
            at: node.at,
            what: what.to_owned(),
            left: Vec::new(),
            asked: Vec::new(),
            is_table: false,
            faults,
        };
        match &node.value {
            Value::Table(entries) => {
                (fields.left, fields.is_table) = (entries.iter().collect(), true);
            }
            _ => faults.add(wrong_type(node, what, "a table")),
        }
        fields
    }

    /// Calls the table by its name, as soon as that is known.
    pub(crate) fn call(&mut self, what: String) {
        self.what = what;
    }

    /// The place of the table.
    pub(crate) const fn place(&self) -> usize {
        self.at
    }

    pub(crate) fn optional(&mut self, key: &'static str) -> Option<&'n Node> {
        self.asked.push(key);
        let place = self.left.iter().position(|it| it.key == key)?;
        Some(&self.left.remove(place).node)
    }

    /// Whether a key that may be missing is there, to be read after this.
    pub(crate) fn optional_is_there(&mut self, key: &'static str) -> bool {
        self.asked.push(key);
        self.left.iter().any(|it| it.key == key)
    }

    pub(crate) fn required(&mut self, key: &'static str) -> Option<&'n Node> {
        let found = self.optional(key);
        if found.is_none() && self.is_table {
            let mut fault = Fault::new(self.at, format!("`{key}` is missing in {}", self.what));
            if let Some(near) = near(key, self.left.iter().map(|it| it.key.as_str())) {
                fault = fault.help(format!("is `{near}` meant for it?"));
            }
            self.faults.add(fault);
        }
        found
    }

    pub(crate) fn integer(&mut self, key: &'static str, least: i64, most: i64) -> Option<i64> {
        integer(self.required(key)?, key, least, most, self.faults)
    }

    pub(crate) fn text(&mut self, key: &'static str) -> Option<(usize, &'n str)> {
        text(self.required(key)?, key, self.faults)
    }

    /// Reads one of a few words, by index.
    pub(crate) fn word(
        &mut self,
        key: &'static str,
        what: &str,
        words: &[&str],
    ) -> Option<(usize, usize)> {
        let (at, word) = self.text(key)?;
        Some((at, index_of(at, what, word, words.iter().copied(), self.faults)?))
    }

    /// Reads a name: no longer than a line of a table bears, without white space; empty where it
    /// is none.
    pub(crate) fn name(&mut self, key: &'static str) -> (usize, String) {
        let Some((at, name)) = self.text(key) else { return (self.at, String::new()) };
        (at, if named(at, name, self.faults) { name.to_owned() } else { String::new() })
    }

    /// Reads a name that none of the same list has.
    pub(crate) fn own_name<'k>(
        &mut self,
        what: &str,
        before: impl Iterator<Item = &'k str>,
    ) -> String {
        let (at, name) = self.name("id");
        if !name.is_empty() {
            self.call(format!("the {what} `{name}`"));
        }
        distinct(at, what, &name, before, self.faults);
        name
    }

    /// Reads a list of at most so many items; an empty one where the key is missing.
    pub(crate) fn list(&mut self, key: &'static str, most: usize) -> &'n [Node] {
        let Some(node) = self.optional(key) else { return &[] };
        let Value::List(items) = &node.value else {
            self.faults.add(wrong_type(node, key, "a list"));
            return &[];
        };
        if items.len() > most {
            let message = format!("`{key}` has {} items, at most {most} are read", items.len());
            self.faults.say(node.at, message);
        }
        items.get(..most).unwrap_or(items)
    }

    /// Reads entries of a table with names of the file's own, at most so many.
    pub(crate) fn named(&mut self, key: &'static str, most: usize) -> &'n [Entry] {
        let Some(node) = self.optional(key) else { return &[] };
        let Value::Table(entries) = &node.value else {
            self.faults.add(wrong_type(node, key, "a table"));
            return &[];
        };
        if entries.len() > most {
            let message = format!("`{key}` has {} keys, at most {most} are read", entries.len());
            self.faults.say(node.at, message);
        }
        let entries = entries.get(..most).unwrap_or(entries);
        for it in entries {
            named(it.key_at, &it.key, self.faults);
        }
        entries
    }

    /// Keys that are left, with their places.
    pub(crate) fn left(&self) -> Vec<(&'n str, usize)> {
        self.left.iter().map(|it| (it.key.as_str(), it.key_at)).collect()
    }

    /// Takes whatever is left as attributes.
    pub(crate) fn attributes(self) -> Attributes {
        let mut attributes = Vec::new();
        if self.left.len() > MAX_ATTRIBUTES {
            let (what, all) = (&self.what, self.left.len());
            let message =
                format!("{what} has {all} further keys, at most {MAX_ATTRIBUTES} are read");
            self.faults.say(self.at, message);
            // An empty name stands for those that are not read.
            attributes.push((String::new(), 0));
        }
        for entry in self.left.into_iter().take(MAX_ATTRIBUTES) {
            let value = integer(&entry.node, &entry.key, -LARGEST, LARGEST, self.faults);
            attributes.push((entry.key.clone(), value.unwrap_or(0)));
        }
        Attributes(attributes)
    }

    /// Refuses whatever is left.
    pub(crate) fn finish(self) {
        for it in self.left {
            let message = format!("unknown key `{}` in {}", short(&it.key), self.what);
            let mut fault = Fault::new(it.key_at, message);
            if !self.faults.are_many()
                && let Some(near) = near(&it.key, self.asked.iter().copied())
            {
                fault = fault.help(format!("did you mean `{near}`?"));
            }
            self.faults.add(fault);
        }
    }
}

pub(crate) fn integer(
    node: &Node,
    key: &str,
    least: i64,
    most: i64,
    faults: &Faults,
) -> Option<i64> {
    match node.value {
        Value::Integer(it) if (least..=most).contains(&it) => return Some(it),
        Value::Integer(it) => {
            faults.say(node.at, format!("`{}` must be {least} to {most}, not {it}", short(key)));
        }
        _ => faults.add(wrong_type(node, key, "an integer")),
    }
    None
}

pub(crate) fn text<'n>(node: &'n Node, key: &str, faults: &Faults) -> Option<(usize, &'n str)> {
    let Value::Text(it) = &node.value else {
        faults.add(wrong_type(node, key, "a text"));
        return None;
    };
    Some((node.at, it))
}

/// Whether this is a name; says why not.
fn named(at: usize, name: &str, faults: &Faults) -> bool {
    let fits = !name.is_empty() && name.chars().count() <= MAX_NAME;
    if fits && !name.contains(|it: char| it.is_whitespace() || it.is_control()) {
        return true;
    }
    let rule = format!("a name has 1 to {MAX_NAME} characters and no white space");
    faults.add(Fault::new(at, format!("`{}` is no name", short(name))).help(rule));
    false
}

pub(crate) fn wrong_type(node: &Node, key: &str, expected: &str) -> Fault {
    let is = node.value.words();
    // Words in marks already are names.
    let mark = if key.contains(['`', ' ']) { "" } else { "`" };
    Fault::new(node.at, format!("{mark}{}{mark} must be {expected}, not {is}", short(key)))
}

/// A text of a file as messages say it.
pub(crate) fn short(text: &str) -> String {
    let start: String = text.chars().take(MAX_NAME).collect();
    let more = if start.len() < text.len() { "..." } else { "" };
    format!("{}{more}", start.escape_debug())
}

/// Finds a name among known ones. An empty one stands for a name that could not be read: this one
/// may be meant, and nothing is said.
pub(crate) fn index_of<'k>(
    at: usize,
    what: &str,
    name: &str,
    known: impl Iterator<Item = &'k str> + Clone,
    faults: &Faults,
) -> Option<usize> {
    let found = known.clone().position(|it| it == name);
    if found.is_none() && !name.is_empty() && !known.clone().any(str::is_empty) {
        let help = near(name, known.clone()).map(|it| format!("did you mean `{it}`?"));
        let help = help.unwrap_or_else(|| there_are(known));
        let message = format!("unknown {what} `{}`", short(name));
        faults.add(Fault::new(at, message).help(help));
    }
    found.filter(|_| !name.is_empty())
}

/// Names some of those that are known.
pub(crate) fn there_are<'k>(known: impl Iterator<Item = &'k str>) -> String {
    let all: Vec<_> = known.take(20).collect();
    if all.is_empty() { "none is defined".into() } else { format!("there are: {}", all.join(", ")) }
}

/// Returns the name that was probably meant: with at most one wrong letter of three.
pub(crate) fn near<'k>(word: &str, names: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    // The distance takes time that grows with both lengths.
    let names = names.filter(|it| it.len() <= MAX_NAME && word.len() <= MAX_NAME);
    let names = names.take(MAX_NEAR).map(|it| (strsim::damerau_levenshtein(word, it), it));
    names.filter(|it| it.0 <= (it.1.chars().count() / 3).max(1)).min().map(|it| it.1)
}

/// Whether a name does not stand before it in the same list; says if it does.
pub(crate) fn distinct<'k>(
    at: usize,
    what: &str,
    name: &str,
    mut before: impl Iterator<Item = &'k str>,
    faults: &Faults,
) -> bool {
    let is_second = !name.is_empty() && before.any(|it| it == name);
    if is_second {
        faults.say(at, format!("a second {what} is called `{}`", short(name)));
    }
    !is_second
}

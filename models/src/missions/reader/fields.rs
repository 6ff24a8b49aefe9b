//! A typed reader over a TOML tree that goes on after an error, so that all errors of a file come
//! at once.
//!
//! A method returns `None` when what it was asked for is absent or wrong, and has then reported it;
//! the caller reads everything first and only then gives up.

mod json;
mod more;
mod points;
mod units;

use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::{DOCUMENTATION, ID_LENGTHS, MAX_ENTRIES};
use crate::names::{MAX_ID, nearest, quoted, unknown};
use std::cell::{Cell, RefCell};
use std::ops::{Range, RangeInclusive};
use toml::de::{DeTable, DeValue};

pub(crate) use json::document_of_either;
pub(crate) use more::TextOrTable;
use units::{in_its_unit, is_without_unit, unit, values};

type Node<'t> = toml::Spanned<DeValue<'t>>;

/// The largest file that is read, in bytes.
const MAX_BYTES: usize = 16 << 20;

/// With more syntax errors the text is hardly meant to be TOML.
const MANY_SYNTAX_ERRORS: usize = 4;

/// Marks an error that was already reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reported;

/// Collects the errors.
#[derive(Debug, Default)]
pub struct Sink {
    errors: RefCell<Vec<Diagnostic>>,
    /// Whether the file is JSON, and speaks of objects and lists.
    is_json: Cell<bool>,
}

impl Sink {
    /// Adds an error.
    pub fn report(&self, diagnostic: Diagnostic) {
        self.errors.borrow_mut().push(diagnostic);
    }

    /// Whether there is no error yet.
    pub fn is_empty(&self) -> bool {
        self.errors.borrow().is_empty()
    }

    pub(crate) fn into_diagnostics(self) -> Vec<Diagnostic> {
        self.errors.into_inner()
    }
}

/// Reads a document; `read` gets its root unless the text is not TOML.
pub fn document<T>(
    text: &str,
    sink: &Sink,
    format: &'static str,
    read: impl FnOnce(Fields<'_>) -> Option<T>,
) -> Option<T> {
    if text.len() > MAX_BYTES {
        let message = format!("the file has more than {MAX_BYTES} bytes");
        sink.report(
            Diagnostic::new(0..0, message, "").help("split it, or leave out what is not needed"),
        );
        return None;
    }
    let (root, errors) = DeTable::parse_recoverable(text);
    // A file of another kind has one in nearly each line: the first says as much as all.
    let shown = if errors.len() > MANY_SYNTAX_ERRORS { 1 } else { errors.len() };
    for error in errors.iter().take(shown) {
        let message = format!("not TOML: {}", error.message());
        let it = Diagnostic::new(error.span().unwrap_or(0..0), message, "TOML syntax");
        let others = errors.len() - shown;
        let help =
            format!("{others} more places are not TOML either: is it the file that was meant?");
        sink.report(if others > 0 { it.help(help) } else { it });
    }
    if !errors.is_empty() {
        return None;
    }
    read_root(root.get_ref(), sink, format, read)
}

/// Reads what has the wanted format.
fn read_root<T>(
    root: &DeTable<'_>,
    sink: &Sink,
    format: &'static str,
    read: impl FnOnce(Fields<'_>) -> Option<T>,
) -> Option<T> {
    let mut fields = Fields::new(sink, root, 0..0, "the file");
    fields.format = format;
    let found = fields.text("format");
    if let Some(found) = found.filter(|found| found.value != format) {
        let message = format!("unknown format {}", quoted(&found.value));
        let entry = sink.entry("format", &format!("\"{format}\""));
        let help = format!("this program reads `{entry}` here");
        sink.report(Diagnostic::new(found.span, message, "not known").help(help));
        return None;
    }
    read(fields)
}

/// The entries of one table, with a note of which keys were asked for.
#[derive(Debug)]
pub struct Fields<'t> {
    sink: &'t Sink,
    entries: &'t DeTable<'t>,
    span: Range<usize>,
    what: String,
    /// The most entries of a list.
    most_entries: usize,
    /// The value that `format` must have; empty in tables below the root.
    format: &'static str,
    asked: Vec<&'t str>,
    missing: Vec<&'static str>,
}

impl<'t> Fields<'t> {
    fn new(sink: &'t Sink, entries: &'t DeTable<'t>, span: Range<usize>, what: &str) -> Self {
        let (asked, missing) = (Vec::new(), Vec::new());
        let (what, most_entries) = (what.into(), MAX_ENTRIES);
        Self { sink, entries, span, what, most_entries, format: "", asked, missing }
    }

    /// Adds an error.
    pub fn report(&self, diagnostic: Diagnostic) {
        self.sink.report(diagnostic);
    }

    /// Returns the position of a key's value, or else of the table.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.entries.get(key).map_or_else(|| self.span.clone(), toml::Spanned::span)
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    fn optional(&mut self, key: &'static str) -> Option<&'t Node<'t>> {
        self.asked.push(key);
        self.entries.get(key)
    }

    fn required(&mut self, key: &'static str) -> Option<&'t Node<'t>> {
        let node = self.optional(key);
        if node.is_none() {
            self.missing.push(key);
        }
        node
    }

    fn wrong_type(&self, key: &str, node: &Node<'_>, expected: &str) {
        let found = match node.get_ref() {
            DeValue::Float(float) => format!("the float {}", quoted(float.as_str())),
            DeValue::Integer(_) => "an integer".into(),
            DeValue::Array(_) => self.sink.named("an array").into(),
            other => self.sink.named(&format!("a {}", other.type_str())).into(),
        };
        let expected = self.sink.named(expected);
        let message = format!("`{key}` must be {expected}, not {found}");
        let help = match node.get_ref() {
            DeValue::Float(_) => "all quantities are whole numbers of mm, mm/s, ms, mW, mJ and g",
            DeValue::String(_) if expected == "an integer" => {
                "write a whole number, without quotes and without a unit"
            }
            _ => "change the value",
        };
        self.report(
            Diagnostic::new(node.span(), message, format!("expected {expected}")).help(help),
        );
    }

    fn integer_of<T: TryFrom<i64>>(
        &self,
        key: &str,
        node: &Node<'_>,
        range: &RangeInclusive<i64>,
    ) -> Option<T> {
        let DeValue::Integer(integer) = node.get_ref() else {
            self.wrong_type(key, node, "an integer");
            return None;
        };
        let value = i64::from_str_radix(integer.as_str(), integer.radix()).ok();
        let value =
            value.filter(|value| range.contains(value)).and_then(|value| T::try_from(value).ok());
        if value.is_none() {
            let expected = format!("{} to {}", range.start(), range.end());
            let message =
                format!("`{key}` must be {expected}, not {}", quoted(&integer.to_string()));
            self.report(
                Diagnostic::new(node.span(), message, "out of range").help("change the value"),
            );
        }
        value
    }

    /// A required integer within a range.
    pub fn integer<T: TryFrom<i64>>(
        &mut self,
        key: &'static str,
        range: RangeInclusive<i64>,
    ) -> Option<T> {
        let node = self.required(key)?;
        self.integer_of(key, node, &range)
    }

    /// An integer that may be left out.
    ///
    /// # Errors
    /// When it is wrong; that is reported.
    pub fn optional_integer<T: TryFrom<i64>>(
        &mut self,
        key: &'static str,
        range: RangeInclusive<i64>,
    ) -> Result<Option<T>, Reported> {
        match self.optional(key) {
            None => Ok(None),
            Some(node) => self.integer_of(key, node, &range).map(Some).ok_or(Reported),
        }
    }

    fn text_of(&self, key: &str, node: &Node<'_>) -> Option<Spanned<String>> {
        if let Some(text) = node.get_ref().as_str() {
            return Some(Spanned { value: text.into(), span: node.span() });
        }
        self.wrong_type(key, node, "a string");
        None
    }

    /// A required text.
    pub fn text(&mut self, key: &'static str) -> Option<Spanned<String>> {
        let node = self.required(key)?;
        self.text_of(key, node)
    }

    /// A text that may be left out.
    ///
    /// # Errors
    /// When it is wrong; that is reported.
    pub fn optional_text(
        &mut self,
        key: &'static str,
    ) -> Result<Option<Spanned<String>>, Reported> {
        match self.optional(key) {
            None => Ok(None),
            Some(node) => self.text_of(key, node).map(Some).ok_or(Reported),
        }
    }

    /// Whether a text is an id; reports it if not.
    fn is_id(&self, id: &str, span: Range<usize>) -> bool {
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        let good = ID_LENGTHS.contains(&id.len()) && id.chars().all(plain);
        if !good {
            let message = format!("{} is not an id", quoted(id));
            let help = format!("use 1 to {MAX_ID} ASCII letters, digits, `-`, `_` and `.`");
            self.report(Diagnostic::new(span, message, "not an id").help(help));
        }
        good
    }

    /// A required id.
    pub fn id(&mut self, key: &'static str) -> Option<Spanned<String>> {
        self.text(key).filter(|id| self.is_id(&id.value, id.span.clone()))
    }

    /// A required text out of a fixed set.
    pub fn choice(
        &mut self,
        key: &'static str,
        what: &str,
        known: &[&'static str],
    ) -> Option<&'static str> {
        let found = self.text(key)?;
        let index = self.index_of(&found, what, known.iter().copied())?;
        known.get(index).copied()
    }

    /// The position of a name among known ones; reports it when it is not there, unless one of them
    /// could not be read, and may be the one that is meant.
    pub(crate) fn index_of<'n>(
        &self,
        name: &Spanned<String>,
        what: &str,
        mut known: impl Iterator<Item = &'n str> + Clone,
    ) -> Option<usize> {
        let names = known.clone();
        let index = known.position(|known| !known.is_empty() && known == name.value);
        if index.is_none() && names.clone().all(|known| !known.is_empty()) {
            let (message, help) = unknown(what, &name.value, names);
            self.report(Diagnostic::new(name.span.clone(), message, "not known").help(help));
        }
        index
    }

    fn table_of(&self, key: &str, node: &'t Node<'t>, what: &str) -> Option<Fields<'t>> {
        if let Some(entries) = node.get_ref().as_table() {
            return Some(Fields::new(self.sink, entries, node.span(), what));
        }
        self.wrong_type(key, node, "a table");
        None
    }

    /// A required table.
    pub(crate) fn table(&mut self, key: &'static str) -> Option<Fields<'t>> {
        let node = self.required(key)?;
        self.table_of(key, node, &format!("`{key}`"))
    }

    /// A table that may be left out.
    pub(crate) fn optional_table(
        &mut self,
        key: &'static str,
    ) -> Result<Option<Fields<'t>>, Reported> {
        match self.optional(key) {
            None => Ok(None),
            Some(node) => self.table_of(key, node, &format!("`{key}`")).map(Some).ok_or(Reported),
        }
    }

    fn items(&self, key: &str, node: &'t Node<'t>) -> Option<Vec<&'t Node<'t>>> {
        let Some(array) = node.get_ref().as_array() else {
            self.wrong_type(key, node, "an array");
            return None;
        };
        let most = self.most_entries;
        if array.len() > most {
            let message =
                format!("`{key}` has {} entries; at most {most} are allowed", array.len());
            self.report(Diagnostic::new(node.span(), message, "too many").help("leave some out"));
            return None;
        }
        Some(array.iter().collect())
    }

    /// A list of tables; when required it must be there and have an entry.
    pub(crate) fn tables(&mut self, key: &'static str, required: bool) -> Option<Vec<Fields<'t>>> {
        let node = if required { self.required(key) } else { self.optional(key) };
        let Some(node) = node else { return (!required).then(Vec::new) };
        let items = self.items(key, node)?;
        if required && items.is_empty() {
            self.report_empty(key, node);
            return None;
        }
        // Every entry is looked at before giving up.
        let tables: Vec<_> =
            items.iter().map(|item| self.table_of(key, item, &format!("this `{key}`"))).collect();
        tables.into_iter().collect()
    }

    fn report_empty(&self, key: &str, node: &Node<'_>) {
        let message = format!("`{key}` is empty");
        self.report(Diagnostic::new(node.span(), message, "empty").help("give at least one entry"));
    }

    /// A required list of texts with at least one entry.
    pub(crate) fn texts(&mut self, key: &'static str) -> Option<Vec<Spanned<String>>> {
        let node = self.required(key)?;
        let items = self.items(key, node)?;
        if items.is_empty() {
            self.report_empty(key, node);
            return None;
        }
        let texts: Vec<_> = items.iter().map(|item| self.text_of(key, item)).collect();
        texts.into_iter().collect()
    }

    fn by_place(&self) -> Vec<(Spanned<String>, &'t Node<'t>)> {
        let named = |(key, node): (&toml::Spanned<toml::de::DeString<'t>>, &'t Node<'t>)| {
            (Spanned { value: key.get_ref().to_string(), span: key.span() }, node)
        };
        let mut entries: Vec<_> = self.entries.iter().map(named).collect();
        entries.sort_by_key(|(key, _)| key.span.start);
        entries
    }

    /// The entries of a table whose keys are names, as integers, in the order of the file.
    pub(crate) fn named_integers<T: TryFrom<i64>>(
        self,
        range: &RangeInclusive<i64>,
    ) -> Option<Vec<(Spanned<String>, T)>> {
        let entries = self.by_place();
        if entries.len() > MAX_ENTRIES {
            self.report_too_many(entries.len());
            return None;
        }
        let read = |(key, node): (Spanned<String>, &Node<'_>)| {
            let value = self.integer_of(&key.value.escape_debug().to_string(), node, range)?;
            Some((key, value))
        };
        let values: Vec<_> = entries.into_iter().map(read).collect();
        values.into_iter().collect()
    }

    /// The entries of a table whose keys are ids, as tables, in the order of the file; an unusable
    /// id is empty.
    pub(crate) fn named_tables(self) -> Option<Vec<(Spanned<String>, Option<Fields<'t>>)>> {
        let entries = self.by_place();
        if entries.len() > MAX_ENTRIES {
            self.report_too_many(entries.len());
            return None;
        }
        let read = |(mut key, node): (Spanned<String>, &'t Node<'t>)| {
            let good = self.is_id(&key.value, key.span.clone());
            let table =
                self.table_of(&key.value.escape_debug().to_string(), node, &quoted(&key.value));
            if !good {
                key.value.clear();
            }
            (key, table.filter(|_| good))
        };
        Some(entries.into_iter().map(read).collect())
    }

    fn report_too_many(&self, count: usize) {
        let message =
            format!("{} has {count} entries; at most {MAX_ENTRIES} are allowed", self.what);
        self.report(Diagnostic::new(self.span.clone(), message, "too many").help("leave some out"));
    }

    fn report_missing(&self, missing: &[&'static str]) {
        for key in missing {
            let message = format!("missing key `{key}` in {}", self.what);
            let label = format!("`{key}` is not here");
            let help = match *key {
                "format" if self.sink.is_json.get() => {
                    format!("add `\"format\": \"{}\"`", self.format)
                }
                "format" => format!("add the line `format = \"{}\"`", self.format),
                _ => format!("add `{key}`{}", values(key)),
            };
            self.report(Diagnostic::new(self.span.clone(), message, label).help(help));
        }
    }

    /// Reports missing keys and leaves the others: which keys are known is not known.
    pub(crate) fn abandon(self) {
        self.report_missing(&self.missing);
    }

    /// Reports keys that are missing and keys that nobody asked for.
    pub fn finish(self) {
        let mut missing = self.missing.clone();
        for (key, node) in self.by_place() {
            let name = key.value.as_str();
            if self.asked.contains(&name) {
                continue;
            }
            if DOCUMENTATION.contains(&name) {
                let _ = self.text_of(name, node);
                continue;
            }
            let absent = || self.asked.iter().copied().filter(|asked| !self.has(asked));
            let in_unit =
                |known| Some((known, in_its_unit(name, known, node.get_ref(), self.sink)?));
            let in_unit = absent().find_map(in_unit);
            let near = in_unit.as_ref().map(|it| it.0).or_else(|| nearest(name, absent()));
            let near = near.or_else(|| absent().find(|known| is_without_unit(name, known)));
            // A misspelt key is one error, not two.
            missing.retain(|key| Some(*key) != near);
            let message = format!("unknown key {} in {}", quoted(name), self.what);
            let (message, help) = match near {
                Some(near) => {
                    let plain = || format!("write `{near}`{}", unit(near));
                    let help = in_unit.map_or_else(plain, |it| it.1);
                    (format!("{message}; did you mean `{near}`?"), help)
                }
                None => (message, format!("known keys here: {}", self.asked.join(", "))),
            };
            self.report(Diagnostic::new(key.span, message, "not known here").help(help));
        }
        self.report_missing(&missing);
    }
}

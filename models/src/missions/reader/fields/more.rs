//! Numbers with decimals, truth values, longer lists, and lists that may be left out.

use super::{Fields, Reported, Sink};
use crate::missions::diagnostic::Spanned;
use crate::missions::numbers::Numbers;
use crate::names::nearest;
use std::ops::RangeInclusive;
use toml::de::DeValue;

/// An entry of a list that has texts and tables.
pub(crate) enum TextOrTable<'t> {
    Text(Spanned<String>),
    Table(Fields<'t>),
}

impl<'t> Fields<'t> {
    /// Returns the collector of errors.
    pub fn sink(&self) -> &'t Sink {
        self.sink
    }

    /// Whether a key has one of these texts as its value.
    pub(crate) fn says(&self, key: &str, texts: &[&str]) -> bool {
        let text = self.entries.get(key).and_then(|it| it.get_ref().as_str());
        text.is_some_and(|it| texts.contains(&it))
    }

    /// Notes that a key may stand here, whatever its value.
    pub(crate) fn knows(&mut self, key: &'static str) {
        let _ = self.optional(key);
    }

    /// Whether a key stands here that nothing has asked for: the misspelt name of one that has.
    pub(crate) fn has_unknown(&self) -> bool {
        let mut keys = self.entries.keys().map(|it| it.get_ref().as_ref());
        keys.any(|it| !self.asked.contains(&it) && !super::DOCUMENTATION.contains(&it))
    }

    /// Takes the integers that nothing has asked for, in the order of the file: attributes of the
    /// file's own. One whose name is nearly that of a key which is not here stays unknown.
    pub(crate) fn numbers(&mut self, range: &RangeInclusive<i64>) -> Numbers {
        let mut numbers = Vec::new();
        let mut all: Vec<_> = self.entries.iter().collect();
        all.sort_by_key(|(key, _)| key.span().start);
        for (key, node) in all {
            let name = key.get_ref().as_ref();
            let absent = self.asked.iter().copied().filter(|asked| !self.has(asked));
            let is_own = matches!(node.get_ref(), DeValue::Integer(_) | DeValue::Float(_))
                && !self.asked.contains(&name)
                && nearest(name, absent).is_none();
            if !is_own {
                continue;
            }
            self.asked.push(name);
            if let Some(value) = self.integer_of(name, node, range) {
                numbers.push((Spanned { value: name.to_owned(), span: key.span() }, value));
            }
        }
        Numbers(numbers)
    }

    /// The digits of a number, with or without decimals, that may be left out.
    pub(crate) fn optional_number(
        &mut self,
        key: &'static str,
    ) -> Result<Option<Spanned<String>>, Reported> {
        let Some(node) = self.optional(key) else { return Ok(None) };
        let value = match node.get_ref() {
            DeValue::Float(float) => float.as_str().to_owned(),
            DeValue::Integer(integer) => integer.to_string(),
            _ => {
                self.wrong_type(key, node, "a number");
                return Err(Reported);
            }
        };
        Ok(Some(Spanned { value, span: node.span() }))
    }

    /// A truth value that may be left out.
    ///
    /// # Errors
    /// When it is wrong; that is reported.
    pub fn optional_flag(&mut self, key: &'static str) -> Result<Option<bool>, Reported> {
        let Some(node) = self.optional(key) else { return Ok(None) };
        if node.get_ref().as_bool().is_none() {
            self.wrong_type(key, node, "`true` or `false`");
        }
        node.get_ref().as_bool().map(Some).ok_or(Reported)
    }

    /// A list of texts that may be left out or empty.
    pub(crate) fn optional_texts(
        &mut self,
        key: &'static str,
    ) -> Result<Vec<Spanned<String>>, Reported> {
        let Some(node) = self.optional(key) else { return Ok(Vec::new()) };
        let items = self.items(key, node).ok_or(Reported)?;
        let texts: Vec<_> = items.iter().map(|item| self.text_of(key, item)).collect();
        texts.into_iter().collect::<Option<_>>().ok_or(Reported)
    }

    /// A list of texts and of tables, which may be left out or empty.
    pub(crate) fn optional_texts_and_tables(
        &mut self,
        key: &'static str,
    ) -> Result<Vec<TextOrTable<'t>>, Reported> {
        let Some(node) = self.optional(key) else { return Ok(Vec::new()) };
        let items = self.items(key, node).ok_or(Reported)?;
        let read = |item: &'t super::Node<'t>| {
            if item.get_ref().as_table().is_some() {
                self.table_of(key, item, &format!("this entry of `{key}`")).map(TextOrTable::Table)
            } else {
                self.text_of(key, item).map(TextOrTable::Text)
            }
        };
        let entries: Vec<_> = items.into_iter().map(read).collect();
        entries.into_iter().collect::<Option<_>>().ok_or(Reported)
    }

    /// A required list of lists of texts; at most `most` of them.
    pub(crate) fn lists_of_texts(
        &mut self,
        key: &'static str,
        most: usize,
    ) -> Option<Vec<Vec<Spanned<String>>>> {
        let node = self.required(key)?;
        let usual = std::mem::replace(&mut self.most_entries, most);
        let lists = self.items(key, node);
        self.most_entries = usual;
        let read = |list: &'t super::Node<'t>| {
            let texts: Vec<_> =
                self.items(key, list)?.iter().map(|item| self.text_of(key, item)).collect();
            texts.into_iter().collect::<Option<Vec<_>>>()
        };
        let lists: Vec<_> = lists?.into_iter().map(read).collect();
        lists.into_iter().collect()
    }

    /// Whether the value of a key is a table.
    pub(crate) fn is_table(&self, key: &str) -> bool {
        self.entries.get(key).is_some_and(|it| it.get_ref().as_table().is_some())
    }

    /// Returns the position of this table.
    pub fn whole(&self) -> std::ops::Range<usize> {
        self.span.clone()
    }

    /// `tables`, with a limit of its own.
    pub fn tables_up_to(
        &mut self,
        key: &'static str,
        required: bool,
        most: usize,
    ) -> Option<Vec<Self>> {
        let usual = std::mem::replace(&mut self.most_entries, most);
        let tables = self.tables(key, required);
        self.most_entries = usual;
        tables
    }

    /// A required list of integers within a range, with at least one and at most `most` of them.
    pub fn integers_up_to<T: TryFrom<i64>>(
        &mut self,
        key: &'static str,
        range: RangeInclusive<i64>,
        most: usize,
    ) -> Option<Vec<T>> {
        let all: Vec<T> = self.integers_or_none(key, range, most)?;
        if all.is_empty() {
            let node = self.required(key)?;
            self.report_empty(key, node);
            return None;
        }
        Some(all)
    }

    /// The same, of which there may be none.
    pub(crate) fn integers_or_none<T: TryFrom<i64>>(
        &mut self,
        key: &'static str,
        range: RangeInclusive<i64>,
        most: usize,
    ) -> Option<Vec<T>> {
        let node = self.required(key)?;
        let usual = std::mem::replace(&mut self.most_entries, most);
        let items = self.items(key, node);
        self.most_entries = usual;
        let all: Vec<_> = items?.iter().map(|item| self.integer_of(key, item, &range)).collect();
        all.into_iter().collect()
    }
}

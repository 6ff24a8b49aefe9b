//! Tables in CSV (RFC 4180) with a header: cells of text, and data made of them.

use crate::data::{Data, MAX_STATES, MAX_VARIABLES, Variable};
use crate::wrong::Wrong;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A table of texts: a header and rows of as many cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cells {
    /// The names of the columns.
    pub header: Vec<String>,
    /// The columns, each with a cell a row.
    pub columns: Vec<Vec<String>>,
}

impl Cells {
    /// Reads a table. Cells may be quoted, with `""` for a quote within; ends of lines are LF or
    /// CR LF; spaces around a cell that is not quoted are left out; empty lines are passed over.
    ///
    /// # Errors
    /// When the text is empty, a row has more or fewer cells than the header, a cell is empty, two
    /// columns have one name, or a quote does not end.
    pub fn parse(text: &str) -> Result<Self, Wrong> {
        let mut reader = Reader { rest: text, line: 1 };
        let header = loop {
            match reader.record()? {
                None => {
                    let help = "the first line names the columns, each further one is a row";
                    return Err(Wrong::whole("empty file").help(help));
                }
                Some((_, record)) if is_blank(&record) => {}
                Some(found) => break found,
            }
        };
        let (line, header) = header;
        if header.len() > MAX_VARIABLES {
            return Err(Wrong::at((line, 1), format!("more than {MAX_VARIABLES} columns")));
        }
        for (at, name) in header.iter().enumerate() {
            if name.is_empty() {
                return Err(Wrong::at((line, 1), format!("column {} has no name", at + 1)));
            }
            if header[..at].contains(name) {
                let message = format!("two columns are called {name}");
                return Err(Wrong::at((line, 1), message).help("give each a name of its own"));
            }
        }
        let mut columns = vec![Vec::new(); header.len()];
        while let Some((line, record)) = reader.record()? {
            if is_blank(&record) {
                continue;
            }
            if record.len() != header.len() {
                let (has, wants) = (record.len(), header.len());
                return Err(Wrong::at((line, 1), format!("{has} cells, the header has {wants}")));
            }
            for (at, (cell, column)) in record.into_iter().zip(&mut columns).enumerate() {
                if cell.is_empty() {
                    let (number, name) = (at + 1, &header[at]);
                    let message = format!(
                        "cell {number} ({name}) is empty: missing values are not supported"
                    );
                    let help = "leave the row out, or give the missing value a name of its own";
                    return Err(Wrong::at((line, 1), message).help(help));
                }
                column.push(cell);
            }
        }
        if columns.first().is_none_or(Vec::is_empty) {
            return Err(Wrong::whole("no rows").help("the file has a header only"));
        }
        Ok(Self { header, columns })
    }

    /// Takes each different text of a column as a state. States stand in the order of their
    /// numbers if all are numbers, and else in that of their letters.
    ///
    /// # Errors
    /// When a column has more than [`MAX_STATES`] different values.
    pub fn into_data(self) -> Result<Data, Wrong> {
        let (mut variables, mut columns) = (Vec::new(), Vec::new());
        for (name, cells) in self.header.into_iter().zip(self.columns) {
            let mut number = BTreeMap::new();
            for cell in &cells {
                number.insert(cell.as_str(), 0_u16);
                if number.len() > MAX_STATES {
                    let message = format!("{name} has more than {MAX_STATES} different values");
                    let help =
                        "are these measurements? `cotama risk discretise` makes steps of them";
                    return Err(Wrong::whole(message).help(help));
                }
            }
            let mut states: Vec<&str> = number.keys().copied().collect();
            if states.iter().all(|it| measured(it).is_some()) {
                let value = |it: &str| measured(it).unwrap_or(0.0);
                states.sort_by(|a, b| value(a).total_cmp(&value(b)).then(a.cmp(b)));
            }
            for (at, state) in states.iter().enumerate() {
                number.insert(state, at as u16);
            }
            let states = states.iter().map(|it| (*it).to_owned()).collect();
            columns.push(
                cells.iter().map(|it| number.get(it.as_str()).copied().unwrap_or(0)).collect(),
            );
            variables.push(Variable { name, states });
        }
        Data::new(variables, columns)
    }

    /// Writes the table; cells are quoted where they must be.
    pub fn to_csv(&self) -> String {
        let mut text = String::new();
        let mut line = |cells: &mut dyn Iterator<Item = &String>| {
            let cells: Vec<_> = cells.map(|it| quoted(it)).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        };
        line(&mut self.header.iter());
        for row in 0..self.columns.first().map_or(0, Vec::len) {
            line(&mut self.columns.iter().filter_map(|it| it.get(row)));
        }
        text
    }
}

impl Data {
    /// Reads a table in CSV; see [`Cells::parse`] and [`Cells::into_data`].
    ///
    /// # Errors
    /// As these two.
    pub fn from_csv(text: &str) -> Result<Self, Wrong> {
        Cells::parse(text)?.into_data()
    }

    /// Writes the table in CSV.
    pub fn to_csv(&self) -> String {
        let header = self.variables().iter().map(|it| it.name.clone()).collect();
        let named = |at: usize| {
            let states = &self.variables()[at].states;
            self.column(at).iter().map(|it| states[usize::from(*it)].clone()).collect()
        };
        let columns = (0..self.variables().len()).map(named).collect();
        Cells { header, columns }.to_csv()
    }
}

/// The finite number that a cell is, if it is one.
pub(crate) fn measured(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|it: &f64| it.is_finite())
}

fn quoted(cell: &str) -> String {
    let bare = !cell.contains(['"', ',', '\n', '\r']) && cell.trim() == cell;
    if bare { cell.to_owned() } else { format!("\"{}\"", cell.replace('"', "\"\"")) }
}

fn is_blank(record: &[String]) -> bool {
    matches!(record, [only] if only.is_empty())
}

struct Reader<'t> {
    rest: &'t str,
    line: usize,
}

impl Reader<'_> {
    /// The next record and its line.
    fn record(&mut self) -> Result<Option<(usize, Vec<String>)>, Wrong> {
        if self.rest.is_empty() {
            return Ok(None);
        }
        let (line, mut cells) = (self.line, Vec::new());
        loop {
            let space = self.rest.trim_start_matches([' ', '\t']);
            if let Some(inside) = space.strip_prefix('"') {
                cells.push(self.quoted(inside)?);
            } else {
                let end = self.rest.find([',', '\n']).unwrap_or(self.rest.len());
                cells.push(self.rest[..end].trim().to_owned());
                self.rest = &self.rest[end..];
            }
            if let Some(rest) = self.rest.strip_prefix(',') {
                self.rest = rest;
                continue;
            }
            self.rest = self.rest.strip_prefix('\n').unwrap_or(self.rest);
            self.line += 1;
            return Ok(Some((line, cells)));
        }
    }

    /// The rest of a quoted cell, up to what separates it from the next one.
    fn quoted(&mut self, inside: &str) -> Result<String, Wrong> {
        let (mut cell, mut rest, line) = (String::new(), inside, self.line);
        loop {
            let Some((before, behind)) = rest.split_once('"') else {
                return Err(Wrong::at((line, 1), "a quote in this line does not end"));
            };
            cell += before;
            self.line += before.matches('\n').count();
            if let Some(more) = behind.strip_prefix('"') {
                cell.push('"');
                rest = more;
                continue;
            }
            let behind = behind.trim_start_matches([' ', '\t', '\r']);
            if !(behind.is_empty() || behind.starts_with([',', '\n'])) {
                let message = "a comma or the end of the line is needed behind a quote";
                return Err(Wrong::at((self.line, 1), message));
            }
            // The reader goes on where the cell ended, in the same text.
            let used = self.rest.len() - behind.len();
            self.rest = &self.rest[used..];
            return Ok(cell);
        }
    }
}

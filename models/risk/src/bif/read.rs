//! The reader of BIF.

use super::lexer::{Is, Lexer, Token};
use crate::data::{MAX_STATES, MAX_VARIABLES, Variable};
use crate::network::{MAX_CELLS, Network, Node, configurations, sorted};
use crate::rows::{self, Row};
use crate::wrong::Wrong;
use std::collections::BTreeMap;

impl Network {
    /// Reads a network in BIF, and notes about what was set right: rows of rounded numbers that
    /// miss the sum of 1 by less than their rounding are normalised.
    ///
    /// Commas and bars are white space, rows come in any order, a flat `table` of a variable with
    /// parents has the variable's own state slowest and the last parent fastest, and `default` is
    /// for rows that are not listed.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line and, of a name, the near one.
    pub fn from_bif(text: &str) -> Result<(Self, Vec<String>), Wrong> {
        let mut reader = Reader { lexer: Lexer::new(text), file: File::default() };
        reader.blocks()?;
        reader.file.network(&reader.lexer)
    }
}

/// Blocks as they stand in the file.
#[derive(Default)]
pub(super) struct File<'t> {
    pub(super) name: &'t str,
    pub(super) variables: Vec<(usize, Variable)>,
    pub(super) numbers: BTreeMap<&'t str, usize>,
    pub(super) tables: BTreeMap<usize, Block<'t>>,
}

/// A block of probabilities.
pub(super) struct Block<'t> {
    pub(super) at: usize,
    pub(super) parents: Vec<(usize, &'t str)>,
    pub(super) entries: Vec<Entry<'t>>,
}

pub(super) struct Entry<'t> {
    pub(super) at: usize,
    pub(super) of: Of<'t>,
    pub(super) numbers: Vec<(usize, &'t str)>,
}

pub(super) enum Of<'t> {
    /// All rows at once, the variable's own state slowest.
    Table,
    /// All rows at once, one after the other.
    Rows,
    /// Rows that are not listed.
    Default,
    /// The row of these states of the parents.
    Row(Vec<(usize, &'t str)>),
}

struct Reader<'t> {
    lexer: Lexer<'t>,
    file: File<'t>,
}

impl<'t> Reader<'t> {
    fn blocks(&mut self) -> Result<(), Wrong> {
        // A block of probabilities may stand before its variable.
        let mut tables = Vec::new();
        loop {
            let token = self.lexer.next()?;
            match token.is {
                Is::End => break,
                Is::Word("network") => self.network()?,
                Is::Word("variable") => self.variable()?,
                Is::Word("probability") => tables.push(self.probability(token.at)?),
                Is::Word("property") => self.lexer.property()?,
                Is::Word(word) => {
                    let message = format!("no block is called `{word}`");
                    let names = ["network", "variable", "probability"];
                    let wrong = self.lexer.wrong(token.at, message).near(word, names);
                    let help = "a file in BIF has blocks `network`, `variable`, `probability`";
                    return Err(if wrong.help.is_some() { wrong } else { wrong.help(help) });
                }
                Is::Sign(_) => return Err(self.lexer.needed(token, "a block")),
            }
        }
        for ((at, name), block) in tables {
            let number = self.file.number(&self.lexer, at, name)?;
            if self.file.tables.insert(number, block).is_some() {
                let message = format!("{name} has two probability blocks");
                return Err(self.lexer.wrong(at, message).help("remove one of them"));
            }
        }
        Ok(())
    }

    fn network(&mut self) -> Result<(), Wrong> {
        if let Token { is: Is::Word(name), .. } = self.lexer.peek()? {
            self.lexer.next()?;
            self.file.name = name;
        }
        self.lexer.sign('{')?;
        self.properties()
    }

    /// Properties up to the end of a block.
    fn properties(&mut self) -> Result<(), Wrong> {
        loop {
            match self.lexer.next()? {
                Token { is: Is::Sign('}'), .. } => return Ok(()),
                Token { is: Is::Word("property"), .. } => self.lexer.property()?,
                other => return Err(self.lexer.needed(other, "`property` or `}`")),
            }
        }
    }

    fn variable(&mut self) -> Result<(), Wrong> {
        let (at, name) = self.lexer.name("the name of a variable")?;
        if self.file.numbers.contains_key(name) {
            return Err(self.lexer.wrong(at, format!("two variables are called {name}")));
        }
        self.lexer.sign('{')?;
        let mut states: Option<Vec<String>> = None;
        loop {
            let token = self.lexer.next()?;
            match token.is {
                Is::Sign('}') => break,
                Is::Word("property") => self.lexer.property()?,
                Is::Word("type") if states.is_none() => states = Some(self.states(name)?),
                _ => return Err(self.lexer.needed(token, "`type` or `}`")),
            }
        }
        let Some(states) = states else {
            let message = format!("{name} has no type");
            return Err(self.lexer.wrong(at, message).help("type discrete [ 2 ] { yes, no };"));
        };
        let number = self.file.variables.len();
        if number == MAX_VARIABLES {
            return Err(self.lexer.wrong(at, format!("more than {MAX_VARIABLES} variables")));
        }
        self.file.numbers.insert(name, number);
        self.file.variables.push((at, Variable { name: name.to_owned(), states }));
        Ok(())
    }

    /// The states behind `type`.
    fn states(&mut self, name: &str) -> Result<Vec<String>, Wrong> {
        let (at, kind) = self.lexer.name("`discrete`")?;
        if kind != "discrete" {
            let message = format!("{name} is of type {kind}, and only `discrete` is read");
            return Err(self.lexer.wrong(at, message));
        }
        self.lexer.sign('[')?;
        let (count_at, count) = self.lexer.name("the number of states")?;
        self.lexer.sign(']')?;
        self.lexer.sign('{')?;
        let words = self.lexer.words('}')?;
        self.lexer.sign(';')?;
        if count.parse() != Ok(words.len()) {
            let listed = words.len();
            let message = format!("{name} declares {count} states and lists {listed}");
            return Err(self.lexer.wrong(count_at, message));
        }
        if !(1..=MAX_STATES).contains(&words.len()) {
            return Err(self.lexer.wrong(count_at, format!("{name}: 1 to {MAX_STATES} states")));
        }
        for (at, (place, word)) in words.iter().enumerate() {
            if words[..at].iter().any(|it| it.1 == *word) {
                let message = format!("{name} has two states {word}");
                return Err(self.lexer.wrong(*place, message));
            }
        }
        Ok(words.iter().map(|it| it.1.to_owned()).collect())
    }

    fn probability(&mut self, at: usize) -> Result<((usize, &'t str), Block<'t>), Wrong> {
        self.lexer.sign('(')?;
        let child = self.lexer.name("the name of a variable")?;
        let parents = self.lexer.words(')')?;
        self.lexer.sign('{')?;
        let mut entries = Vec::new();
        loop {
            let token = self.lexer.next()?;
            let of = match token.is {
                Is::Sign('}') => break,
                Is::Word("property") => {
                    self.lexer.property()?;
                    continue;
                }
                Is::Word("table") => Of::Table,
                Is::Word("default") => Of::Default,
                Is::Sign('(') => Of::Row(self.lexer.words(')')?),
                _ => return Err(self.lexer.needed(token, "`table`, `default`, a row or `}`")),
            };
            entries.push(Entry { at: token.at, of, numbers: self.lexer.words(';')? });
        }
        Ok((child, Block { at, parents, entries }))
    }
}

impl File<'_> {
    pub(super) fn number(&self, lexer: &Lexer<'_>, at: usize, name: &str) -> Result<usize, Wrong> {
        self.numbers.get(name).copied().ok_or_else(|| {
            lexer.wrong(at, format!("no variable {name}")).near(name, self.numbers.keys().copied())
        })
    }

    pub(super) fn network(&self, lexer: &Lexer<'_>) -> Result<(Network, Vec<String>), Wrong> {
        if self.variables.is_empty() {
            let help = "a file in BIF has blocks `network`, `variable`, `probability`";
            return Err(Wrong::whole("no variables").help(help));
        }
        let mut nodes = Vec::new();
        for (number, (at, variable)) in self.variables.iter().enumerate() {
            let Some(block) = self.tables.get(&number) else {
                let message = format!("{} has no probability block", variable.name);
                return Err(lexer.wrong(*at, message));
            };
            let mut parents = Vec::new();
            for (at, name) in &block.parents {
                let parent = self.number(lexer, *at, name)?;
                if parent == number || parents.contains(&parent) {
                    let message = format!("{name} cannot be a parent of {} here", variable.name);
                    return Err(lexer.wrong(*at, message));
                }
                parents.push(parent);
            }
            nodes.push(Node { variable: variable.clone(), parents, table: Vec::new() });
        }
        self.refuse_cycle(lexer, &nodes)?;
        let (mut notes, mut cells) = (rows::Notes::default(), 0);
        for number in 0..nodes.len() {
            if let Some(block) = self.tables.get(&number) {
                let table = Tables { lexer, nodes: &nodes, number, block };
                nodes[number].table = table.read(&mut cells, &mut notes)?;
            }
        }
        let name = if self.name.is_empty() { "network" } else { self.name };
        Ok((Network::new(name, nodes)?, notes.told(|at| lexer.wrong(at, "").line)))
    }

    fn refuse_cycle(&self, lexer: &Lexer<'_>, nodes: &[Node]) -> Result<(), Wrong> {
        let parents: Vec<_> = nodes.iter().map(|it| it.parents.as_slice()).collect();
        let Err(cycle) = sorted(&parents) else { return Ok(()) };
        let name = |it: &usize| nodes[*it].variable.name.as_str();
        let names: Vec<_> = cycle.iter().chain(cycle.first()).map(name).collect();
        let at = cycle.first().and_then(|it| self.tables.get(it)).map_or(0, |it| it.at);
        Err(lexer.wrong(at, format!("{} is a cycle", names.join(" -> "))))
    }
}

/// Parts of the table of one variable.
struct Tables<'a, 't> {
    lexer: &'a Lexer<'t>,
    nodes: &'a [Node],
    number: usize,
    block: &'a Block<'t>,
}

impl Tables<'_, '_> {
    fn read(&self, cells: &mut usize, notes: &mut rows::Notes) -> Result<Vec<f64>, Wrong> {
        let node = &self.nodes[self.number];
        let (name, states) = (&node.variable.name, node.variable.states.len());
        let lexer = self.lexer;
        let count = configurations(self.nodes, &node.parents)
            .ok()
            .filter(|it| it * states <= MAX_CELLS - *cells)
            .ok_or_else(|| {
                let message = format!("with the table of {name} more than {MAX_CELLS} cells");
                lexer.wrong(self.block.at, message)
            })?;
        *cells += count * states;
        let mut rows: Vec<Option<Row>> = vec![None; count];
        let mut default = None;
        for entry in &self.block.entries {
            match &entry.of {
                Of::Table | Of::Rows => self.flat(entry, &mut rows)?,
                Of::Default if default.is_some() => {
                    return Err(lexer.wrong(entry.at, format!("{name} has two defaults")));
                }
                Of::Default => default = Some(self.row(entry)?),
                Of::Row(of) => {
                    let at = self.place(entry.at, of)?;
                    if rows[at].replace(self.row(entry)?).is_some() {
                        let message = format!("{name} has two rows for {}", self.words(at));
                        return Err(lexer.wrong(entry.at, message).help("remove one of them"));
                    }
                }
            }
        }
        let mut table = Vec::with_capacity(count * states);
        for (at, row) in rows.into_iter().enumerate() {
            let Some(row) = row.or_else(|| default.clone()) else {
                let message = if node.parents.is_empty() {
                    format!("{name} has no table")
                } else {
                    format!("{name} has no row for {}", self.words(at))
                };
                return Err(lexer.wrong(self.block.at, message));
            };
            let of = || if node.parents.is_empty() { String::new() } else { self.words(at) + " " };
            let told = |(at, why): (usize, String)| {
                let message = format!("row {}of {name} {why}", of());
                lexer.wrong(at, message).help("probabilities of a row sum to 1")
            };
            table.extend(row.normalised(notes).map_err(told)?);
        }
        Ok(table)
    }

    /// Reads numbers of a row.
    fn row(&self, entry: &Entry<'_>) -> Result<Row, Wrong> {
        let variable = &self.nodes[self.number].variable;
        let (has, wants) = (entry.numbers.len(), variable.states.len());
        if has != wants {
            let message =
                format!("{} has {wants} states, and here are {has} numbers", variable.name);
            return Err(self.lexer.wrong(entry.at, message));
        }
        let mut row = Row::new(entry.at);
        for (at, word) in &entry.numbers {
            self.push(&mut row, *at, word)?;
        }
        Ok(row)
    }

    fn push(&self, row: &mut Row, at: usize, word: &str) -> Result<(), Wrong> {
        let name = &self.nodes[self.number].variable.name;
        row.push(word).map_err(|why| self.lexer.wrong(at, format!("{why} of {name}")))
    }

    /// Reads all rows.
    fn flat(&self, entry: &Entry<'_>, rows: &mut [Option<Row>]) -> Result<(), Wrong> {
        let variable = &self.nodes[self.number].variable;
        let (has, wants) = (entry.numbers.len(), rows.len() * variable.states.len());
        if has != wants {
            let message = format!("the table of {} has {has} numbers, not {wants}", variable.name);
            return Err(self.lexer.wrong(entry.at, message));
        }
        let (count, states) = (rows.len(), variable.states.len());
        let is_flat = matches!(entry.of, Of::Table);
        let steps = |at: usize| if is_flat { (at, count) } else { (at * states, 1) };
        for (at, row) in rows.iter_mut().enumerate() {
            let (first, step) = steps(at);
            let mut own = Row::new(entry.at);
            for (place, word) in entry.numbers.iter().skip(first).step_by(step).take(states) {
                self.push(&mut own, *place, word)?;
            }
            if row.replace(own).is_some() {
                let message = format!("{} has a table and other rows", variable.name);
                return Err(self.lexer.wrong(entry.at, message));
            }
        }
        Ok(())
    }

    /// The number of the configuration of these states of the parents.
    fn place(&self, at: usize, of: &[(usize, &str)]) -> Result<usize, Wrong> {
        let node = &self.nodes[self.number];
        if of.len() != node.parents.len() {
            let (has, wants) = (of.len(), node.parents.len());
            let message = format!("{} has {wants} parents, not {has}", node.variable.name);
            return Err(self.lexer.wrong(at, message));
        }
        let mut number = 0;
        for ((at, word), parent) in of.iter().zip(&node.parents) {
            let parent = &self.nodes[*parent].variable;
            let Some(state) = parent.state(word) else {
                let message = format!("{} has no state {word}", parent.name);
                let names = parent.states.iter().map(String::as_str);
                return Err(self.lexer.wrong(*at, message).near(word, names));
            };
            number = number * parent.states.len() + state;
        }
        Ok(number)
    }

    /// The configuration of this number, in words.
    fn words(&self, mut number: usize) -> String {
        let mut words = Vec::new();
        for parent in self.nodes[self.number].parents.iter().rev() {
            let states = &self.nodes[*parent].variable.states;
            words.push(states[number % states.len()].as_str());
            number /= states.len();
        }
        words.reverse();
        format!("({})", words.join(", "))
    }
}

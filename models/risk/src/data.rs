//! Rows of discrete values, one column a variable.

use crate::wrong::Wrong;

/// The most variables of a table or a network.
pub const MAX_VARIABLES: usize = 2_048;
/// The most rows of a table.
pub const MAX_ROWS: usize = 1 << 22;
/// The most states of a variable.
pub const MAX_STATES: usize = 1_024;

/// A variable: a name, and the names of its states. A state is never converted: `True`, `0` and
/// `yes` are three names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// The name of the variable.
    pub name: String,
    /// The names of its states, at least one.
    pub states: Vec<String>,
}

impl Variable {
    /// The number of the state of this name.
    pub fn state(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|it| it == name)
    }
}

/// Complete discrete data.
///
/// ```
/// use cotama_risk::Data;
/// let data = Data::from_csv("way,status\nshort,failed\nlong,success\nshort,success\n").unwrap();
/// assert_eq!(data.variables()[1].states, ["failed", "success"]);
/// assert_eq!(data.column(0), [1, 0, 1]); // long is the first state, short the second
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Data {
    variables: Vec<Variable>,
    /// Invariant: as many as variables, all of the same length, each number below the states.
    columns: Vec<Vec<u16>>,
}

impl Data {
    /// Rows of states by their numbers, one column a variable.
    ///
    /// # Errors
    /// When there is no column or no row, when columns differ in length, a name stands twice, a
    /// number is no state, or a [limit](MAX_STATES) is passed.
    pub fn new(variables: Vec<Variable>, columns: Vec<Vec<u16>>) -> Result<Self, Wrong> {
        let rows = columns.first().map_or(0, Vec::len);
        if variables.is_empty() || rows == 0 {
            return Err(Wrong::whole("no rows"));
        }
        if variables.len() > MAX_VARIABLES {
            return Err(Wrong::whole(format!("more than {MAX_VARIABLES} variables")));
        }
        if rows > MAX_ROWS {
            return Err(Wrong::whole(format!("more than {MAX_ROWS} rows")).help("take a part"));
        }
        if variables.len() != columns.len() || columns.iter().any(|it| it.len() != rows) {
            return Err(Wrong::whole("the columns do not have the same length"));
        }
        for (at, (variable, column)) in variables.iter().zip(&columns).enumerate() {
            let Variable { name, states } = variable;
            if variables[..at].iter().any(|it| it.name == *name) {
                return Err(Wrong::whole(format!("two columns are called {name}")));
            }
            if states.len() > MAX_STATES {
                return Err(Wrong::whole(format!("{name} has more than {MAX_STATES} states")));
            }
            if column.iter().any(|it| usize::from(*it) >= states.len()) {
                return Err(Wrong::whole(format!("{name} has a number that is no state")));
            }
        }
        Ok(Self { variables, columns })
    }

    /// Returns the same variables with these rows, by their numbers, in this order.
    pub(crate) fn of_rows(&self, rows: &[usize]) -> Self {
        let column = |it: &Vec<u16>| rows.iter().filter_map(|row| it.get(*row)).copied().collect();
        let columns = self.columns.iter().map(column).collect();
        Self { variables: self.variables.clone(), columns }
    }

    /// The variables, in the order of the columns.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// The number of rows, at least one.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// The states of a variable, row by row.
    ///
    /// # Panics
    /// When there is no such column.
    pub fn column(&self, variable: usize) -> &[u16] {
        &self.columns[variable]
    }

    /// The number of the variable of this name.
    ///
    /// # Errors
    /// When there is none; the message has the near name.
    pub fn variable(&self, name: &str) -> Result<usize, Wrong> {
        named(&self.variables, name)
    }

    /// Returns the number of states of a variable.
    pub(crate) fn states(&self, variable: usize) -> usize {
        self.variables.get(variable).map_or(0, |it| it.states.len())
    }

    /// Names of the variables that have one state only: no arc of theirs ever pays.
    pub fn constant(&self) -> Vec<&str> {
        let constant = self.variables.iter().filter(|it| it.states.len() == 1);
        constant.map(|it| it.name.as_str()).collect()
    }
}

/// The number of the variable of this name.
pub(crate) fn named(variables: &[Variable], name: &str) -> Result<usize, Wrong> {
    variables.iter().position(|it| it.name == name).ok_or_else(|| {
        Wrong::whole(format!("no variable {name}"))
            .near(name, variables.iter().map(|it| it.name.as_str()))
    })
}

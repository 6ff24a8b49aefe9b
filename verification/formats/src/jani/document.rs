//! The part of the JANI format that a net needs; fields in the order in which they are written.

use serde::Serialize;

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct Model {
    pub(super) jani_version: u8,
    pub(super) name: String,
    pub(super) metadata: Metadata,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) features: [&'static str; 1],
    pub(super) actions: Vec<Action>,
    pub(super) variables: Vec<Variable>,
    pub(super) properties: Vec<Property>,
    pub(super) automata: [Automaton; 1],
    pub(super) system: Composition,
}

#[derive(Serialize)]
pub(super) struct Metadata {
    pub(super) description: String,
}

#[derive(Serialize)]
pub(super) struct Action {
    pub(super) name: String,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct Variable {
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) kind: Type,
    pub(super) initial_value: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) comment: Option<String>,
}

#[derive(Serialize)]
#[serde(untagged, rename_all_fields = "kebab-case")]
pub(super) enum Type {
    Basic(&'static str),
    Bounded { kind: &'static str, base: &'static str, lower_bound: u32, upper_bound: u32 },
}

impl Type {
    pub(super) fn up_to(bound: Option<u32>) -> Self {
        match bound {
            None => Self::Basic("int"),
            Some(upper_bound) => {
                Self::Bounded { kind: "bounded", base: "int", lower_bound: 0, upper_bound }
            }
        }
    }
}

#[derive(Serialize)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) expression: Expression,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct Automaton {
    pub(super) name: &'static str,
    pub(super) locations: [Location; 1],
    pub(super) initial_locations: [&'static str; 1],
    pub(super) edges: Vec<Edge>,
}

#[derive(Serialize)]
pub(super) struct Location {
    pub(super) name: &'static str,
}

#[derive(Serialize)]
pub(super) struct Edge {
    pub(super) location: &'static str,
    pub(super) action: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) guard: Option<Guard>,
    pub(super) destinations: [Destination; 1],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) comment: Option<String>,
}

#[derive(Serialize)]
pub(super) struct Guard {
    pub(super) exp: Expression,
}

#[derive(Serialize)]
pub(super) struct Destination {
    pub(super) location: &'static str,
    pub(super) assignments: Vec<Assignment>,
}

#[derive(Serialize)]
pub(super) struct Assignment {
    #[serde(rename = "ref")]
    pub(super) variable: String,
    pub(super) value: Expression,
}

#[derive(Serialize)]
pub(super) struct Composition {
    pub(super) elements: [Element; 1],
    pub(super) syncs: Vec<Sync>,
}

#[derive(Serialize)]
pub(super) struct Element {
    pub(super) automaton: &'static str,
}

#[derive(Serialize)]
pub(super) struct Sync {
    pub(super) synchronise: [String; 1],
    pub(super) result: String,
}

#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Expression {
    Number(u64),
    Truth(bool),
    Variable(String),
    Predicate {
        op: &'static str,
    },
    Unary {
        op: &'static str,
        exp: Box<Expression>,
    },
    Binary {
        op: &'static str,
        left: Box<Expression>,
        right: Box<Expression>,
    },
    /// The values of an expression in some states, and what is made of them.
    Filter {
        op: &'static str,
        fun: &'static str,
        values: Box<Expression>,
        states: Box<Expression>,
    },
}

impl Expression {
    pub(super) fn unary(op: &'static str, exp: Self) -> Self {
        Self::Unary { op, exp: Box::new(exp) }
    }

    pub(super) fn binary(op: &'static str, left: Self, right: Self) -> Self {
        Self::Binary { op, left: Box::new(left), right: Box::new(right) }
    }

    /// All operands joined, as a balanced tree: its depth stays small however many they are.
    pub(super) fn all(op: &'static str, mut operands: Vec<Self>) -> Option<Self> {
        if operands.len() < 2 {
            return operands.pop();
        }
        let right = operands.split_off(operands.len().div_ceil(2));
        Some(Self::binary(op, Self::all(op, operands)?, Self::all(op, right)?))
    }

    /// `formula` holds in every initial state.
    pub(super) fn at_start(formula: Self) -> Self {
        let states = Box::new(Self::Predicate { op: "initial" });
        Self::Filter { op: "filter", fun: "∀", values: Box::new(formula), states }
    }
}

//! Operands: comparisons, numbers, names, and parentheses.

use super::error::Fault;
use super::lexer::{Token, is_reserved};
use super::linear::{Comparison, Sum};
use super::parser::Parser;
use super::value::{Join, Value, What};
use super::{Atom, Formula};
use crate::source::quoted;
use cotama_core::net::TransitionId;
use std::ops::Range;

impl Parser<'_> {
    pub(super) fn comparison(&mut self) -> Result<Value, Fault> {
        let left = self.sum()?;
        let Some(comparison) = self.compared() else { return Ok(left) };
        let start = left.span.start;
        let left = left.sum()?;
        self.at += 1;
        let right = self.sum()?.sum()?;
        if self.compared().is_some() {
            let fault = Fault::new(self.span(), "a comparison of a comparison");
            return Err(fault.help("compare two numbers at a time, as in `1 <= p & p <= 3`"));
        }
        let span = start..self.end();
        let formula = left.compare(comparison, &right).ok_or_else(|| too_large(span.clone()))?;
        Ok(Value::new(What::Formula(formula), span))
    }

    fn compared(&self) -> Option<Comparison> {
        let Token::Symbol(symbol) = self.token() else { return None };
        match *symbol {
            "<=" => Some(Comparison::AtMost),
            "<" => Some(Comparison::Less),
            ">=" => Some(Comparison::AtLeast),
            ">" => Some(Comparison::Greater),
            "=" | "==" => Some(Comparison::Equal),
            "!=" => Some(Comparison::Unequal),
            _ => None,
        }
    }

    fn sum(&mut self) -> Result<Value, Fault> {
        let mut left = self.product()?;
        loop {
            let factor = if self.take(&["+"]) {
                1
            } else if self.take(&["-"]) {
                -1
            } else {
                return Ok(left);
            };
            let start = left.span.start;
            let first = left.sum()?;
            let second = self.product()?.sum()?;
            let span = start..self.end();
            let sum = first.plus(factor, &second).ok_or_else(|| too_large(span.clone()))?;
            left = Value::new(What::Sum(sum), span);
        }
    }

    fn product(&mut self) -> Result<Value, Fault> {
        let mut left = self.primary()?;
        while self.take(&["*"]) {
            let start = left.span.start;
            let first = left.sum()?;
            let second = self.primary()?.sum()?;
            let span = start..self.end();
            let product = first.times(&second).map_err(|()| {
                Fault::new(span.clone(), "a product of two numbers of tokens")
                    .help("one factor of a product is a number, as in `2 * p`")
            })?;
            left = Value::new(What::Sum(product.ok_or_else(|| too_large(span.clone()))?), span);
        }
        Ok(left)
    }

    fn primary(&mut self) -> Result<Value, Fault> {
        if *self.token() == Token::Symbol("(") { self.parentheses() } else { self.simple() }
    }

    fn parentheses(&mut self) -> Result<Value, Fault> {
        let start = self.span().start;
        self.at += 1;
        let mut inner = self.nested(|it| it.expression(Join::Equivalence))?;
        if !self.take(&[")"]) {
            return Err(self.unexpected("`)` is expected, or an operator"));
        }
        (inner.span, inner.until) = (start..self.end(), None);
        (inner.closed, inner.open) = (true, None);
        Ok(inner)
    }

    /// Reads an operand in which nothing is nested. Kept apart from nested operands, which a deep
    /// text puts on the stack many times.
    #[inline(never)]
    fn simple(&mut self) -> Result<Value, Fault> {
        let span = self.span();
        let next = self.token_at(self.at + 1);
        let is_place = |word: &str| self.names.is_place(word);
        let what = match self.token() {
            Token::Word(word @ ("true" | "false" | "deadlock")) if is_place(word) => {
                return Err(self.in_two_senses(word));
            }
            Token::Number(number) => {
                self.at += 1;
                What::Sum(Sum::constant(i128::from(*number)))
            }
            Token::Word("true") => self.statement(Formula::TRUE),
            Token::Word("false") => self.statement(Formula::FALSE),
            Token::Word("deadlock") => self.statement(Formula::Atom(Atom::Deadlock)),
            Token::Word("fireable") if *next == Token::Symbol("(") || !is_place("fireable") => {
                self.fireable()?
            }
            Token::Word(
                question @ ("bounds" | "bound" | "live" | "quasi_live" | "stable" | "one_safe"),
            ) if *next == Token::Symbol("(") || !is_place(question) => {
                let fault = Fault::new(
                    span,
                    format!("`{question}` is a question of its own, not a statement"),
                );
                return Err(fault.help("ask for it alone"));
            }
            Token::Word(word) if *next == Token::Symbol("(") && !is_reserved(word) => {
                let known = ["fireable", "bounds", "bound"];
                let meant = known.into_iter().find(|known| strsim::osa_distance(word, known) <= 2);
                let fault = Fault::new(
                    span,
                    format!("{} is not something that is said of names", quoted(word)),
                );
                return Err(match meant {
                    Some(meant) => fault.help(format!("did you mean `{meant}`?")),
                    None => fault.help(
                        "there are `fireable(t1, t2)`, `bounds(p1 + p2)` and `bound(t -> p)`",
                    ),
                });
            }
            Token::Word(_) | Token::Quoted(_) => {
                let (name, span) = self.name("a place")?;
                What::Sum(Sum::tokens(self.names.place(name, span)?))
            }
            _ => {
                return Err(
                    self.unexpected("a statement, a number or the name of a place is expected")
                );
            }
        };
        Ok(Value::new(what, span.start..self.end()))
    }

    fn statement(&mut self, formula: Formula) -> What {
        self.at += 1;
        What::Formula(formula)
    }

    fn fireable(&mut self) -> Result<What, Fault> {
        self.at += 1;
        Ok(What::Formula(Formula::Atom(Atom::Fireable(self.transitions()?))))
    }

    /// Names of transitions in parentheses.
    pub(super) fn transitions(&mut self) -> Result<Vec<TransitionId>, Fault> {
        self.expect("(")?;
        let mut transitions = Vec::new();
        loop {
            let (name, span) = self.name("a transition")?;
            transitions.push(self.names.transition(name, span)?);
            if !self.take(&[","]) {
                break;
            }
        }
        if !self.take(&[")"]) {
            return Err(self.unexpected("names are separated by `,`, and `)` ends them"));
        }
        Ok(transitions)
    }
}

pub(super) fn too_large(span: Range<usize>) -> Fault {
    Fault::new(span, "the numbers here are too large to count with")
        .help(format!("weights and constants are at most {}", i64::MAX))
}

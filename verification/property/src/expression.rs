//! Expressions: operators between operands, quantifiers, and temporal operators.

use super::Formula;
use super::error::Fault;
use super::lexer::Token;
use super::parser::Parser;
use super::value::{Join, Open, Value, What};
use crate::source::quoted;
use std::ops::Range;

impl Parser<'_> {
    fn join(&self) -> Option<Join> {
        let (Token::Word(next) | Token::Symbol(next)) = self.token() else { return None };
        match *next {
            "<->" => Some(Join::Equivalence),
            "->" => Some(Join::Implication),
            "|" | "||" | "or" => Some(Join::Or),
            "&" | "&&" | "and" => Some(Join::And),
            "U" => Some(Join::Until),
            _ => None,
        }
    }

    /// Operands joined by operators that bind at least as tightly. Where these are all operators,
    /// each quantifier in it has to show how far it reaches.
    pub(super) fn expression(&mut self, loosest: Join) -> Result<Value, Fault> {
        if loosest != Join::Equivalence {
            return self.joined(loosest);
        }
        let (start, outer) = (self.span().start, self.unclear.take());
        let value = self.joined(loosest)?;
        match std::mem::replace(&mut self.unclear, outer) {
            Some(open) => Err(self.two_readings(open, start..self.end())),
            None => Ok(value),
        }
    }

    /// Asks for parentheses around what a quantifier speaks of, in this part of the text.
    #[cold]
    fn two_readings(&self, open: Open, span: Range<usize>) -> Fault {
        const SHOWN: usize = 200;
        let part = |span: Range<usize>| self.text.get(span).unwrap_or("");
        let Open { quantifier, operand, end, .. } = open;
        let whole = part(span.clone());
        let message = format!("{} can be read in two ways", quoted(whole));
        let (before, more) = (span.start..quantifier, end..span.end);
        let wide = [part(span.start..operand), "(", part(operand..span.end), ")"].concat();
        let narrow = [part(before), "(", part(quantifier..end), ")", part(more)].concat();
        let help = if whole.len() <= SHOWN {
            format!("write `{wide}`, or `{narrow}`")
        } else {
            "put all that the quantifier speaks of in parentheses, or the quantifier with what it \
             speaks of"
                .to_owned()
        };
        Fault::new(span, message).help(help)
    }

    /// Notes a quantifier that ends before an operator, if what follows could be its operand's.
    fn reaches(&mut self, open: Option<Open>, join: Join, following: &[Formula]) {
        let apart = following.iter().all(is_quantified);
        let Some(open) = open else { return };
        let clear = match join {
            Join::Until => open.closed,
            Join::Implication | Join::Equivalence => open.closed && apart,
            Join::And | Join::Or => apart,
        };
        if !clear && self.unclear.is_none() {
            self.unclear = Some(open);
        }
    }

    fn joined(&mut self, loosest: Join) -> Result<Value, Fault> {
        let mut left = self.unary()?;
        while let Some(join) = self.join().filter(|&join| join >= loosest) {
            let (operator, start) = (self.span(), left.span.start);
            if join == Join::Until && !self.quantified {
                return Err(outside("U", operator));
            }
            let before = left.open;
            let last;
            let formula = match join {
                Join::Until => {
                    let first = left.operand()?;
                    self.at += 1;
                    let second = self.nested(|it| it.expression(Join::Until))?;
                    last = second.open;
                    let second = [second.formula()?];
                    self.reaches(before, join, &second);
                    let [second] = second;
                    Formula::Until(first.into(), second.into())
                }
                Join::And | Join::Or => {
                    let (mut all, mut opens) = (vec![left.operand()?], vec![before]);
                    while self.join() == Some(join) {
                        self.at += 1;
                        let part = self.expression(join.tighter())?;
                        opens.push(part.open);
                        all.push(part.operand()?);
                    }
                    last = opens.pop().flatten();
                    for (open, at) in opens.into_iter().zip(1..) {
                        self.reaches(open, join, all.get(at..).unwrap_or(&[]));
                    }
                    if join == Join::And { Formula::And(all) } else { Formula::Or(all) }
                }
                Join::Implication => {
                    let first = left.operand()?;
                    self.at += 1;
                    let second = self.nested(|it| it.expression(join))?;
                    last = second.open;
                    let second = [second.operand()?];
                    self.reaches(before, join, &second);
                    let [second] = second;
                    Formula::Or(vec![Formula::Not(first.into()), second])
                }
                Join::Equivalence => {
                    let first = left.operand()?;
                    self.at += 1;
                    let second = self.expression(join.tighter())?;
                    last = second.open;
                    let second = [second.operand()?];
                    self.reaches(before, join, &second);
                    let [second] = second;
                    Formula::equivalence(first, second, &mut self.parts).ok_or_else(|| {
                        Fault::new(
                            operator.clone(),
                            "the formula is too long when its equivalences are written out",
                        )
                        .help("ask for its parts one by one")
                    })?
                }
            };
            left = Value::new(What::Formula(formula), start..self.end());
            left.until = (join == Join::Until).then_some(operator);
            left.open = last;
        }
        Ok(left)
    }

    /// Returns the end of the last word that was passed.
    pub(super) fn end(&self) -> usize {
        self.at
            .checked_sub(1)
            .and_then(|at| self.lexemes.get(at))
            .map_or(0, |lexeme| lexeme.span.end)
    }

    /// Negations, quantifiers and temporal operators with what they are said of.
    fn unary(&mut self) -> Result<Value, Fault> {
        let span = self.span();
        let (Token::Word(operator) | Token::Symbol(operator)) = self.token() else {
            return self.comparison();
        };
        let (quantifier, temporal) = match *operator {
            "!" | "not" => (None, None),
            "A" | "E" => (Some(&operator[..1]), None),
            "X" | "F" | "G" => (None, Some(*operator)),
            "AX" | "EX" | "AF" | "EF" | "AG" | "EG" => (Some(&operator[..1]), Some(&operator[1..])),
            _ => return self.comparison(),
        };
        if self.names.is_place(operator) && !self.operand_follows(operator) {
            return self.comparison();
        }
        self.at += 1;
        let outer = self.quantified;
        self.quantified |= quantifier.is_some();
        if let (Some(temporal), false) = (temporal, self.quantified) {
            return Err(outside(temporal, span));
        }
        let limit = if temporal == Some("F") && self.take(&["<="]) {
            Some(self.milliseconds()?)
        } else {
            None
        };
        let operand = self.span().start;
        let inner = if quantifier.is_some() && temporal.is_none() && self.take(&["["]) {
            let mut inner = self.nested(|it| it.expression(Join::Equivalence))?;
            self.expect("]")?;
            inner.closed = true;
            inner
        } else {
            self.nested(Self::unary)?
        };
        self.quantified = outer;
        let closed = inner.closed;
        let own = || Open { quantifier: span.start, operand, end: self.end(), closed };
        let open = if quantifier.is_some() { Some(own()) } else { inner.open };
        let inner = inner.formula()?;
        let inner = match (temporal, limit) {
            (Some("X"), _) => Formula::Next(inner.into()),
            (Some("F"), Some(limit)) => Formula::Within(limit, inner.into()),
            (Some("F"), None) => Formula::Finally(inner.into()),
            (Some(_), _) => Formula::Globally(inner.into()),
            (None, _) => inner,
        };
        let formula = match quantifier {
            Some("E") => Formula::Exists(inner.into()),
            Some(_) => Formula::All(inner.into()),
            None if temporal.is_none() => Formula::Not(inner.into()),
            None => inner,
        };
        let value = Value::new(What::Formula(formula), span.start..self.end());
        Ok(Value { closed, open, ..value })
    }

    /// Whether what follows this operator can be its operand.
    fn operand_follows(&self, operator: &str) -> bool {
        let begins = |at: usize| match self.token_at(at) {
            Token::Number(_) | Token::Quoted(_) => true,
            Token::Symbol(symbol) => ["(", "!"].contains(symbol),
            Token::Word(word) => !["U", "and", "or"].contains(word),
            Token::End => false,
        };
        let next = self.at + 1;
        match *self.token_at(next) {
            Token::Symbol("[") => ["A", "E"].contains(&operator),
            Token::Symbol("<=") => {
                let unit = self.token_at(next + 2);
                ["F", "AF", "EF"].contains(&operator)
                    && matches!(self.token_at(next + 1), Token::Number(_))
                    && [Token::Word("ms"), Token::Word("s")].contains(unit)
            }
            Token::Word(word @ ("U" | "and" | "or")) => {
                self.names.is_place(word) && !begins(next + 1)
            }
            Token::Word("assuming") => self.names.is_place("assuming"),
            _ => begins(next),
        }
    }

    fn milliseconds(&mut self) -> Result<u64, Fault> {
        let span = self.span();
        let Token::Number(number) = *self.token() else {
            return Err(self.unexpected("a limit of time is expected, as in `AF<=200ms p`"));
        };
        self.at += 1;
        let unit = if self.take(&["ms"]) {
            1
        } else if self.take(&["s"]) {
            1000
        } else {
            return Err(self.unexpected("a limit of time has a unit: `ms` or `s`"));
        };
        number.checked_mul(unit).ok_or_else(|| {
            Fault::new(span, format!("{number} seconds are too many"))
                .help(format!("the largest limit is {} ms", u64::MAX))
        })
    }
}

/// Whether each part says of which runs it speaks, so that none is about the first marking alone.
fn is_quantified(formula: &Formula) -> bool {
    match formula {
        Formula::Exists(_) | Formula::All(_) => true,
        Formula::Not(inner) => is_quantified(inner),
        Formula::And(all) | Formula::Or(all) => !all.is_empty() && all.iter().all(is_quantified),
        _ => false,
    }
}

fn outside(operator: &str, span: Range<usize>) -> Fault {
    let help = match operator {
        "U" => "write `A[a U b]` or `E[a U b]`".to_owned(),
        _ => format!("write `A{operator}` or `E{operator}`, or `A (...)` around a formula of LTL"),
    };
    Fault::new(span, format!("the temporal operator `{operator}` stands outside of a quantifier"))
        .help(help)
}

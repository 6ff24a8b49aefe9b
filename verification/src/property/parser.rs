//! From a text of the language to a property.

use super::error::Fault;
use super::lexer::{Lexeme, Token, is_reserved, lexemes};
use super::names::{First, Ids, Names};
use super::value::{Join, Value, What};
use super::{Assumptions, Ctl, Formula, Ltl, Property, PropertyError, Question};
use crate::pt::Pt;
use crate::source::quoted;
use std::ops::Range;

/// The longest text, in bytes.
pub const MAX_TEXT: usize = 1 << 20;

/// How deep operators and parentheses may be nested, and formulas of files.
pub const MAX_DEPTH: usize = 128;

/// As [`parse`](super::parse), of a net whose nodes can be called by the ids of its file as well;
/// names go first.
///
/// # Errors
/// As [`parse`](super::parse).
pub fn parse_with(text: &str, net: &Pt, ids: Ids<'_>) -> Result<Property, PropertyError> {
    let located = |fault: Fault| fault.located("property", text);
    if text.len() > MAX_TEXT {
        let message = format!("the text has {} bytes, more than {MAX_TEXT}", text.len());
        return Err(located(Fault::new(0..0, message).help("ask for its parts one by one")));
    }
    let name = text.trim();
    if name == "deadlock_free" && net.place(name).is_none() {
        return Ok(Property { name: name.to_owned(), question: Question::deadlock_free() });
    }
    let mut parser = Parser {
        lexemes: &lexemes(text).map_err(located)?,
        at: 0,
        names: Names::new(net, ids, First::Names),
        depth: 0,
        quantified: false,
        parts: Formula::MAX_PARTS,
    };
    let question = parser.question().map_err(located)?;
    Ok(Property { name: name.to_owned(), question })
}

/// The formula, if there is an engine for it on fair runs: if it is of CTL, or one quantifier in
/// front of a formula of LTL.
fn on_fair_runs(formula: Formula, span: Range<usize>) -> Result<Formula, Fault> {
    let is_linear = matches!(&formula,
        Formula::All(path) | Formula::Exists(path) if Ltl::new(path).is_some());
    if is_linear || Ctl::new(&formula).is_some() {
        return Ok(formula);
    }
    let message = "assumptions are made for formulas of CTL, and of LTL behind one quantifier";
    Err(Fault::new(span, message).help(
        "put `A` or `E` in front of each of `X`, `F`, `G` and `U`, as in `AG AF p`, or one of \
         them in front of all, as in `A (G F p)`; and leave out limits of time",
    ))
}

pub(super) struct Parser<'t> {
    /// The last of them is the end.
    pub(super) lexemes: &'t [Lexeme<'t>],
    pub(super) at: usize,
    pub(super) names: Names<'t>,
    depth: usize,
    /// Whether a quantifier is around.
    quantified: bool,
    /// How many parts equivalences may still add.
    parts: usize,
}

impl<'t> Parser<'t> {
    pub(super) fn token(&self) -> &'t Token<'t> {
        self.lexemes.get(self.at).map_or(&Token::End, |lexeme| &lexeme.token)
    }

    pub(super) fn span(&self) -> Range<usize> {
        self.lexemes.get(self.at).or(self.lexemes.last()).map_or(0..0, |lexeme| lexeme.span.clone())
    }

    /// Passes one of these symbols or words, if it is next.
    pub(super) fn take(&mut self, spellings: &[&str]) -> bool {
        let (Token::Word(next) | Token::Symbol(next)) = self.token() else { return false };
        let taken = spellings.contains(next);
        self.at += usize::from(taken);
        taken
    }

    pub(super) fn expect(&mut self, symbol: &str) -> Result<(), Fault> {
        if self.take(&[symbol]) {
            Ok(())
        } else {
            Err(self.unexpected(&format!("`{symbol}` is expected")))
        }
    }

    #[cold]
    pub(super) fn unexpected(&self, help: &str) -> Fault {
        let message = match self.token() {
            Token::End => "the text ends too early".to_owned(),
            Token::Word(word) => format!("{} is not expected here", quoted(word)),
            Token::Quoted(name) => format!("the name {} is not expected here", quoted(name)),
            Token::Number(number) => format!("the number {number} is not expected here"),
            Token::Symbol(symbol) => format!("`{symbol}` is not expected here"),
        };
        Fault::new(self.span(), message).help(help)
    }

    fn question(&mut self) -> Result<Question, Fault> {
        let question = if self.take(&["bounds"]) {
            self.bounds()?
        } else if self.take(&["bound"]) {
            self.expect("(")?;
            let (name, span) = self.name("a transition")?;
            let from = self.names.transition(name, span)?;
            self.expect("->")?;
            let (name, span) = self.name("a place")?;
            let to = self.names.place(name, span)?;
            self.expect(")")?;
            Question::Response { from, to }
        } else if self.take(&["live"]) {
            Question::Liveness
        } else if self.take(&["quasi_live"]) {
            Question::QuasiLiveness
        } else if self.take(&["stable"]) {
            Question::StableMarking
        } else if self.take(&["one_safe"]) {
            Question::OneSafe
        } else {
            let start = self.span().start;
            let formula = self.expression(Join::Equivalence)?.formula()?;
            let span = start..self.end();
            if self.take(&["assuming"]) {
                Question::Fair(on_fair_runs(formula, span)?, self.assumptions()?)
            } else {
                Question::Formula(formula)
            }
        };
        match self.token() {
            Token::End => Ok(question),
            _ if matches!(question, Question::Formula(_)) => {
                Err(self.unexpected("join statements with `&`, `|`, `->` or `<->`"))
            }
            _ if matches!(question, Question::Fair(..)) => {
                Err(self.unexpected("assumptions are separated by `,`"))
            }
            _ => Err(self.unexpected("the question ends before this; ask one question at a time")),
        }
    }

    fn assumptions(&mut self) -> Result<Assumptions, Fault> {
        let mut assumed = Assumptions::default();
        loop {
            if self.take(&["weak"]) {
                assumed.weak.extend(self.transitions()?);
            } else if self.take(&["strong"]) {
                assumed.strong.extend(self.transitions()?);
            } else if self.take(&["often"]) {
                self.expect("(")?;
                let start = self.span().start;
                let formula = self.expression(Join::Equivalence)?.formula()?;
                if !formula.is_state() {
                    let fault =
                        Fault::new(start..self.end(), "this speaks of more than one marking");
                    return Err(fault.help("what holds again and again has no temporal operators"));
                }
                self.expect(")")?;
                assumed.often.push(formula);
            } else {
                return Err(
                    self.unexpected("what is assumed is `weak(t)`, `strong(t)` or `often(p)`")
                );
            }
            if !self.take(&[","]) {
                return Ok(assumed);
            }
        }
    }

    fn bounds(&mut self) -> Result<Question, Fault> {
        self.expect("(")?;
        let mut places = Vec::new();
        loop {
            let (name, span) = self.name("a place")?;
            let place = self.names.place(name, span.clone())?;
            if places.contains(&place) {
                let fault =
                    Fault::new(span, format!("the place {} stands twice in one sum", quoted(name)));
                return Err(fault.help("name it once"));
            }
            places.push(place);
            if !self.take(&["+"]) {
                break;
            }
        }
        if !self.take(&[")"]) {
            return Err(self.unexpected("places are joined by `+`, and `)` ends them"));
        }
        Ok(Question::Bound(places))
    }

    pub(super) fn name(&mut self, expected: &str) -> Result<(&'t str, Range<usize>), Fault> {
        let name = match self.token() {
            Token::Word(word) if !is_reserved(word) => *word,
            Token::Quoted(name) => name,
            Token::Word(_) => {
                return Err(
                    self.unexpected("it is a word of the language; put a name like it in quotes")
                );
            }
            _ => return Err(self.unexpected(&format!("the name of {expected} is expected"))),
        };
        let span = self.span();
        self.at += 1;
        Ok((name, span))
    }

    /// What is nested in the next thing: counts how deep.
    pub(super) fn nested<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        if self.depth == MAX_DEPTH {
            let message = format!("operators are nested more than {MAX_DEPTH} deep");
            return Err(Fault::new(self.span(), message).help("ask for its parts one by one"));
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

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

    /// Operands joined by operators that bind at least as tightly.
    pub(super) fn expression(&mut self, loosest: Join) -> Result<Value, Fault> {
        let mut left = self.unary()?;
        while let Some(join) = self.join().filter(|&join| join >= loosest) {
            let (operator, start) = (self.span(), left.span.start);
            if join == Join::Until && !self.quantified {
                return Err(outside("U", operator));
            }
            let formula = match join {
                Join::Until => {
                    let first = left.operand()?;
                    self.at += 1;
                    let second = self.nested(|it| it.expression(Join::Until))?.formula()?;
                    Formula::Until(first.into(), second.into())
                }
                Join::And | Join::Or => {
                    let mut all = vec![left.operand()?];
                    while self.join() == Some(join) {
                        self.at += 1;
                        all.push(self.expression(join.tighter())?.operand()?);
                    }
                    if join == Join::And { Formula::And(all) } else { Formula::Or(all) }
                }
                Join::Implication => {
                    let first = left.operand()?;
                    self.at += 1;
                    let second = self.nested(|it| it.expression(join))?.operand()?;
                    Formula::Or(vec![Formula::Not(first.into()), second])
                }
                Join::Equivalence => {
                    let first = left.operand()?;
                    self.at += 1;
                    let second = self.expression(join.tighter())?.operand()?;
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
        }
        Ok(left)
    }

    /// Where the last word that was passed ends.
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
        let inner = if quantifier.is_some() && temporal.is_none() && self.take(&["["]) {
            let inner = self.nested(|it| it.expression(Join::Equivalence))?.formula()?;
            self.expect("]")?;
            inner
        } else {
            self.nested(Self::unary)?.formula()?
        };
        self.quantified = outer;
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
        Ok(Value::new(What::Formula(formula), span.start..self.end()))
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

fn outside(operator: &str, span: Range<usize>) -> Fault {
    let help = match operator {
        "U" => "write `A[a U b]` or `E[a U b]`".to_owned(),
        _ => format!("write `A{operator}` or `E{operator}`, or `A (...)` around a formula of LTL"),
    };
    Fault::new(span, format!("the temporal operator `{operator}` stands outside of a quantifier"))
        .help(help)
}

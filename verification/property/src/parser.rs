//! From a text of the language to a property.

use super::error::Fault;
use super::lexer::{Lexeme, Token, is_reserved, lexemes};
use super::names::{First, Ids, Names};
use super::value::{Join, Open};
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
        text,
        unclear: None,
    };
    let question = parser.question().map_err(|fault| located(parser.or_a_name(fault)))?;
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
    pub(super) depth: usize,
    /// Whether a quantifier is around.
    pub(super) quantified: bool,
    /// How many parts equivalences may still add.
    pub(super) parts: usize,
    pub(super) text: &'t str,
    /// A quantifier of which it is not clear how far it reaches.
    pub(super) unclear: Option<Open>,
}

impl<'t> Parser<'t> {
    pub(super) fn token(&self) -> &'t Token<'t> {
        self.token_at(self.at)
    }

    pub(super) fn token_at(&self, at: usize) -> &'t Token<'t> {
        self.lexemes.get(at).map_or(&Token::End, |lexeme| &lexeme.token)
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

    /// Whether a question begins here, and no place that is called like one.
    fn asks(&mut self, word: &str) -> Result<bool, Fault> {
        if *self.token() != Token::Word(word) {
            return Ok(false);
        }
        let next = self.token_at(self.at + 1);
        let is_place = self.names.is_place(word);
        if is_place && *next == Token::End {
            return Err(self.in_two_senses(word));
        }
        let asked = !is_place || *next == Token::Symbol("(");
        self.at += usize::from(asked);
        Ok(asked)
    }

    /// A word of the language that is a place, too, where it could be either.
    #[cold]
    pub(super) fn in_two_senses(&self, word: &str) -> Fault {
        let message = format!("`{word}` is a word of the language, and a place");
        let otherwise = match word {
            "deadlock" => "; as a word: `deadlock_free` says that there is none",
            "true" => "; as a word: `0 = 0`",
            "false" => "; as a word: `0 = 1`",
            "live" => "; as a question: `Liveness`",
            "quasi_live" => "; as a question: `QuasiLiveness`",
            "stable" => "; as a question: `StableMarking`",
            "one_safe" => "; as a question: `OneSafe`",
            _ => "",
        };
        let help = format!("put it in quotes if the place is meant: `\"{word}\"`{otherwise}");
        Fault::new(self.span(), message).help(help)
    }

    /// The same fault; with the way to write it where a word that was read as one of the language,
    /// shortly before, is the name of a place as well.
    fn or_a_name(&self, fault: Fault) -> Fault {
        let reached = self.lexemes.iter().take_while(|it| it.span.start <= fault.start()).count();
        let near = self.lexemes[..reached].iter().rev().take(3);
        let name = near.into_iter().find_map(|it| match it.token {
            Token::Word(word) if is_reserved(word) && self.names.is_place(word) => Some(word),
            _ => None,
        });
        match name {
            Some(word)
                if ["not expected", "too early", "there is no "]
                    .iter()
                    .any(|it| fault.says(it)) =>
            {
                let help = format!(
                    "`{word}` is a word of the language, and a place; put it in \
                    quotes if the place is meant: `\"{word}\"`"
                );
                fault.help(help)
            }
            _ => fault,
        }
    }

    fn question(&mut self) -> Result<Question, Fault> {
        let question = if self.asks("bounds")? {
            self.bounds()?
        } else if self.asks("bound")? {
            self.expect("(")?;
            let (name, span) = self.name("a transition")?;
            let from = self.names.transition(name, span)?;
            self.expect("->")?;
            let (name, span) = self.name("a place")?;
            let to = self.names.place(name, span)?;
            self.expect(")")?;
            Question::Response { from, to }
        } else if self.asks("live")? {
            Question::Liveness
        } else if self.asks("quasi_live")? {
            Question::QuasiLiveness
        } else if self.asks("stable")? {
            Question::StableMarking
        } else if self.asks("one_safe")? {
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
            Token::Word(word) if !is_reserved(word) || self.names.is_known(word) => *word,
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

    /// Reads a nested part: counts how deep.
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
}

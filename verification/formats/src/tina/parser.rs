//! Declarations, put on top of each other.

use super::Limits;
use super::error::Finding;
use super::token::{Token, Tokens};
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_property::source::quoted;
use cotama_property::time::{Interval, TimeNet, TimeNetDefect, TimePlace, TimeTransition};
use std::collections::HashMap;

const KEYWORDS: [&str; 6] = ["net", "pl", "tr", "nt", "lb", "pr"];

/// Whether a name without braces would begin a declaration, for readers that do not tell cases
/// apart too.
pub(super) fn is_keyword(word: &str) -> bool {
    KEYWORDS.iter().any(|keyword| keyword.eq_ignore_ascii_case(word))
}

pub(super) fn parse(text: &str, limits: Limits) -> Result<TimeNet, Finding> {
    let mut tokens = Tokens::new(text);
    let (at, token) = tokens.next()?;
    let mut parser = Parser {
        tokens,
        at,
        token,
        limits,
        objects: 0,
        name: String::new(),
        places: Vec::new(),
        place_ids: HashMap::new(),
        transitions: Vec::new(),
        transitions_at: Vec::new(),
        transition_ids: HashMap::new(),
    };
    while parser.token != Token::End {
        parser.declaration()?;
    }
    let Parser { name, places, transitions, transitions_at, .. } = parser;
    TimeNet::new(name, places, transitions).map_err(|defect| match defect {
        TimeNetDefect::Weight(TransitionId(id)) => {
            let message =
                format!("weights of one place at this transition sum to more than {}", u32::MAX);
            Finding::new(transitions_at[id as usize], message)
        }
        other => Finding::new(text.len(), other.to_string()),
    })
}

struct Parser<'t> {
    tokens: Tokens<'t>,
    /// Position of the next token.
    at: usize,
    /// The next token.
    token: Token<'t>,
    limits: Limits,
    objects: usize,
    name: String,
    places: Vec<TimePlace>,
    place_ids: HashMap<String, u32>,
    transitions: Vec<TimeTransition>,
    /// The position at which each is named first.
    transitions_at: Vec<usize>,
    transition_ids: HashMap<String, u32>,
}

impl<'t> Parser<'t> {
    /// The next token and where it starts; the one after it becomes the next.
    fn take(&mut self) -> Result<(usize, Token<'t>), Finding> {
        let (at, token) = self.tokens.next()?;
        Ok((std::mem::replace(&mut self.at, at), std::mem::replace(&mut self.token, token)))
    }

    /// Takes the next token if it is this sign.
    fn sign(&mut self, sign: char) -> Result<bool, Finding> {
        let is = self.token == Token::Sign(sign);
        if is {
            self.take()?;
        }
        Ok(is)
    }

    /// Returns the finding that something else should stand here.
    fn expected(&self, what: &str) -> Finding {
        Finding::new(self.at, format!("{what} is missing before {}", self.token.shown()))
    }

    fn declaration(&mut self) -> Result<(), Finding> {
        match self.take()? {
            (_, Token::Bare("net")) => self.name = self.named("the name of the net")?,
            (_, Token::Bare("pl")) => self.place()?,
            (_, Token::Bare("tr")) => self.transition()?,
            (_, Token::Bare("nt")) => self.note()?,
            (at, Token::Bare("pr")) => {
                return Err(Finding::new(at, "priorities between transitions are not read")
                    .help("leave them out, if the net may do more than it does with them"));
            }
            (at, Token::Bare("lb")) => {
                return Err(Finding::new(at, "`lb` is not read")
                    .help("write the label after the name: `pl a : label`"));
            }
            (at, token) => {
                return Err(Finding::new(at, format!("{} begins no declaration", token.shown()))
                    .help("declarations begin with `net`, `pl`, `tr` or `nt`"));
            }
        }
        Ok(())
    }

    /// A name, if one comes next; a keyword is none.
    fn name(&mut self) -> Result<Option<String>, Finding> {
        let (at, length) = match &self.token {
            Token::Bare(word) if !KEYWORDS.contains(word) => (self.at, word.len()),
            Token::Braced(name) => (self.at, name.len()),
            _ => return Ok(None),
        };
        if length > self.limits.name {
            return Err(Finding::new(
                at,
                format!("a name is longer than {} bytes", self.limits.name),
            ));
        }
        Ok(match self.take()?.1 {
            Token::Bare(word) => Some(word.to_owned()),
            Token::Braced(name) => Some(name.into_owned()),
            _ => None,
        })
    }

    fn named(&mut self, what: &str) -> Result<String, Finding> {
        if let Some(name) = self.name()? {
            return Ok(name);
        }
        let finding = self.expected(what);
        Err(match &self.token {
            Token::Bare(word) => finding.help(format!(
                "`{word}` begins a declaration; as a name it needs braces: `{{{word}}}`"
            )),
            _ => finding,
        })
    }

    fn label(&mut self) -> Result<Option<String>, Finding> {
        if self.sign(':')? { self.named("the label after `:`").map(Some) } else { Ok(None) }
    }

    fn note(&mut self) -> Result<(), Finding> {
        self.named("the name of the note")?;
        if !matches!(self.token, Token::Bare("0" | "1")) {
            return Err(self.expected("`0` or `1`"));
        }
        self.take()?;
        self.named("the text of the note").map(drop)
    }

    /// Counts a place, a transition or an arc.
    fn count(&mut self, at: usize) -> Result<(), Finding> {
        self.objects += 1;
        if self.objects > self.limits.objects {
            return Err(Finding::new(
                at,
                format!("the net has more than {} parts", self.limits.objects),
            ));
        }
        Ok(())
    }

    fn place_named(&mut self, at: usize, name: String) -> Result<u32, Finding> {
        if let Some(&id) = self.place_ids.get(&name) {
            return Ok(id);
        }
        self.count(at)?;
        let id = self.places.len() as u32;
        self.places.push(TimePlace { name: name.clone(), label: None, initial: 0 });
        self.place_ids.insert(name, id);
        Ok(id)
    }

    fn transition_named(&mut self, at: usize, name: String) -> Result<u32, Finding> {
        if let Some(&id) = self.transition_ids.get(&name) {
            return Ok(id);
        }
        self.count(at)?;
        let id = self.transitions.len() as u32;
        self.transitions.push(TimeTransition::new(&name));
        self.transitions_at.push(at);
        self.transition_ids.insert(name, id);
        Ok(id)
    }

    fn place(&mut self) -> Result<(), Finding> {
        let at = self.at;
        let name = self.named("the name of the place")?;
        let id = self.place_named(at, name)? as usize;
        if let Some(label) = self.label()? {
            self.places[id].label = Some(label);
        }
        if self.sign('(')? {
            let at = self.at;
            let tokens = self.number("the number of tokens")?;
            if !self.sign(')')? {
                return Err(self.expected("`)`"));
            }
            let sum = self.places[id].initial.checked_add(tokens);
            self.places[id].initial = sum.ok_or_else(|| {
                Finding::new(
                    at,
                    format!("the markings of this place sum to more than {}", u32::MAX),
                )
            })?;
        }
        let arcs = matches!(self.token, Token::Arrow | Token::Bare(_) | Token::Braced(_))
            && !matches!(self.token, Token::Bare(word) if KEYWORDS.contains(&word));
        if arcs {
            return Err(Finding::new(
                self.at,
                format!("{} does not belong to a place", self.token.shown()),
            )
            .help("arcs stand in `tr` declarations only"));
        }
        Ok(())
    }

    fn transition(&mut self) -> Result<(), Finding> {
        let at = self.at;
        let name = self.named("the name of the transition")?;
        let id = self.transition_named(at, name)? as usize;
        if let Some(label) = self.label()? {
            self.transitions[id].label = Some(label);
        }
        let at = self.at;
        if let Some(interval) = self.interval()? {
            let both = self.transitions[id].interval.intersection(interval);
            if both.is_empty() {
                let message = if interval.is_empty() {
                    format!("the interval {interval} is empty")
                } else {
                    format!("no time lies in {interval} and in the interval given before")
                };
                return Err(Finding::new(at, message));
            }
            self.transitions[id].interval = both;
        }
        let start = self.at;
        self.arcs(id, true)?;
        if self.token == Token::Arrow {
            self.take()?;
            self.arcs(id, false)?;
        } else if self.at != start {
            return Err(self.expected("`->`").help(if self.token == Token::Sign('-') {
                "a name with a hyphen needs braces: `{a-b}`"
            } else {
                "also a transition without outputs has an arrow after its inputs"
            }));
        }
        match self.token {
            Token::Sign('[' | ']' | ':') => {
                Err(Finding::new(self.at, "labels and intervals stand before the arcs"))
            }
            Token::Arrow => Err(Finding::new(self.at, "a transition has one arrow")),
            _ => Ok(()),
        }
    }

    fn interval(&mut self) -> Result<Option<Interval>, Finding> {
        let lower_strict = match self.token {
            Token::Sign('[') => false,
            Token::Sign(']') => true,
            _ => return Ok(None),
        };
        self.take()?;
        let lower = self.bound()?;
        if !self.sign(',')? {
            return Err(self.expected("`,`"));
        }
        let upper = if self.token == Token::Bare("w") {
            self.take()?;
            None
        } else {
            Some(self.bound()?)
        };
        let upper_strict = self.token == Token::Sign('[');
        match (&self.token, upper) {
            (Token::Sign(']'), None) => {
                Err(Finding::new(self.at, "infinity is not a time: its bracket is `[`")
                    .help("write `w[`"))
            }
            (Token::Sign('[' | ']'), _) => {
                self.take()?;
                Ok(Some(Interval { lower, lower_strict, upper, upper_strict }))
            }
            _ => Err(self.expected("`]` or `[`")),
        }
    }

    fn bound(&mut self) -> Result<u64, Finding> {
        let word = match self.token {
            Token::Bare(word) if word.starts_with(|c: char| c.is_ascii_digit()) => word,
            _ => return Err(self.expected("a bound")),
        };
        if !word.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(Finding::new(self.at, format!("{} is not an integer", quoted(word)))
                .help("bounds are written out, without `K` or `M`"));
        }
        let bound =
            word.parse().ok().filter(|&bound| bound <= Interval::LARGEST).ok_or_else(|| {
                Finding::new(
                    self.at,
                    format!("the bound {} is larger than {}", quoted(word), Interval::LARGEST),
                )
            })?;
        self.take()?;
        Ok(bound)
    }

    fn number(&mut self, what: &str) -> Result<u32, Finding> {
        let Token::Bare(word) = self.token else { return Err(self.expected(what)) };
        let digits = word.trim_end_matches(['K', 'M', 'G', 'T', 'P', 'E']);
        let times = match &word[digits.len()..] {
            "" => Some(1),
            "K" => Some(1_000),
            "M" => Some(1_000_000),
            "G" => Some(1_000_000_000),
            "T" => Some(1_000_000_000_000),
            "P" => Some(1_000_000_000_000_000),
            "E" => Some(1_000_000_000_000_000_000),
            _ => None,
        };
        let Some(times) = times
            .filter(|_| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()))
        else {
            return Err(Finding::new(self.at, format!("{} is not a number", quoted(word))));
        };
        let number = digits.parse().ok().and_then(|number: u64| number.checked_mul(times));
        let number = number.and_then(|number| u32::try_from(number).ok()).ok_or_else(|| {
            Finding::new(
                self.at,
                format!("the number {} is larger than {}", quoted(word), u32::MAX),
            )
        })?;
        self.take()?;
        Ok(number)
    }

    /// The inputs or the outputs of a transition.
    fn arcs(&mut self, transition: usize, inputs: bool) -> Result<(), Finding> {
        loop {
            let at = self.at;
            let Some(name) = self.name()? else { return Ok(()) };
            let place = PlaceId(self.place_named(at, name)?);
            let sign = self.at;
            let read = match self.token {
                Token::Sign('*') => false,
                Token::Sign('?') if inputs => true,
                Token::Sign('?') => {
                    return Err(Finding::new(sign, "a read arc is an input")
                        .help("write it before the arrow"));
                }
                Token::Sign('!') => return Err(Finding::new(sign, "stopwatch arcs are not read")),
                _ => {
                    self.arc(transition, at, inputs, false, Arc { place, weight: 1 })?;
                    continue;
                }
            };
            self.take()?;
            if read && self.token == Token::Sign('-') {
                return Err(Finding::new(sign, "inhibitor arcs are not read").help(
                    "for a place with a bound, read the place that holds what it lacks to \
                        its bound",
                ));
            }
            let weight = self.number("the weight of the arc")?;
            self.arc(transition, at, inputs, read, Arc { place, weight })?;
        }
    }

    fn arc(
        &mut self,
        transition: usize,
        at: usize,
        inputs: bool,
        read: bool,
        arc: Arc,
    ) -> Result<(), Finding> {
        self.count(at)?;
        let it = &mut self.transitions[transition];
        match (inputs, read) {
            (false, _) => it.give.push(arc),
            (true, false) => it.take.push(arc),
            (true, true) => it.read.push(arc),
        }
        Ok(())
    }
}

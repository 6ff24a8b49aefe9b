//! The text of a formula, read by descent: sums of products of atoms.

use super::{Inducer, Node, Operation};
use crate::fields::near;
use crate::tree::Fault;

/// A formula has at most so many operations, numbers and inducers.
const MAX_NODES: usize = 128;
/// Brackets and calls are nested at most so deep.
const MAX_DEPTH: usize = 16;

/// A text and how far it has been read.
pub(super) struct Parser<'t> {
    text: &'t str,
    at: usize,
    nodes: usize,
}

impl<'t> Parser<'t> {
    pub(super) const fn new(text: &'t str) -> Self {
        Self { text, at: 0, nodes: 0 }
    }

    /// Reads all of the text.
    pub(super) fn whole(&mut self) -> Result<Node, Fault> {
        let root = self.sum(MAX_DEPTH)?;
        if self.next().is_empty() { Ok(root) } else { Err(self.wrong("this does not belong here")) }
    }

    /// Returns the next word, number or sign, and does not take it; empty at the end.
    fn next(&mut self) -> &str {
        let rest = self.text.get(self.at..).unwrap_or("");
        let trimmed = rest.trim_start_matches(' ');
        self.at += rest.len() - trimmed.len();
        let is_word = |it: char| it.is_ascii_alphanumeric() || it == '_' || it == '.';
        let word = trimmed.find(|it| !is_word(it)).unwrap_or(trimmed.len());
        let first = trimmed.chars().next().map_or(0, char::len_utf8);
        trimmed.get(..word.max(first)).unwrap_or("")
    }

    fn wrong(&self, what: &str) -> Fault {
        Fault::new(self.at, format!("no formula: {what}"))
    }

    fn take(&mut self, sign: &str) -> bool {
        let is = self.next() == sign;
        self.at += if is { sign.len() } else { 0 };
        is
    }

    fn expect(&mut self, sign: &str) -> Result<(), Fault> {
        if self.take(sign) { Ok(()) } else { Err(self.wrong(&format!("`{sign}` is needed here"))) }
    }

    fn node(&mut self, node: Node) -> Result<Node, Fault> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Err(self.wrong(&format!("it has more than {MAX_NODES} parts")));
        }
        Ok(node)
    }

    fn binary(
        &mut self,
        operation: Operation,
        at: usize,
        left: Node,
        right: Node,
    ) -> Result<Node, Fault> {
        self.node(Node::Binary(operation, at, Box::new([left, right])))
    }

    fn sum(&mut self, depth: usize) -> Result<Node, Fault> {
        let mut left = self.product(depth)?;
        loop {
            let (operation, at) = match self.next() {
                "+" => (Operation::Add, self.at),
                "-" => (Operation::Subtract, self.at),
                _ => return Ok(left),
            };
            self.at += 1;
            let right = self.product(depth)?;
            left = self.binary(operation, at, left, right)?;
        }
    }

    fn product(&mut self, depth: usize) -> Result<Node, Fault> {
        let mut left = self.atom(depth)?;
        while self.next() == "*" {
            let at = self.at;
            self.at += 1;
            let right = self.atom(depth)?;
            left = self.binary(Operation::Multiply, at, left, right)?;
        }
        Ok(left)
    }

    fn atom(&mut self, depth: usize) -> Result<Node, Fault> {
        let Some(below) = depth.checked_sub(1) else {
            return Err(self.wrong(&format!("it is nested deeper than {MAX_DEPTH}")));
        };
        if self.take("(") {
            let inner = self.sum(below)?;
            self.expect(")")?;
            return Ok(inner);
        }
        let word = self.next().to_owned();
        let at = self.at;
        if word.starts_with(|it: char| it.is_ascii_digit()) {
            let number = word.parse().map_err(|_| self.wrong("a whole number is needed here"))?;
            self.at += word.len();
            return self.node(Node::Number(number));
        }
        if !word.starts_with(|it: char| it.is_ascii_alphabetic()) {
            return Err(self.wrong("a number, an inducer or `(` is needed here"));
        }
        self.at += word.len();
        if self.take("(") {
            return self.call(&word, at, below);
        }
        let inducer = match word.split_once('.') {
            Some(("robot", key)) => Inducer::Robot(key.to_owned()),
            Some(("laptop", key)) => Inducer::Laptop(key.to_owned()),
            _ => match word.as_str() {
                "length_mm" => Inducer::Length,
                "speed_mm_s" => Inducer::Speed,
                "duration_ms" => Inducer::Duration,
                "motion_mw" => Inducer::MotionPower,
                _ => {
                    let known = "length_mm, speed_mm_s, duration_ms, motion_mw, robot.KEY, \
                         laptop.KEY, option(KEY), hardware(KEY), zone_min(KEY), detector(KEY)";
                    if let Some(near) = near(&word, known.split(", ")) {
                        let fault = Fault::new(at, format!("unknown inducer `{word}`"));
                        return Err(fault.help(format!("did you mean `{near}`?")));
                    }
                    let message = format!("unknown inducer `{word}`");
                    return Err(Fault::new(at, message).help(format!("there are: {known}")));
                }
            },
        };
        self.node(Node::Read(inducer))
    }

    /// Reads what follows a name and a bracket.
    fn call(&mut self, name: &str, at: usize, below: usize) -> Result<Node, Fault> {
        let look_up: Option<fn(String) -> Inducer> = match name {
            "option" => Some(Inducer::Options),
            "hardware" => Some(Inducer::Hardware),
            "zone_min" => Some(Inducer::ZoneMin),
            "detector" => Some(Inducer::Detector),
            _ => None,
        };
        if let Some(inducer) = look_up {
            let key = self.next().to_owned();
            if !key.starts_with(|it: char| it.is_ascii_alphabetic()) {
                return Err(self.wrong("the key of an attribute is needed here"));
            }
            self.at += key.len();
            self.expect(")")?;
            return self.node(Node::Read(inducer(key)));
        }
        let operation = match name {
            "div_down" => Operation::DivideDown,
            "div_up" => Operation::DivideUp,
            "div_near" => Operation::DivideNear,
            "min" => Operation::Least,
            "max" => Operation::Most,
            _ => {
                let known = "div_down, div_up, div_near, min, max, option, hardware, zone_min, \
                     detector";
                let message = format!("unknown function `{name}`");
                return Err(Fault::new(at, message).help(format!("there are: {known}")));
            }
        };
        let mut left = self.sum(below)?;
        self.expect(",")?;
        let right = self.sum(below)?;
        left = self.binary(operation, at, left, right)?;
        while matches!(operation, Operation::Least | Operation::Most) && self.take(",") {
            let right = self.sum(below)?;
            left = self.binary(operation, at, left, right)?;
        }
        self.expect(")")?;
        Ok(left)
    }
}

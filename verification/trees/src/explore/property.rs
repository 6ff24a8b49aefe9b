//! Own properties: what always, sometimes or finally holds of the nodes of a tree.

use super::condition::Condition;
use super::cycles::Marks;
use super::graph::What;
use super::runs::Run;
use super::{Assumptions, Limits, Space};
use crate::diagnostic::nearest;
use crate::machine::{Status, Watched};
use crate::tree::{Answer, NET, Tree};

/// Quantifier of a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Property {
    /// `AG p`: after every tick.
    Always(Condition),
    /// `EF p`: after some tick.
    Sometime(Condition),
    /// `AF p`: at last in every fair run.
    Finally(Condition),
    /// `AG (p -> AF q)`: after each p at last q, in every fair run.
    Follows(Condition, Condition),
}

/// Why a text is no property: the byte and the cause.
pub type Refused = (usize, String);

/// Reads a property: `AG p`, `EF p`, `AF p` or `AG (p -> AF q)`, with `NODE.running`, `.idle`,
/// `.success`, `.failure`, `.skipped`, `.ticked`, `net.PLACE`, `done`, `!`, `&`, `|`, `->` and
/// parentheses; a NODE is a label, or `root`, in double quotes where it has blanks.
///
/// # Errors
///
/// Returns the byte and the cause.
pub fn parse_property(tree: &Tree, text: &str) -> Result<Property, Refused> {
    let mut parser = Parser { tree, text, at: 0, levels: 0 };
    let property = parser.property()?;
    parser.blanks();
    if parser.at < text.len() {
        return Err((parser.at, "nothing is expected here".to_owned()));
    }
    Ok(property)
}

struct Parser<'t> {
    tree: &'t Tree,
    text: &'t str,
    at: usize,
    levels: usize,
}

impl Parser<'_> {
    fn blanks(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn takes(&mut self, sign: &str) -> bool {
        self.blanks();
        let found = self.text[self.at..].starts_with(sign);
        if found {
            self.at += sign.len();
        }
        found
    }

    /// Takes a quantifier, which no letter follows.
    fn word(&mut self, word: &str) -> bool {
        self.blanks();
        let rest = &self.text[self.at..];
        let found = rest.strip_prefix(word).is_some_and(|it| {
            !it.starts_with(|it: char| it.is_alphanumeric() || "._@-".contains(it))
        });
        if found {
            self.at += word.len();
        }
        found
    }

    fn property(&mut self) -> Result<Property, Refused> {
        if self.word("AG") {
            let before = self.at;
            if self.takes("(") {
                let p = self.or()?;
                if self.takes("->") && self.word("AF") {
                    let q = self.or()?;
                    if !self.takes(")") {
                        return Err((self.at, "expected `)`".to_owned()));
                    }
                    return Ok(Property::Follows(p, q));
                }
                self.at = before;
            }
            return self.implied().map(Property::Always);
        }
        if self.word("EF") {
            return self.implied().map(Property::Sometime);
        }
        if self.word("AF") {
            return self.implied().map(Property::Finally);
        }
        let message = "a property begins with AG, EF or AF; `AG (p -> AF q)` is one too";
        Err((self.at, message.to_owned()))
    }

    fn implied(&mut self) -> Result<Condition, Refused> {
        let p = self.or()?;
        if !self.takes("->") {
            return Ok(p);
        }
        let q = self.implied()?;
        Ok(Condition::Or(Box::new(Condition::Not(Box::new(p))), Box::new(q)))
    }

    fn or(&mut self) -> Result<Condition, Refused> {
        let mut left = self.and()?;
        while self.takes("|") {
            self.takes("|");
            left = Condition::Or(Box::new(left), Box::new(self.and()?));
        }
        Ok(left)
    }

    fn and(&mut self) -> Result<Condition, Refused> {
        let mut left = self.not()?;
        while self.takes("&") {
            self.takes("&");
            left = Condition::And(Box::new(left), Box::new(self.not()?));
        }
        Ok(left)
    }

    fn not(&mut self) -> Result<Condition, Refused> {
        self.levels += 1;
        if self.levels > 1_000 {
            return Err((self.at, "more than 1000 operators".to_owned()));
        }
        if self.takes("!") {
            return Ok(Condition::Not(Box::new(self.not()?)));
        }
        if self.takes("(") {
            let inner = self.implied()?;
            if !self.takes(")") {
                return Err((self.at, "expected `)`".to_owned()));
            }
            return Ok(inner);
        }
        self.atom()
    }

    fn atom(&mut self) -> Result<Condition, Refused> {
        self.blanks();
        let begin = self.at;
        let rest = &self.text[begin..];
        let name = if let Some(quoted) = rest.strip_prefix('"') {
            let Some(end) = quoted.find('"') else {
                return Err((begin, "a name without its closing quote".to_owned()));
            };
            self.at += end + 2;
            &quoted[..end]
        } else {
            let ends = |(at, it): (usize, char)| {
                let is_arrow = rest[at..].starts_with("->");
                (!(it.is_alphanumeric() || "_@-".contains(it)) || is_arrow).then_some(at)
            };
            let end = rest.char_indices().find_map(ends).unwrap_or(rest.len());
            self.at += end;
            &rest[..end]
        };
        let is_plain = !self.text[self.at..].starts_with('.');
        match name {
            "" => return Err((begin, "a condition is missing".to_owned())),
            "true" if is_plain => return Ok(Condition::Is(true)),
            "false" if is_plain => return Ok(Condition::Is(false)),
            "done" if is_plain => return Ok(Condition::Done),
            _ => {}
        }
        let node = match self.tree.find(name) {
            Some(node) => node,
            None if name == "root" => 0,
            None if name == NET => return self.place(),
            None => {
                let labels: Vec<_> =
                    (0..self.tree.nodes.len()).map(|it| self.tree.shown(it)).collect();
                let near = nearest(name, labels.iter().map(String::as_str));
                let near = near.map(|it| format!("; did you mean {it}?")).unwrap_or_default();
                return Err((begin, format!("no node {name}{near}")));
            }
        };
        let rest = &self.text[self.at..];
        let words = ["running", "idle", "success", "failure", "skipped", "ticked"];
        let found = rest
            .strip_prefix('.')
            .and_then(|it| words.iter().find(|word| it.starts_with(**word)).copied());
        let Some(word) = found else {
            let message = format!("after {name} stands one of .{}", words.join(", ."));
            return Err((self.at, message));
        };
        self.at += 1 + word.len();
        Ok(match word {
            "running" => Condition::Has(node, Status::Running),
            "idle" => Condition::Has(node, Status::Idle),
            "success" => Condition::Answers(node, Answer::Success),
            "failure" => Condition::Answers(node, Answer::Failure),
            "skipped" => Condition::Answers(node, Answer::Skipped),
            _ => Condition::Ticked(node),
        })
    }
}

impl Parser<'_> {
    /// Reads a place of the supervisor, after `net`.
    fn place(&mut self) -> Result<Condition, Refused> {
        let Some(bonds) = self.tree.bonds.as_deref() else {
            return Err((self.at, "no supervisor is given: --with says which".to_owned()));
        };
        if !self.takes(".") {
            return Err((self.at, "after net stands `.` and a place".to_owned()));
        }
        let begin = self.at;
        let rest = &self.text[begin..];
        let ends = |it: char| !(it.is_alphanumeric() || "_.".contains(it));
        let name = &rest[..rest.find(ends).unwrap_or(rest.len())];
        self.at += name.len();
        let places = &bonds.net.places;
        if let Some(place) = places.iter().position(|it| it == name) {
            return Ok(Condition::Marked(place));
        }
        let near = nearest(name, places.iter().map(String::as_str));
        let near = near.map(|it| format!("; did you mean {it}?")).unwrap_or_default();
        Err((begin, format!("no place {name}{near}")))
    }
}

/// Knowledge of a property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Whether it holds; `None` where a limit was met.
    pub holds: Option<bool>,
    /// The run that shows it, with the fewest ticks.
    pub run: Option<Run>,
    /// States explored.
    pub states: usize,
}

/// Answers a property of a tree.
pub fn check_property(
    tree: &Tree,
    property: &Property,
    skips: bool,
    assumptions: Assumptions,
    limits: Limits,
) -> Verdict {
    let mut watched = Watched::default();
    match property {
        Property::Always(p) | Property::Sometime(p) | Property::Finally(p) => {
            p.watched(&mut watched);
        }
        Property::Follows(p, q) => {
            p.watched(&mut watched);
            q.watched(&mut watched);
        }
    }
    let mut space = Space::watching(tree, skips, assumptions, &watched, limits);
    let states = space.size().0;
    let complete = space.is_complete();
    let (found, wanted) = match property {
        Property::Always(p) => (space.first_where(p, false), false),
        Property::Sometime(p) => (space.first_where(p, true), true),
        Property::Finally(q) => {
            let begins = vec![0];
            (space.never_after(begins, q), false)
        }
        Property::Follows(p, q) => {
            let points = (1..space.len() as u32).collect::<Vec<_>>();
            let begins = points.into_iter().filter(|it| space.holds_at(*it, p) == Some(true));
            let begins: Vec<_> = begins.collect();
            (space.never_after(begins, q), false)
        }
    };
    let holds = match found {
        Some(_) => Some(wanted),
        None if complete => Some(!wanted),
        None => None,
    };
    Verdict { holds, run: found, states }
}

impl Space<'_> {
    /// Returns whether a condition holds at a state or an end; `None` within a tick.
    fn holds_at(&mut self, point: u32, condition: &Condition) -> Option<bool> {
        let is_end = match self.what(point as usize) {
            What::Asks(_) => return None,
            What::State => false,
            What::End(_) => true,
        };
        self.at(point as usize);
        Some(condition.holds(&self.machine, is_end))
    }

    /// Returns a run to the first point after a tick at which a condition is so.
    fn first_where(&mut self, condition: &Condition, wanted: bool) -> Option<Run> {
        let points =
            (1..self.len() as u32).filter(|it| !matches!(self.what(*it as usize), What::Asks(_)));
        let mut points: Vec<_> = points.collect();
        points.sort_by_key(|it| self.level[*it as usize]);
        let found = points.into_iter().find(|it| self.holds_at(*it, condition) == Some(wanted));
        found.map(|it| self.run_at(it as usize))
    }

    /// Returns a fair run from one of the points on which a condition never holds.
    fn never_after(&mut self, begins: Vec<u32>, condition: &Condition) -> Option<Run> {
        let mut via: Vec<Option<(u32, u32)>> = vec![None; self.len()];
        let mut known = vec![false; self.len()];
        let mut points: Vec<u32> = Vec::new();
        for begin in begins {
            if begin == 0 || self.holds_at(begin, condition) == Some(false) {
                known[begin as usize] = true;
                points.push(begin);
            }
        }
        let mut at = 0;
        while at < points.len() {
            let point = points[at];
            at += 1;
            if matches!(self.what(point as usize), What::End(_)) {
                return Some(self.run_from(point, &via));
            }
            for edge in self.out(point as usize) {
                let target = self.edges[edge].target;
                if known[target as usize] || self.holds_at(target, condition) == Some(true) {
                    continue;
                }
                known[target as usize] = true;
                via[target as usize] = Some((point, edge as u32));
                points.push(target);
            }
        }
        let mut marks = Marks::new(self.len());
        let keep = |space: &Space, edge: usize| known[space.edges[edge].target as usize];
        let circles = self.components(&points, &keep, &mut marks);
        let circle = circles.iter().find_map(|it| self.fair(it, &keep, None, &mut marks))?;
        let walk = self.walk(&circle);
        let first = *walk.first()?;
        let start = circle.edges.iter().find(|it| it.1 as usize == first)?.0;
        let mut run = self.run_from(start, &via);
        let from = run.steps.len();
        run.steps.extend(self.run_along(&walk).steps);
        run.again_from = Some(from);
        Some(run)
    }

    /// Returns the run to a point: the shortest to where the search began, then its way.
    fn run_from(&self, point: u32, via: &[Option<(u32, u32)>]) -> Run {
        let (mut path, mut at) = (Vec::new(), point);
        while let Some((before, edge)) = via[at as usize] {
            path.push(edge as usize);
            at = before;
        }
        path.reverse();
        let mut run = self.run_at(at as usize);
        run.steps.extend(self.run_along(&path).steps);
        run
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reader::read_text;

    fn tree() -> Tree {
        let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
          <ReactiveSequence><C1/><A1/></ReactiveSequence></BehaviorTree></root>"#;
        read_text(text).unwrap().tree
    }

    fn verdict(text: &str) -> (Option<bool>, Option<usize>) {
        let tree = tree();
        let property = parse_property(&tree, text).unwrap_or_else(|it| panic!("{text}: {it:?}"));
        let limits = Limits::default();
        let found = check_property(&tree, &property, false, Assumptions::default(), limits);
        (found.holds, found.run.map(|it| it.steps.len()))
    }

    #[test]
    fn always_sometime_and_finally_are_told_apart() {
        assert_eq!(verdict("AG !(A1.running & C1.failure)"), (Some(true), None));
        assert_eq!(verdict("AG !A1.running"), (Some(false), Some(1)));
        assert_eq!(verdict("EF root.success"), (Some(true), Some(1)));
        assert_eq!(verdict("EF (A1.success & C1.failure)"), (Some(false), None));
        assert_eq!(verdict("AF done"), (Some(true), None));
        assert_eq!(verdict("AF root.success"), (Some(false), Some(1)));
        assert_eq!(verdict("AG (A1.running -> AF done)"), (Some(true), None));
        assert_eq!(verdict("AG (A1.running -> C1.success)"), (Some(true), None));
    }

    #[test]
    fn a_misspelt_node_is_told_with_the_nearest() {
        let tree = tree();
        let refused = parse_property(&tree, "AG !A11.running").unwrap_err();
        assert_eq!(refused, (4, "no node A11; did you mean A1?".to_owned()));
        assert!(parse_property(&tree, "A1.running").is_err());
        assert!(parse_property(&tree, "AG (A1.running").is_err());
        assert!(parse_property(&tree, "AG A1.flying").is_err());
    }
}

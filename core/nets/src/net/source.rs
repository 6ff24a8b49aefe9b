//! The source that `net!` read, before names are looked up: the start of the path from text to
//! [`Net`](super::Net).

use super::data::Signal;
use super::text::{Text, same};

/// A net as it was written.
#[derive(Clone, Copy, Debug)]
pub struct Source<'n> {
    /// The name of the module.
    pub name: &'n str,
    /// Documentation of the net.
    pub doc: &'n str,
    /// `places`.
    pub places: &'n [Declared<'n>],
    /// `flags`.
    pub flags: &'n [Declared<'n>],
    /// `counters`.
    pub counters: &'n [Declared<'n>],
    /// `shared`.
    pub shared: &'n [Declared<'n>],
    /// `events`.
    pub events: &'n [Signal<'n>],
    /// `outputs`.
    pub outputs: &'n [Signal<'n>],
    /// `groups`.
    pub groups: &'n [Group<'n>],
    /// `transitions`.
    pub lines: &'n [Line<'n>],
    /// `ignore`.
    pub ignored: &'n [Ignore<'n>],
    /// `laws`.
    pub laws: &'n [Claim<'n>],
}

/// A place, a flag, a counter or a shared place.
#[derive(Clone, Copy, Debug)]
pub struct Declared<'n> {
    /// Name of the place or data.
    pub name: &'n str,
    /// Documentation of the place or data.
    pub doc: &'n str,
    /// Tokens at the start.
    pub initial: u64,
    /// The most tokens.
    pub bound: u64,
}

/// A name for several places.
#[derive(Clone, Copy, Debug)]
pub struct Group<'n> {
    /// Name of the group.
    pub name: &'n str,
    /// The places of the group.
    pub members: &'n [&'n str],
}

/// A line of `transitions`.
#[derive(Clone, Copy, Debug)]
pub struct Line<'n> {
    /// Name of the line.
    pub name: &'n str,
    /// Documentation of the line.
    pub doc: &'n str,
    /// The event; empty without one.
    pub on: &'n str,
    /// The guard, all of which must hold.
    pub guard: &'n [Test<'n>],
    /// Places, or a group, and weights; `_` is nothing.
    pub take: &'n [(&'n str, u64)],
    /// Places and weights; `_` is nothing.
    pub give: &'n [(&'n str, u64)],
    /// Places and weights that must be there and stay.
    pub read: &'n [(&'n str, u64)],
    /// Changes of flags, counters and shared places.
    pub changes: &'n [Change<'n>],
    /// Outputs.
    pub emits: &'n [&'n str],
    /// First and last instant, in milliseconds.
    pub within: Option<(u64, Option<u64>)>,
    /// Priority.
    pub priority: i64,
}

/// A line of `ignore`.
#[derive(Clone, Copy, Debug)]
pub struct Ignore<'n> {
    /// The event.
    pub event: &'n str,
    /// Places and groups.
    pub places: &'n [&'n str],
    /// The guard, all of which must hold.
    pub guard: &'n [Test<'n>],
}

/// One condition of a guard: a place, flag, counter or shared place compared with a number.
#[derive(Clone, Copy, Debug)]
pub struct Test<'n> {
    /// Name of the place or data compared.
    pub name: &'n str,
    /// The comparison.
    pub relation: Relation,
    /// The number compared with.
    pub value: u64,
}

/// How a guard compares.
#[derive(Clone, Copy, Debug)]
pub enum Relation {
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `==`
    Equal,
    /// `>=`
    AtLeast,
    /// `>`
    More,
}

/// A change of a flag, a counter or a shared place.
#[derive(Clone, Copy, Debug)]
pub struct Change<'n> {
    /// Name of the place or data changed.
    pub name: &'n str,
    /// The change.
    pub by: By,
}

/// How a value changes.
#[derive(Clone, Copy, Debug)]
pub enum By {
    /// `+=`
    Add(u64),
    /// `-=`
    Subtract(u64),
    /// `=`
    Become(u64),
}

/// A line of `laws`.
#[derive(Clone, Copy, Debug)]
pub enum Claim<'n> {
    /// `invariant(A & B * 2 = 1)`
    Invariant(&'n [(&'n str, u64)], u64),
    /// `never_both(A, B)`
    NeverBoth(&'n str, &'n str),
    /// `reachable(A)`
    Reachable(&'n str),
    /// `always_can(A)`
    AlwaysCan(&'n str),
    /// `handles(all)`
    HandlesAll,
    /// `settles`
    Settles,
    /// `deadlock_free`, or `deadlock_free_except(A)`; empty without a place.
    DeadlockFree(&'n str),
    /// `deterministic`
    Deterministic,
    /// `left_to_checker`: too large to be explored while compiling.
    LeftToChecker,
}

impl Source<'_> {
    /// Whether the laws are left to the checker.
    pub const fn left_to_checker(&self) -> bool {
        let mut at = 0;
        while at < self.laws.len() {
            if let Claim::LeftToChecker = self.laws[at] {
                return true;
            }
            at += 1;
        }
        false
    }
}

/// The documentation without the blanks around it.
pub const fn doc(text: &str) -> &str {
    text.trim_ascii()
}

/// The source that `net!` keeps. It is implemented outside of the module that `net!` makes, so that
/// numbers can be constants of an enclosing function.
pub trait Written {
    /// The net as it was written.
    const SOURCE: Source<'static>;
}

/// A net and the part of it that a number belongs to.
pub type Part<'n> = (&'n str, &'n str);

const fn at_part(of: Part<'_>) -> Text {
    Text::new().with("net ").name(of.0).with(", ").name(of.1).with(": ")
}

/// A number from 0 up.
#[track_caller]
pub const fn number(of: Part<'_>, number: i128) -> u64 {
    if number < 0 {
        at_part(of)
            .with("the number -")
            .number(saturated(number.unsigned_abs()))
            .with(" is negative; only priorities can be")
            .stop();
    }
    saturated(number.unsigned_abs())
}

const fn saturated(number: u128) -> u64 {
    if number > u64::MAX as u128 { u64::MAX } else { number as u64 }
}

/// A place with the first of each list of numbers: what was written, or what stands for nothing.
#[track_caller]
pub const fn declared<'n>(
    of: Part<'n>,
    text: &'n str,
    initial: &[i128],
    bound: &[i128],
) -> Declared<'n> {
    Declared {
        name: of.1,
        doc: doc(text),
        initial: number(of, initial[0]),
        bound: number(of, bound[0]),
    }
}

/// An event or output.
pub const fn signal<'n>(name: &'n str, text: &'n str) -> Signal<'n> {
    Signal { name, doc: doc(text) }
}

/// The interval that was written for a transition.
#[track_caller]
pub const fn interval(of: Part<'_>, written: &[(u64, Option<u64>)]) -> Option<(u64, Option<u64>)> {
    match written {
        [] => None,
        [interval] => Some(*interval),
        _ => Text::new()
            .with("net ")
            .name(of.0)
            .with(", transition ")
            .name(of.1)
            .with(": it has two intervals; say either `within` or `after`")
            .stop(),
    }
}

/// The priority that was written, or what stands for nothing.
pub const fn priority(numbers: &[i128]) -> i64 {
    let number = numbers[0];
    if number > i64::MAX as i128 {
        i64::MAX
    } else if number < i64::MIN as i128 {
        i64::MIN
    } else {
        number as i64
    }
}

/// Ends the compilation when an extension replaces a line that the net does not have.
#[track_caller]
pub const fn replaced(source: &Source<'_>, names: &[&str]) {
    let mut at = 0;
    while at < names.len() {
        let mut line = 0;
        while line < source.lines.len() && !same(source.lines[line].name, names[at]) {
            line += 1;
        }
        if line == source.lines.len() {
            Text::new()
                .with("net ")
                .name(source.name)
                .with(" has no transition ")
                .name(names[at])
                .with(" that an extension could replace")
                .stop()
        }
        at += 1;
    }
}

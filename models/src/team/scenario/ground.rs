//! A team on a floor: the names that its file asks a floor for, and what the floor answers.
//!
//! A file says `floor = "office"`, or has a table `[floor]` with `on = "office"`. [`Asked::of`]
//! reads the names, whoever has the floor plans the [`Ways`] between them, and the reader of teams
//! makes lengths and tracks of them.

use super::{FORMAT, MANY, MAX_ROBOTS};
use crate::missions::reader::fields::{Fields, Sink, document_of_either};
use crate::missions::{Leg, NoLeg, Refusal};
use std::sync::Arc;

/// The most places of a team on a floor whose file names no ways: each pair is planned.
pub const MOST_PAIRED: usize = 32;
/// The most ways that are planned on a floor.
pub const MOST_PLANNED: usize = 1_000;

/// The names that a team asks a floor for.
///
/// ```
/// use cotama_models::team::scenario::Asked;
/// let text = r#"
/// format = "cotama-team/1"
/// floor = "office"
/// robot = [{ name = "anna", at = "dock" }]
/// task = [{ name = "parcel", from = "store", to = "lab" }]
/// "#;
/// let asked = Asked::of(text).unwrap();
/// assert_eq!((asked.floor.as_str(), asked.places.join(" ")), ("office", "dock store lab".into()));
/// assert_eq!(asked.pairs(), [(0, 1), (0, 2), (1, 2)]);
/// assert_eq!(Asked::of(&text.replace("floor", "# floor")), None);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// The floor: a name, or the path of a file.
    pub floor: String,
    /// The places of the team: those that `[floor]` lists, or else those that robots, tasks and
    /// roles name, each once, in this order.
    pub places: Vec<String>,
    /// The ways that the file names, between the numbers of places; none where each place leads to
    /// each.
    pub ways: Vec<(usize, usize)>,
    /// Doors that are open, other than the floor says.
    pub open: Vec<String>,
    /// Doors that are closed.
    pub close: Vec<String>,
}

impl Asked {
    /// Reads the names; `None` of a team that names no floor. Values that are no names are left
    /// out: the reader of teams reports them.
    pub fn of(text: &str) -> Option<Self> {
        document_of_either(text, &Sink::default(), FORMAT, |mut fields| {
            if !fields.is_table("floor") {
                let floor = fields.optional_text("floor").ok()??.value;
                return Some(Self { floor, places: named(&mut fields), ..Self::default() });
            }
            let mut floor = fields.table("floor")?;
            let on = floor.optional_text("on").ok()??.value;
            let mut words = |key| {
                let all = floor.optional_texts(key).unwrap_or_default();
                all.into_iter().map(|it| it.value).collect::<Vec<_>>()
            };
            let [places, open, close] = ["places", "open", "close"].map(&mut words);
            let places = if places.is_empty() { named(&mut fields) } else { places };
            let ways = floor.tables_up_to("way", false, MOST_PLANNED).unwrap_or_default();
            let number = |name: &str| places.iter().position(|it| it == name);
            let way = |mut fields: Fields<'_>| match &fields.texts("between")?[..] {
                [a, b] => Some((number(&a.value)?, number(&b.value)?)),
                _ => None,
            };
            let ways = ways.into_iter().filter_map(way).collect();
            Some(Self { floor: on, places, ways, open, close })
        })
    }

    /// Returns the pairs of places between which ways are asked for: each once, the smaller number
    /// first, in the order of numbers.
    pub fn pairs(&self) -> Vec<(usize, usize)> {
        let count = self.places.len();
        let mut pairs: Vec<_> = if !self.ways.is_empty() {
            self.ways.iter().map(|&(a, b)| (a.min(b), a.max(b))).filter(|it| it.0 < it.1).collect()
        } else if count <= MOST_PAIRED {
            (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect()
        } else {
            Vec::new()
        };
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}

/// The places that robots, tasks and roles name.
fn named(fields: &mut Fields<'_>) -> Vec<String> {
    let mut places = Vec::new();
    let mut add = |name: Option<crate::missions::Spanned<String>>| {
        if let Some(name) = name.map(|it| it.value).filter(|it| !places.contains(it)) {
            places.push(name);
        }
    };
    for mut robot in fields.tables_up_to("robot", false, MAX_ROBOTS).unwrap_or_default() {
        add(robot.text("at"));
    }
    for mut task in fields.tables_up_to("task", false, MANY).unwrap_or_default() {
        ["from", "to"].into_iter().for_each(|key| add(task.text(key)));
        for mut plan in task.tables("plan", false).unwrap_or_default() {
            for mut role in plan.tables("role", false).unwrap_or_default() {
                for key in ["take", "give"] {
                    let end = role.is_table(key).then(|| role.table(key)).flatten();
                    let Some(mut end) = end else { continue };
                    let at = if end.has("words_at") { "words_at" } else { "partner_at" };
                    add(end.text(at));
                }
            }
        }
    }
    places
}

/// The ways of a team over a floor, or the reasons why there are none: an answer to each name that
/// is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ways {
    /// The name of the floor's file, as in messages.
    pub source: String,
    /// The whole text of the file.
    pub text: Arc<str>,
    /// The names that this is the answer to.
    pub asked: Asked,
    /// The problem of the doors, if there is one.
    pub doors: Result<(), Refusal>,
    /// The position of each place of [`Asked::places`], in mm from the left lower corner of the
    /// floor.
    pub places: Vec<Result<[i32; 2], Refusal>>,
    /// The way of each pair of [`Asked::pairs`].
    pub legs: Vec<Result<Leg, NoLeg>>,
}

impl Ways {
    /// Returns the way between two places, by their numbers.
    pub(super) fn leg(&self, a: usize, b: usize) -> Option<&Result<Leg, NoLeg>> {
        let at = self.asked.pairs().binary_search(&(a.min(b), a.max(b))).ok()?;
        self.legs.get(at)
    }

    /// Returns the reason against each place, if there is one: the floor has none of this name, or
    /// nothing leads there from most of the others.
    pub(super) fn refused(&self) -> Vec<Option<Refusal>> {
        let mut refused: Vec<_> = self.places.iter().map(|it| it.clone().err()).collect();
        if !self.asked.ways.is_empty() {
            // Each way that is named is told by itself.
            return refused;
        }
        let mut part: Vec<usize> = (0..self.places.len()).collect();
        let pairs = self.asked.pairs();
        for (&(a, b), leg) in pairs.iter().zip(&self.legs) {
            if leg.is_ok() && part[a] != part[b] {
                let [kept, joined] = [part[a].min(part[b]), part[a].max(part[b])];
                part.iter_mut().filter(|it| **it == joined).for_each(|it| *it = kept);
            }
        }
        let size = |of: usize| part.iter().filter(|it| **it == of).count();
        let good = || (0..part.len()).filter(|it| self.places[*it].is_ok());
        let Some(main) = good().max_by_key(|it| (size(part[*it]), std::cmp::Reverse(*it))) else {
            return refused;
        };
        for place in good().filter(|it| part[*it] != part[main]) {
            let leg = self.leg(place, main).and_then(|it| it.as_ref().err());
            refused[place] = leg.and_then(|it| match it {
                // The floor as a whole is refused once.
                NoLeg::Floor(_) => None,
                it => it.refusal("open"),
            });
        }
        refused
    }

    /// Returns the reason against the floor as a whole, if there is one.
    pub(super) fn unusable(&self) -> Option<&Refusal> {
        self.legs.iter().find_map(|it| match it {
            Err(NoLeg::Floor(why)) => Some(why),
            _ => None,
        })
    }
}

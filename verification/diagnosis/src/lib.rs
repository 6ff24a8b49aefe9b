//! The explanation of a verdict for a person: the shortest trace, the cause, and the changes of
//! each step.
//!
//! | item | what it is |
//! | --- | --- |
//! | [`Diagnosis`] | why a property holds or does not, shown by a run; as text, JSON, HTML |
//! | [`shrink`] | the same counterexample with fewer firings |
//! | [`vacuous`] | questions that tell whether a property holds for a reason that is none |
//! | [`Unused`] | transitions that never fire, places that are never marked |
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_core::net::TransitionId;
//! use cotama_verification::diagnosis::{Case, Diagnosis, Run};
//! use cotama_verification::{property, pt::Pt};
//!
//! let mut net = OwnedNet::new("valve", "");
//! let [shut, open] =
//!     [("shut", 1), ("open", 0)].map(|it| net.place(OwnedPlace::new(it.0, it.1)).unwrap());
//! net.transition(OwnedTransition::new("turn").take(shut, 1).give(open, 1)).unwrap();
//! let pt = Pt::from(&net.view().net());
//! let property = property::parse("AG !open", &pt).unwrap();
//! let run = Run::to(vec![TransitionId(0)]);
//! let diagnosis = Diagnosis::new(&Case::new(&pt, &property, false, &run)).unwrap();
//! assert_eq!(diagnosis.summary, "`AG !open` does not hold: after 1 firing `open` is marked.");
//! assert_eq!(diagnosis.cause, "`turn` fired: it marked `open`.");
//! ```

mod cause;
mod claim;
mod html;
mod mirror;
mod picture;
mod question;
mod run;
mod sheet;
mod shrink;
mod step;
mod story;
mod text;
mod timeline;
mod unused;
mod vacuity;
mod words;

pub use cotama_property::run::{NotARun, Run};
pub use shrink::shrink;
pub use step::{AtomTrack, Change, Meaning, Step, Tokens, Track, Turn};
pub use unused::{Never, Unused};
pub use vacuity::{Vacuity, Variants, vacuous};

use claim::Along;
use cotama_core::net::{Net, TransitionId};
use cotama_property::pt::Pt;
use cotama_property::schedule::{Date, Schedule};
use cotama_property::{self as property, Atom, Condition, Formula, Linear, Property, Question};
use picture::Picture;
use serde::Serialize;
use std::collections::BTreeSet;

/// The most places whose tokens are followed.
const WATCHED: usize = 24;

/// The most firings of a run that is explained, and places and transitions that are looked at in
/// all its markings.
const FIRINGS: usize = 100_000;
const LOOKS: usize = 1 << 28;

/// The most atoms that are followed.
const ATOMS: usize = 200;

/// A verdict to be explained.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// The net that was checked.
    pub pt: &'a Pt,
    /// The property asked.
    pub property: &'a Property,
    /// The verdict; true for a bound, and for a time of response.
    pub holds: bool,
    /// The run that shows it: a counterexample, or a witness.
    pub run: &'a Run,
    /// The net with its events, outputs and documentation, if that is known: with the same places
    /// and transitions.
    pub net: Option<&'a Net<'a>>,
    /// When each firing happens, in milliseconds, if that is known.
    pub schedule: Option<&'a Schedule>,
}

impl<'a> Case<'a> {
    /// A case of which no more is known.
    pub fn new(pt: &'a Pt, property: &'a Property, holds: bool, run: &'a Run) -> Self {
        Self { pt, property, holds, run, net: None, schedule: None }
    }

    /// The same with events, outputs and documentation.
    #[must_use]
    pub fn with_net(self, net: &'a Net<'a>) -> Self {
        Self { net: Some(net), ..self }
    }

    /// The same with dates.
    #[must_use]
    pub fn with_schedule(self, schedule: &'a Schedule) -> Self {
        Self { schedule: Some(schedule), ..self }
    }
}

/// Why a property holds or does not, shown by a run.
///
/// It is written as text by `Display`, in lines of at most 100 characters, or as many as the
/// precision says (`{:.58}`), with the middle of a long run left out; by [`json`](Self::json)
/// whole; by [`html`](Self::html) as a page with pictures; by [`svg`](Self::svg) as one drawing.
/// Names in sentences stand in backticks.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::check::{Options, report};
/// let net = philosophers(2).unwrap();
/// let report = report(&net, &["AG !deadlock"], &Options::default()).unwrap();
/// let (property, answer) = &report.rows()[0];
/// let diagnosis = report.diagnosis(property, answer).unwrap();
/// assert_eq!((diagnosis.trace.len(), diagnosis.deadlock), (2, true));
/// assert!(diagnosis.json().contains("\"deadlock\": true"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Diagnosis {
    /// The name of the net.
    pub net: String,
    /// Purpose of the net; empty when it is not known.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub doc: String,
    /// The name of the property; its text, if it has no other.
    pub name: String,
    /// The property in the language of properties.
    pub property: String,
    /// The verdict.
    pub holds: bool,
    /// The verdict in one sentence.
    pub summary: String,
    /// How it came about, in one line; empty when there is nothing to say.
    pub cause: String,
    /// Notes to be added, a sentence each.
    pub notes: Vec<String>,
    /// The marked places of the initial marking.
    pub initial: Vec<Tokens>,
    /// The firings, those that repeat for ever once.
    pub trace: Vec<Step>,
    /// How many firings are before the first one that repeats for ever, if some do.
    pub cycle_starts_at: Option<usize>,
    /// Whether nothing can fire in the end.
    pub deadlock: bool,
    /// The marked places of the last marking.
    #[serde(rename = "final")]
    pub last: Vec<Tokens>,
    /// Places that the property or the cause speaks of.
    pub watched: Vec<Track>,
    /// The atoms of the property, each with its truth at every marking: the first 200 of them.
    pub atoms: Vec<AtomTrack>,
    /// Meanings of places and transitions of the run, as far as they are documented.
    pub legend: Vec<Meaning>,
    /// Complements that the property does not name: text and pages leave them out.
    #[serde(skip)]
    mirrors: BTreeSet<String>,
    #[serde(skip)]
    picture: Option<Picture>,
}

impl Diagnosis {
    /// Explains a verdict by a run.
    ///
    /// # Errors
    /// When the run is none of the net, or the net or the dates do not belong to it; or when it is
    /// too long to be explained.
    pub fn new(case: &Case<'_>) -> Result<Self, NotARun> {
        let Case { pt, property, holds, run, net, schedule } = *case;
        let names = |net: &Net<'_>| {
            net.places.iter().map(|it| it.name).eq(pt.places.iter().map(String::as_str))
                && net
                    .transitions
                    .iter()
                    .map(|it| it.name)
                    .eq(pt.transitions.iter().map(String::as_str))
        };
        if net.is_some_and(|net| !names(net)) {
            return Err(NotARun::Net);
        }
        let looks = run.len().saturating_mul(pt.places.len() + pt.transitions.len());
        if run.len() > FIRINGS || looks > LOOKS {
            return Err(NotARun::TooLong { firings: run.len() });
        }
        if schedule.is_some_and(|it| !it.steps.iter().map(|step| step.transition).eq(run.firings()))
        {
            return Err(NotARun::Dates);
        }
        let mut last = pt.initial.clone();
        let mut trace = Vec::with_capacity(run.len());
        let fired: Vec<_> = run.firings().collect();
        run.walk(pt, |at, marking| {
            if let Some(firing) = at.checked_sub(1) {
                trace.push(step(case, firing, fired[firing].0, &last, marking));
                last.copy_from_slice(marking);
            }
        })?;
        let dates: Vec<Date> =
            schedule.into_iter().flat_map(|it| &it.steps).map(|it| it.date).collect();
        let story = story::told(case, Along { pt, run, dates: &dates });
        // As it was typed, if it was: the parser keeps no arrows.
        let typed =
            property::parse(&property.name, pt).is_ok_and(|it| it.question == property.question);
        let text = if typed {
            property.name.trim().to_owned()
        } else {
            property.question.display(pt).to_string()
        };
        let summary = summary(property, holds, &text, &story.what);
        let atoms = atoms(case, &mut trace)?;
        let mirrored = mirror::mirrored(case);
        let watched = watched(property, &story, pt, &mirrored);
        let mut tracks: Vec<Track> = watched
            .iter()
            .map(|it| Track {
                place: pt.places[*it as usize].clone(),
                tokens: Vec::with_capacity(run.len() + 1),
            })
            .collect();
        run.walk(pt, |_, marking| {
            watched
                .iter()
                .zip(&mut tracks)
                .for_each(|(it, track)| track.tokens.push(marking[*it as usize]));
        })?;
        Ok(Self {
            net: pt.name.clone(),
            doc: net.map_or_else(String::new, |it| it.doc.trim().to_owned()),
            name: property.name.clone(),
            property: text,
            holds,
            summary,
            cause: story.cause,
            notes: story.notes,
            initial: tokens(pt, &pt.initial),
            legend: net.map_or_else(Vec::new, |net| legend(net, pt, run, &watched, &trace)),
            trace,
            cycle_starts_at: run.cycle_start(),
            deadlock: run::enabled(pt, &last).next().is_none(),
            last: tokens(pt, &last),
            watched: tracks,
            atoms,
            mirrors: {
                let all = pt.places.iter().zip(&mirrored).filter(|it| it.1.is_some());
                all.map(|it| it.0.clone()).collect()
            },
            picture: Picture::new(pt, net, &last, run.firings().last().as_slice(), &story.culprits),
        })
    }

    /// Whether text and pages show what is said of a place.
    fn shows(&self, place: &str) -> bool {
        !self.mirrors.contains(place)
    }

    /// The atoms that a step turns and that are more than marked places.
    fn turns<'s>(&'s self, step: &'s Step) -> impl Iterator<Item = &'s Turn> {
        let is_more =
            |turn: &&Turn| self.atoms.iter().any(|it| it.atom == turn.atom && !it.is_mark);
        step.turns.iter().filter(is_more)
    }

    /// All of it as JSON, in lines.
    pub fn json(&self) -> String {
        // Strings and numbers always have a form in JSON.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}

fn summary(property: &Property, holds: bool, text: &str, what: &str) -> String {
    let text = words::ticked(text);
    match property.question {
        Question::Bound(_) | Question::Response { .. } => format!("{text}: {what}."),
        _ if holds => format!("{text} holds: {what}."),
        _ => format!("{text} does not hold: {what}."),
    }
}

fn tokens(pt: &Pt, marking: &[u32]) -> Vec<Tokens> {
    let marked = pt.places.iter().zip(marking).filter(|it| *it.1 > 0);
    marked.map(|(place, &tokens)| Tokens { place: place.clone(), tokens }).collect()
}

/// The places that a firing can change, each once.
fn touched(pt: &Pt, transition: u32) -> impl Iterator<Item = u32> + '_ {
    let effects = pt.effects.of(transition);
    let resets = pt.resets(transition).iter().map(|it| it.0);
    let others = resets.filter(|it| effects.iter().all(|effect| effect.0 != *it));
    effects.iter().map(|it| it.0).chain(others)
}

fn step(case: &Case<'_>, firing: usize, transition: u32, before: &[u32], after: &[u32]) -> Step {
    let of_net = case.net.and_then(|net| Some((net, net.transitions.get(transition as usize)?)));
    let changed = touched(case.pt, transition).map(|it| it as usize);
    let changed = changed.filter(|&at| before[at] != after[at]);
    Step {
        transition: case.pt.transitions[transition as usize].clone(),
        event: of_net
            .and_then(|(net, it)| Some(net.events.get(it.on?.0 as usize)?.name.to_owned())),
        outputs: of_net.map_or_else(Vec::new, |(net, it)| {
            it.emits
                .iter()
                .filter_map(|it| net.outputs.get(it.0 as usize))
                .map(|it| it.name.to_owned())
                .collect()
        }),
        at: case.schedule.map(|it| it.steps[firing].date),
        changes: changed
            .map(|at| Change {
                place: case.pt.places[at].clone(),
                before: before[at],
                after: after[at],
            })
            .collect(),
        turns: Vec::new(),
    }
}

/// The atoms of the property along the run; steps are told what they turn.
fn atoms(case: &Case<'_>, trace: &mut [Step]) -> Result<Vec<AtomTrack>, NotARun> {
    let Some(formula) = case.property.question.formula() else { return Ok(Vec::new()) };
    let mut tracks = Vec::new();
    for atom in claim::atoms(formula).into_iter().take(ATOMS) {
        let is_mark = matches!(
            &atom,
            Atom::AtMost(Linear { weights, constant: 1 }) if matches!(weights.as_slice(), [(_, -1)])
        );
        let formula = Formula::Atom(atom);
        let text = formula.display(case.pt).to_string();
        let mut holds = Vec::with_capacity(trace.len() + 1);
        if let Some(condition) = Condition::new(&formula, case.pt) {
            case.run.walk(case.pt, |_, marking| holds.push(condition.holds(marking)))?;
        }
        for (step, pair) in trace.iter_mut().zip(holds.windows(2)) {
            if pair[0] != pair[1] {
                step.turns.push(Turn { atom: text.clone(), holds: pair[1] });
            }
        }
        tracks.push(AtomTrack { atom: text, holds, is_mark });
    }
    Ok(tracks)
}

/// The places that the property speaks of, and then those that the cause points at; places instead
/// of their mirrors.
fn watched(
    property: &Property,
    story: &story::Story,
    pt: &Pt,
    mirrored: &[Option<u32>],
) -> Vec<u32> {
    let needs = |it: TransitionId| pt.needs.of(it.0).iter().map(|it| it.0).collect();
    let asked = mirror::asked(&property.question, needs);
    let mut watched = Vec::new();
    for place in asked.into_iter().chain(story.culprits.iter().copied()) {
        let Some(of) = mirrored.get(place as usize) else { continue };
        let place = of.unwrap_or(place);
        if !watched.contains(&place) && watched.len() < WATCHED {
            watched.push(place);
        }
    }
    watched
}

/// The documentation of what the run fires and changes, and of the places that are watched.
fn legend(net: &Net<'_>, pt: &Pt, run: &Run, watched: &[u32], trace: &[Step]) -> Vec<Meaning> {
    let mut fired = vec![false; pt.transitions.len()];
    let mut shown = vec![false; pt.places.len()];
    for transition in run.firings() {
        fired[transition.0 as usize] = true;
        for place in touched(pt, transition.0) {
            shown[place as usize] = true;
        }
    }
    for place in watched {
        shown[*place as usize] = true;
    }
    let is_told = |event: &str| trace.iter().any(|it| it.event.as_deref() == Some(event));
    let places = net.places.iter().zip(shown).filter(|it| it.1).map(|it| (it.0.name, it.0.doc));
    let transitions =
        net.transitions.iter().zip(fired).filter(|it| it.1).map(|it| (it.0.name, it.0.doc));
    let events = net.events.iter().filter(|it| is_told(it.name)).map(|it| (it.name, it.doc));
    let all = places.chain(transitions).chain(events).filter(|it| !it.1.is_empty());
    all.map(|(name, doc)| Meaning { name: name.to_owned(), doc: doc.trim().to_owned() }).collect()
}

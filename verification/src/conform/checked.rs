//! Tells players again what was recorded.

use super::allowed::Allowed;
use super::departure::{Departure, Refused};
use super::hidden::Search;
use super::names::Names;
use super::pending::Stop;
use super::read::{Recording, What};
use super::rules::{Rules, Seen};
use super::verdict::Verdict;
use super::way::Way;
use crate::play::{Fired, Game, Numbered};
use cotama_core::net::TransitionId;
use cotama_core::system::System;
use cotama_core::units::Millis;

/// The most states at one instant, unless the options say otherwise.
pub const MOST_STATES: usize = 20_000;

/// How a recording is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options<'o> {
    /// How far recorded dates may be from those of the model.
    pub tolerance: Millis,
    /// The most states in which the model may be at one instant, where what fired is not recorded;
    /// with more of them the answer can be unknown.
    pub most_states: usize,
    /// Transitions, by their numbers in a net alone, that may fire without being recorded.
    pub invisible: &'o [TransitionId],
    /// Further names of transitions, by their numbers in a net alone: a file can call several
    /// alike.
    pub shared_names: &'o [(TransitionId, String)],
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { tolerance: Millis(0), most_states: MOST_STATES, invisible: &[], shared_names: &[] }
    }
}

/// Whether a recording is a run of a system, or of a [net alone](System::alone).
///
/// # Errors
/// A [`Refused`] when that cannot be said.
///
/// ```
/// use cotama_core::net;
/// use cotama_core::system::{Component, System};
/// use cotama_verification::conform::{Options, Recording, conform};
///
/// net! {
///     /// Goes out by itself.
///     pub mod lamp {
///         places { Dark: 1, Lit }
///         events { press }
///         transitions { on on press: Dark => Lit; off: Lit => Dark within 5_000..=6_000 ms; }
///     }
/// }
/// let alone = [Component::alone(&lamp::NET)];
/// let told = |off: u64| {
///     let text = format!(
///         "{{\"t_ms\":9,\"event\":\"press\"}}\n{{\"t_ms\":9,\"fired\":\"on\"}}\n\
///          {{\"t_ms\":{off},\"fired\":\"off\"}}"
///     );
///     let recording = Recording::read("log", &text).unwrap();
///     conform(&System::alone(&alone), &recording, Options::default()).unwrap().departs
/// };
/// assert_eq!(told(5_500), None);
/// let late = told(7_000).unwrap();
/// let reason = "`off` fired at 7000 ms, too late: it had to fire by 6009 ms";
/// assert_eq!((late.line, late.reason.as_str()), (3, reason));
/// ```
pub fn conform(
    system: &System<'_>,
    recording: &Recording,
    options: Options<'_>,
) -> Result<Verdict, Refused> {
    let numbered = Numbered::of(system);
    let names = Names::of(&numbered, options.shared_names);
    let seen = seen(&numbered, &names, recording, options.invisible)?;
    names.all_known(recording)?;
    let plain = numbered.is_plain();
    let whole = numbered.whole().clone();
    let is_chosen = |TransitionId(id): TransitionId| {
        plain || whole.transitions.get(id as usize).is_some_and(|it| it.within.is_some())
    };
    let numbered = numbered.choosing(is_chosen, options.tolerance);
    let rules = Rules::new(&numbered, &names, seen, recording, options.tolerance);
    let mut result = Ok(Verdict::default());
    let played = numbered.play(recording.start, &mut |game, fired| {
        result = judged(&rules, recording, options, game, &fired);
    });
    played.map_err(Refused::Model)?;
    result
}

/// Which transitions are recorded.
fn seen(
    numbered: &Numbered,
    names: &Names,
    recording: &Recording,
    invisible: &[TransitionId],
) -> Result<Vec<Seen>, Refused> {
    let says = |is: fn(&What) -> bool| recording.lines.iter().any(|it| is(&it.what));
    let says_fired = recording.says_fired.unwrap_or_else(|| {
        says(|it| matches!(it, What::Fired(_))) || !says(|it| matches!(it, What::Output(_)))
    });
    let ids = || (0..numbered.whole().transitions.len() as u32).map(TransitionId);
    let nets = if numbered.is_system() { numbered.net_names() } else { &[] };
    let all = if says_fired { Seen::Always } else { Seen::Never };
    let mut seen = vec![all; numbered.whole().transitions.len()];
    let mut leave = |id: TransitionId, how: Seen| {
        if let Some(it) = seen.get_mut(id.0 as usize).filter(|it| **it == Seen::Always) {
            *it = how;
        }
    };
    for name in &recording.silent {
        let silent = names.transitions(name);
        if nets.contains(name) {
            ids().filter(|&id| numbered.net_name(id) == name).for_each(|id| leave(id, Seen::Never));
        } else if silent.is_empty() {
            let (at, known) = (None, nets.to_vec());
            return Err(Refused::Name { at, kind: "net", name: name.clone(), known });
        } else {
            silent.iter().for_each(|&id| leave(id, Seen::Never));
        }
    }
    if !numbered.is_system() {
        invisible.iter().for_each(|&id| leave(id, Seen::Perhaps));
    }
    Ok(seen)
}

/// Follows the recording in every way in which it can be meant.
fn judged<'c>(
    rules: &Rules<'_>,
    recording: &Recording,
    options: Options<'_>,
    game: Box<dyn Game<'c> + 'c>,
    fired: &[Fired],
) -> Result<Verdict, Refused> {
    let mut search = Search::new(rules, recording, options.most_states);
    let mut ways = vec![Way::new(rules, game, recording.start, fired)];
    let mut last = (0, recording.start);
    for (at, line) in recording.lines.iter().enumerate() {
        let (reached, before) = search.reach(&ways, at);
        let (mut next, mut stops) = (Vec::new(), Vec::new());
        for way in reached {
            way.follow(rules, &recording.lines, at, &mut next, &mut stops);
        }
        stops.extend(before);
        search.limit(&mut next);
        if next.is_empty() {
            let counts = ways.first().map_or_else(Verdict::default, |it| it.counts.clone());
            return ended(counts, stops, search.is_cut(), line.number, line.at, last.1);
        }
        (ways, last) = (next, (line.number, line.at));
    }
    let mut stops = Vec::new();
    let counts = ways.first().map_or_else(Verdict::default, |it| it.counts.clone());
    for way in &ways {
        match way.pending.front() {
            None => return Ok(Verdict { until: last.1, ..way.counts.clone() }),
            Some(first) => stops.push(first.missing(rules, "the recording ends, and ")),
        }
    }
    ended(counts, stops, search.is_cut(), last.0, last.1, last.1)
}

/// Returns the verdict on a recording that no way can follow any further.
fn ended(
    counts: Verdict,
    stops: Vec<Stop>,
    cut: bool,
    line: usize,
    at: Millis,
    until: Millis,
) -> Result<Verdict, Refused> {
    let counts = Verdict { until, ..counts };
    if cut {
        return Ok(Verdict { unknown: Some(line), ..counts });
    }
    let (mut said, mut refused, mut all) = (None, None, Allowed::default());
    for stop in stops {
        match stop {
            Stop::Departs(reason, allowed) => {
                said.get_or_insert(reason);
                all.add(allowed);
            }
            Stop::Refused(it) => _ = refused.get_or_insert(it),
        }
    }
    match (said, refused) {
        (None, Some(refused)) => Err(refused),
        (said, _) => {
            let reason = said.unwrap_or_else(|| "the model cannot follow".to_owned());
            let departs = Some(Departure { line, at, reason, allowed: all });
            Ok(Verdict { departs, ..counts })
        }
    }
}

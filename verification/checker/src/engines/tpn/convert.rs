//! Time nets from nets with events and milliseconds, and back.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Net, Transition, TransitionId, Within};
use cotama_property::time::{Interval, TimeNet, TimeNetDefect, TimePlace, TimeTransition};
use std::fmt;

/// A [`TimeNet`] made of a [`Net`], in milliseconds, and where it allows more than the net.
///
/// Every run of the net is a run of the time net, whatever events come when, so what no run of the
/// time net does no run of the net does. The time net has further runs where `differences` says so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Converted {
    /// The net.
    pub net: TimeNet,
    /// The parts of the net that the time net ignores; empty when the two mean the same.
    pub differences: Vec<Difference>,
}

/// A reason why a time net allows more than the net that it was made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Difference {
    /// Priorities and the order of lines are ignored: transitions that can fire at the same instant
    /// fire in any order.
    Order,
    /// These need an event; here they may fire at any time that their interval allows, or never.
    Events(Vec<TransitionId>),
    /// These accept an event up to a latest time; here also after it, as the end of an interval
    /// would force them to fire.
    Latest(Vec<TransitionId>),
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Order => f.write_str("priorities and the order of lines are ignored"),
            Self::Events(all) => write!(f, "{} transitions fire without their event", all.len()),
            Self::Latest(all) => {
                write!(f, "{} transitions accept their event later as well", all.len())
            }
        }
    }
}

/// The time net of a net: a transition with an event and no interval has `[0,w[`, one with neither
/// has `[0,0]`, one with an interval and no event keeps it. A transition with both has its earliest
/// time and no latest one.
///
/// # Errors
/// What is wrong with the net.
///
/// ```
/// use cotama_models::nets::watchdog;
/// use cotama_verification::tpn::from_net;
/// let converted = from_net(&watchdog::NET).unwrap();
/// assert_eq!(converted.net.transitions().len(), watchdog::NET.transitions.len());
/// let differences: Vec<_> = converted.differences.iter().map(ToString::to_string).collect();
/// let order = "priorities and the order of lines are ignored";
/// assert_eq!(differences, [order, "7 transitions fire without their event"]);
/// ```
pub fn from_net(net: &Net<'_>) -> Result<Converted, TimeNetDefect> {
    let ids = |wanted: fn(&Transition<'_>) -> bool| {
        let ids = net.transitions.iter().enumerate().filter(move |(_, it)| wanted(it));
        ids.map(|(at, _)| TransitionId(at as u32)).collect::<Vec<_>>()
    };
    let events = ids(|it| it.on.is_some());
    let latest =
        ids(|it| it.on.is_some() && it.within.is_some_and(|within| within.latest.is_some()));
    let order = net.transitions.len() > 1;
    let differences = [
        order.then_some(Difference::Order),
        (!events.is_empty()).then_some(Difference::Events(events)),
        (!latest.is_empty()).then_some(Difference::Latest(latest)),
    ];
    let places = net.places.iter().map(|it| TimePlace {
        name: it.name.to_owned(),
        label: None,
        initial: it.initial,
    });
    let transitions = net.transitions.iter().map(|it| TimeTransition {
        interval: interval(it),
        take: it.take.to_vec(),
        read: it.read.to_vec(),
        give: it.give.to_vec(),
        ..TimeTransition::new(it.name)
    });
    let net = TimeNet::new(net.name.to_owned(), places.collect(), transitions.collect())?;
    Ok(Converted { net, differences: differences.into_iter().flatten().collect() })
}

/// The time net that a net is exported as: as [`from_net`], but for a net without events and
/// intervals. Nothing forces its transitions to fire, so they have `[0,w[`.
///
/// # Errors
/// What is wrong with the net.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedTransition};
/// use cotama_verification::tpn::{Interval, exported, from_net};
/// let mut plain = OwnedNet::new("plain", "");
/// plain.transition(OwnedTransition::new("t")).unwrap();
/// let view = plain.view();
/// assert_eq!(exported(&view.net()).unwrap().net.transitions()[0].interval, Interval::ANY);
/// assert_eq!(from_net(&view.net()).unwrap().net.transitions()[0].interval, Interval::NOW);
/// ```
pub fn exported(net: &Net<'_>) -> Result<Converted, TimeNetDefect> {
    let Converted { net: forced, differences } = from_net(net)?;
    let is_plain = |it: &Transition<'_>| it.on.is_none() && it.within.is_none();
    if !net.transitions.iter().all(is_plain) {
        return Ok(Converted { net: forced, differences });
    }
    let free = |it: &TimeTransition| TimeTransition { interval: Interval::ANY, ..it.clone() };
    let transitions = forced.transitions().iter().map(free).collect();
    let net = TimeNet::new(forced.name().to_owned(), forced.places().to_vec(), transitions)?;
    Ok(Converted { net, differences: Vec::new() })
}

fn interval(transition: &Transition<'_>) -> Interval {
    match (transition.on, transition.within) {
        (Some(_), within) => Interval::at_least(within.map_or(0, |within| within.earliest.into())),
        (None, None) => Interval::NOW,
        (None, Some(Within { earliest, latest: Some(latest) })) => {
            Interval::closed(earliest.into(), latest.into())
        }
        (None, Some(Within { earliest, latest: None })) => Interval::at_least(earliest.into()),
    }
}

/// Why a time net cannot be written as a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotANet {
    /// An interval has an open bound; intervals of a net are closed.
    Open(TransitionId),
    /// A bound is more than 4,294,967,295.
    Large(TransitionId),
    /// A place is both taken from and read; in a net it cannot be.
    TakenAndRead(TransitionId),
}

impl fmt::Display for NotANet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open(id) => write!(f, "the interval of transition {} has an open bound", id.0),
            Self::Large(id) => {
                write!(f, "a bound of transition {} is more than {}", id.0, u32::MAX)
            }
            Self::TakenAndRead(id) => {
                write!(f, "transition {} takes from and reads the same place", id.0)
            }
        }
    }
}

impl std::error::Error for NotANet {}

/// A net of the same meaning, its unit taken as milliseconds, its labels as documentation. All
/// transitions get an interval.
///
/// # Errors
/// What a net cannot say.
///
/// ```
/// use cotama_verification::tina;
/// use cotama_verification::tpn::to_net;
/// let net = tina::read("egg.net", b"tr boil [300,360] raw -> hard  pl raw (1)").unwrap();
/// let within = to_net(&net).unwrap().transitions[0].within.unwrap();
/// assert_eq!((within.earliest, within.latest), (300, Some(360)));
/// ```
pub fn to_net(net: &TimeNet) -> Result<OwnedNet, NotANet> {
    let places = net.places().iter().map(|it| {
        OwnedPlace::new(&it.name, it.initial).doc(it.label.as_deref().unwrap_or_default())
    });
    let mut transitions = Vec::with_capacity(net.transitions().len());
    for (id, it) in (0..).map(TransitionId).zip(net.transitions()) {
        let Interval { lower, lower_strict, upper, upper_strict } = it.interval;
        if lower_strict || upper_strict && upper.is_some() {
            return Err(NotANet::Open(id));
        }
        let bound = |bound| u32::try_from(bound).map_err(|_| NotANet::Large(id));
        if it
            .read
            .iter()
            .any(|arc| it.take.binary_search_by_key(&arc.place, |arc| arc.place).is_ok())
        {
            return Err(NotANet::TakenAndRead(id));
        }
        transitions.push(OwnedTransition {
            doc: it.label.clone().unwrap_or_default(),
            line: id.0,
            take: it.take.clone(),
            read: it.read.clone(),
            give: it.give.clone(),
            ..OwnedTransition::new(&it.name).within(bound(lower)?, upper.map(bound).transpose()?)
        });
    }
    Ok(OwnedNet { places: places.collect(), transitions, ..OwnedNet::new(net.name(), "") })
}

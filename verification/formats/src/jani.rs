//! JANI, the exchange format of quantitative model checkers (<https://jani-spec.org>).

mod document;

use super::effect::effect;
use super::identifier::identifiers;
use cotama_core::net::{Arc, Law, Net, Place, PlaceId, Transition};
use cotama_core::text;
use document::{
    Action, Assignment, Automaton, Composition, Destination, Edge, Element, Expression, Guard,
    Location, Metadata, Model, Property, Sync, Type, Variable,
};

const LOCATION: &str = "marking";
const AUTOMATON: &str = "net";

/// The net as a JANI model of type `mdp`, in version 1 of the format: a Markov decision process in
/// which nothing is drawn, only chosen. Storm reads no `lts`, and probabilities 0 and 1 are the
/// same as "on no path" and "on some path" where each choice has one outcome.
///
/// One automaton with one location; each place is an integer variable, bounded when a bound is
/// claimed, each transition an edge whose guard asks for the tokens that it takes and reads. Every
/// edge carries an action of its own, named after the transition, so that a trace tells which one
/// fired; the event that it needs, what it emits and its documentation are the `comment` of the
/// edge. A name that is not a letter followed by letters, digits and `_` is changed to one, and the
/// comment keeps the original.
///
/// The model is the net *without time and priorities*: every order in which enabled transitions can
/// fire, which is what [`Law`]s speak about. Time intervals and priorities stand in the comments of
/// the edges. They are no clocks: a clock of a time Petri net starts when its transition becomes
/// enabled, which depends on the marking before and after each other firing, and JANI has no
/// conditional reset. `metadata.description` of the model says what it leaves out.
///
/// Laws become properties over the initial state, by probabilities of `F` alone, which every
/// checker of MDPs reads: [`Law::Invariant`] and [`Law::NeverBoth`] `Pmax(F broken) ≤ 0`,
/// [`Law::Reachable`] `Pmax(F marked) > 0`, [`Law::AlwaysCan`] one in the other, and
/// [`Law::DeadlockFree`] `Pmax(F stuck) ≤ 0`, in which `stuck` says that no guard holds. The others
/// speak of events and are listed in `metadata.description`.
///
/// A net that breaks a claimed bound is a model whose variable leaves its range, which checkers
/// report. Arcs and laws that name what the net does not have (see [`Net::defect`]) are left out.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::formats::jani;
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1).at_most(1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0).at_most(1)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// let text = jani::write(&net.view().net());
/// assert!(text.starts_with("{\n  \"jani-version\": 1,\n  \"name\": \"light\",\n"));
/// ```
pub fn write(net: &Net<'_>) -> String {
    let writer = Writer {
        net,
        variables: identifiers(net.places.iter().map(|place| place.name), "", &[]),
        actions: identifiers(net.transitions.iter().map(|transition| transition.name), "", &[]),
    };
    // strings and numbers: no error
    let text = serde_json::to_string_pretty(&writer.model()).unwrap_or_default();
    format!("{}\n", text::json(&text))
}

struct Writer<'n> {
    net: &'n Net<'n>,
    variables: Vec<String>,
    actions: Vec<String>,
}

impl Writer<'_> {
    fn model(&self) -> Model {
        let (properties, unsaid) = self.properties();
        Model {
            jani_version: 1,
            name: self.net.name.to_owned(),
            metadata: Metadata { description: self.description(&unsaid) },
            kind: "mdp",
            features: ["derived-operators"],
            actions: self.actions.iter().map(|name| Action { name: name.clone() }).collect(),
            variables: self.net.places.iter().zip(&self.variables).map(variable).collect(),
            properties,
            automata: [Automaton {
                name: AUTOMATON,
                locations: [Location { name: LOCATION }],
                initial_locations: [LOCATION],
                edges: self
                    .net
                    .transitions
                    .iter()
                    .zip(&self.actions)
                    .map(|it| self.edge(it))
                    .collect(),
            }],
            system: Composition {
                elements: [Element { automaton: AUTOMATON }],
                syncs: self
                    .actions
                    .iter()
                    .map(|it| Sync { synchronise: [it.clone()], result: it.clone() })
                    .collect(),
            },
        }
    }

    fn description(&self, unsaid: &[&'static str]) -> String {
        let timed = self.net.transitions.iter().any(|it| it.within.is_some());
        let ranked = self.net.transitions.iter().any(|it| it.priority != 0);
        let ignores = !self.net.ignored.is_empty();
        let left_out = [
            timed.then_some("time intervals"),
            ranked.then_some("priorities"),
            ignores.then_some("events ignored on purpose"),
        ];
        let left_out: Vec<&str> =
            left_out.into_iter().flatten().chain(unsaid.iter().copied()).collect();
        let mut text = self.net.doc.to_owned();
        if !left_out.is_empty() {
            text += if text.is_empty() { "" } else { "\n\n" };
            text += "Left out of this model: ";
            text += &left_out.join(", ");
            text.push('.');
        }
        text
    }

    fn edge(&self, (transition, action): (&Transition<'_>, &String)) -> Edge {
        let assignments = effect(transition).into_iter().filter_map(|(place, change)| {
            let variable = self.variables.get(place.0 as usize)?;
            let op = if change > 0 { "+" } else { "-" };
            let change = Expression::Number(change.unsigned_abs());
            let value = Expression::binary(op, Expression::Variable(variable.clone()), change);
            Some(Assignment { variable: variable.clone(), value })
        });
        Edge {
            location: LOCATION,
            action: action.clone(),
            guard: self.guard(transition).map(|exp| Guard { exp }),
            destinations: [Destination { location: LOCATION, assignments: assignments.collect() }],
            comment: self.comment(transition, action),
        }
    }

    fn comment(&self, transition: &Transition<'_>, action: &str) -> Option<String> {
        let mut parts = Vec::new();
        if transition.name != action {
            parts.push(format!("transition {}", transition.name));
        }
        if let Some(event) = transition.on.and_then(|id| self.net.events.get(id.0 as usize)) {
            parts.push(format!("on {}", event.name));
        }
        if let Some(within) = transition.within {
            parts.push(match within.latest {
                Some(latest) => format!("within {} to {latest} ms", within.earliest),
                None => format!("not before {} ms", within.earliest),
            });
        }
        if transition.priority != 0 {
            parts.push(format!("priority {}", transition.priority));
        }
        let outputs = transition.emits.iter().filter_map(|id| self.net.outputs.get(id.0 as usize));
        parts.extend(outputs.map(|output| format!("emits {}", output.name)));
        if !transition.doc.is_empty() {
            parts.push(transition.doc.to_owned());
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The properties, and the laws that are none.
    fn properties(&self) -> (Vec<Property>, Vec<&'static str>) {
        let (mut names, mut expressions, mut unsaid) = (Vec::new(), Vec::new(), Vec::new());
        let named = |id: PlaceId| self.variables.get(id.0 as usize).map_or("", String::as_str);
        for law in self.net.laws {
            let (name, formula) = match *law {
                Law::Invariant { sum, equals } => {
                    ("invariant".to_owned(), self.invariant(sum, equals))
                }
                Law::NeverBoth(a, b) => {
                    let both = self
                        .marked(a)
                        .zip(self.marked(b))
                        .map(|(a, b)| Expression::binary("∧", a, b));
                    (format!("never_both_{}_{}", named(a), named(b)), both.map(never))
                }
                Law::Reachable(place) => {
                    (format!("reachable_{}", named(place)), self.marked(place).map(possible))
                }
                Law::AlwaysCan(place) => {
                    let lost = self.marked(place).map(never);
                    (format!("always_can_{}", named(place)), lost.map(never))
                }
                Law::DeadlockFree { end } => {
                    ("deadlock_free".to_owned(), self.stuck(end).map(never))
                }
                Law::HandlesAll => {
                    unsaid.push("law HandlesAll");
                    continue;
                }
                Law::Settles => {
                    unsaid.push("law Settles");
                    continue;
                }
                Law::Deterministic => {
                    unsaid.push("law Deterministic");
                    continue;
                }
            };
            if let Some(formula) = formula {
                names.push(name);
                expressions.push(formula);
            }
        }
        let names = identifiers(names.iter().map(String::as_str), "", &[]);
        let property =
            |(name, formula)| Property { name, expression: Expression::at_start(formula) };
        (names.into_iter().zip(expressions).map(property).collect(), unsaid)
    }

    fn invariant(&self, sum: &[Arc], equals: u32) -> Option<Expression> {
        let term = |arc: &Arc| {
            let variable = Expression::Variable(self.variables.get(arc.place.0 as usize)?.clone());
            let weight = || Expression::Number(u64::from(arc.weight));
            Some(if arc.weight == 1 {
                variable
            } else {
                Expression::binary("*", weight(), variable)
            })
        };
        let terms = sum.iter().map(term).collect::<Option<Vec<_>>>()?;
        let sum = Expression::all("+", terms).unwrap_or(Expression::Number(0));
        let broken = Expression::binary("≠", sum, Expression::Number(u64::from(equals)));
        Some(never(broken))
    }

    /// Returns the condition that no transition is enabled, and `end` is not marked.
    fn stuck(&self, end: Option<PlaceId>) -> Option<Expression> {
        let guards = self.net.transitions.iter().map(|it| self.guard(it));
        let closed =
            guards.map(|guard| Expression::unary("¬", guard.unwrap_or(Expression::Truth(true))));
        let ended = match end {
            None => None,
            Some(end) => Some(Expression::unary("¬", self.marked(end)?)),
        };
        let all = Expression::all("∧", closed.chain(ended).collect());
        Some(all.unwrap_or(Expression::Truth(true)))
    }

    fn guard(&self, transition: &Transition<'_>) -> Option<Expression> {
        let needs =
            transition.take.iter().chain(transition.read).filter_map(|&arc| self.holds(arc));
        Expression::all("∧", needs.collect())
    }

    fn marked(&self, place: PlaceId) -> Option<Expression> {
        self.holds(Arc { place, weight: 1 })
    }

    fn holds(&self, arc: Arc) -> Option<Expression> {
        let variable = self.variables.get(arc.place.0 as usize)?;
        let weight = Expression::Number(u64::from(arc.weight));
        Some(Expression::binary("≥", Expression::Variable(variable.clone()), weight))
    }
}

/// No path leads to where it holds.
fn never(holds: Expression) -> Expression {
    Expression::binary("≤", most(holds), Expression::Number(0))
}

/// Some path leads to where it holds.
fn possible(holds: Expression) -> Expression {
    Expression::binary(">", most(holds), Expression::Number(0))
}

/// The most probable that it holds at some time, whoever chooses.
fn most(holds: Expression) -> Expression {
    Expression::unary("Pmax", Expression::unary("F", holds))
}

fn variable((place, name): (&Place<'_>, &String)) -> Variable {
    let renamed = (place.name != name).then(|| format!("place {}", place.name));
    let parts: Vec<String> =
        renamed.into_iter().chain((!place.doc.is_empty()).then(|| place.doc.to_owned())).collect();
    Variable {
        name: name.clone(),
        kind: Type::up_to((place.bound != Place::UNBOUNDED).then_some(place.bound)),
        initial_value: place.initial,
        comment: (!parts.is_empty()).then(|| parts.join("; ")),
    }
}

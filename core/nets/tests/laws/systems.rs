//! `handles(all)` of 1,000 random systems, judged and played.

use crate::draw::Draw;
use crate::random::{Random, guarded};
use cotama_core::net::owned::{OwnedIgnored, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{EventId, Net, OutputId, PlaceId, Role};
use cotama_core::player::{Firing, Loaded, Observer, Packed, Player, Program as _, SETTLE};
use cotama_core::system::{
    Binding, Clear, Component, Culprit, Delivery, Link, Of, STATES, Step, System, SystemError,
    Target, judge,
};
use cotama_core::units::Millis;
use cotama_nets::__private::system::{Claim, check_laws};
use std::collections::{BTreeMap, HashSet};

const SYSTEMS: usize = 1_000;
const WORDS: usize = 2;
const SLOTS: usize = 18;
/// So many events and outputs has each net.
const SIGNALS: u32 = 3;

type Program<'s> = Loaded<'s, WORDS, 0, SLOTS>;
type Played<'s> = Player<Program<'s>, WORDS, 0, SLOTS>;
/// The tokens of each place that is no complement and no mailbox, by its owner.
type Tokens = BTreeMap<(u16, u32), u32>;

fn of<T>(component: usize, id: T) -> Of<T> {
    Of { component: component as u16, id }
}

/// The parts of a system.
#[derive(Debug)]
pub(crate) struct Parts {
    pub(crate) nets: Vec<OwnedNet>,
    pub(crate) links: Vec<Link>,
    pub(crate) bindings: Vec<Binding>,
    pub(crate) clears: Vec<Clear>,
}

impl Parts {
    /// Calls `story` with the system of these parts.
    pub(crate) fn with_system<R>(&self, story: impl FnOnce(&System<'_>) -> R) -> R {
        let views: Vec<_> = self.nets.iter().map(OwnedNet::view).collect();
        let nets: Vec<Net<'_>> = views.iter().map(|it| it.net()).collect();
        let components: Vec<_> = nets.iter().map(|net| Component { name: net.name, net }).collect();
        story(&System {
            name: "random",
            doc: "",
            components: &components,
            links: &self.links,
            bindings: &self.bindings,
            clears: &self.clears,
        })
    }
}

/// Two or three nets, with links, a flag of the first one that others share, pending places and
/// mailboxes that are emptied.
pub(crate) fn parts(random: &mut Random) -> Parts {
    let count = 2 + random.below(2) as usize;
    let mut parts = Parts {
        nets: Vec::new(),
        links: links(random, count),
        bindings: Vec::new(),
        clears: Vec::new(),
    };
    let handles = if random.chance(65) { 98 } else { 65 };
    let guards = random.chance(50);
    for component in 0..count {
        let mut net = OwnedNet::new(&format!("n{component}"), "");
        for at in 0..2 + random.below(2) {
            let bound = 1 + u32::from(random.chance(15));
            let initial = u32::from(at == 0 || random.chance(15));
            net.places.push(OwnedPlace::new(&format!("P{at}"), initial).at_most(bound));
        }
        let own = net.places.len() as u32;
        let (mut changes, mut reads) = (vec![], vec![]);
        if component == 0 || random.chance(50) {
            let role = if component == 0 { Role::Data } else { Role::Shared };
            let flag = data(&mut net, "flag", role, 1);
            changes.push(flag);
            reads.push(flag);
            if component > 0 {
                let target = Target::Place(of(0, parts.bindings_flag()));
                parts.bindings.push(Binding { shared: of(component, flag), target });
            }
        }
        let mut boxes: Vec<(EventId, u16)> = Vec::new();
        for link in parts.links.iter().filter(|it| usize::from(it.to.component) == component) {
            if let Delivery::Mail { capacity } = link.delivery
                && !boxes.iter().any(|it| it.0 == link.to.id)
            {
                boxes.push((link.to.id, capacity));
            }
        }
        for &(event, capacity) in &boxes {
            if random.chance(30) {
                let name = format!("pending{}", event.0);
                let pending = data(&mut net, &name, Role::Shared, u32::from(capacity));
                reads.push(pending);
                let target = Target::Mailbox(of(component, event));
                parts.bindings.push(Binding { shared: of(component, pending), target });
            }
            if random.chance(30) {
                let on = of(component, EventId(random.below(SIGNALS)));
                parts.clears.push(Clear { on, mailbox: event });
            }
        }
        for at in 0..SIGNALS {
            net.event(&format!("e{at}"), "").unwrap();
            net.output(&format!("o{at}"), "").unwrap();
        }
        for at in 0..3 + random.below(4) {
            let transition = transition(random, own, &changes, &reads, at);
            net.transitions.push(transition);
        }
        let flags: Vec<_> = changes.iter().flat_map(|it| [*it, PlaceId(it.0 + 1)]).collect();
        let known: Vec<_> = (0..own).map(PlaceId).chain(flags.iter().copied()).collect();
        for event in 0..SIGNALS {
            for place in 0..own + u32::from(!changes.is_empty()) {
                if random.chance(handles) {
                    let it = OwnedIgnored::new(EventId(event), PlaceId(place));
                    if !guards {
                        net.ignored.push(it);
                    } else if flags.is_empty() || random.chance(10) {
                        net.ignored.push(guarded(random, it, &known));
                    } else {
                        net.ignored.extend(flags.iter().map(|&at| it.clone().guard(at, 1)));
                    }
                }
            }
        }
        parts.nets.push(net);
    }
    parts
}

impl Parts {
    /// The flag of the first net.
    fn bindings_flag(&self) -> PlaceId {
        let flag = self.nets[0].places.iter().position(|it| it.name == "flag");
        PlaceId(flag.unwrap() as u32)
    }
}

/// `now` leads onward only, so that there is no circle.
fn links(random: &mut Random, count: usize) -> Vec<Link> {
    let mut links: Vec<Link> = Vec::new();
    for from in 0..count {
        for output in 0..SIGNALS {
            for _ in 0..u32::from(random.chance(55)) + u32::from(random.chance(20)) {
                let to = random.below(count as u32) as usize;
                let event = of(to, EventId(random.below(SIGNALS)));
                let now = to > from && random.chance(60);
                let capacity = 1 + random.below(2) as u16;
                let delivery = if now { Delivery::Now } else { Delivery::Mail { capacity } };
                let known = links.iter().find(|it| it.to == event).map(|it| it.delivery);
                let delivery = known.unwrap_or(delivery);
                let from = of(from, OutputId(output));
                let twice = links.iter().any(|it| it.from == from && it.to == event);
                if !twice && (delivery != Delivery::Now || to > usize::from(from.component)) {
                    links.push(Link { from, to: event, delivery });
                }
            }
        }
    }
    links
}

/// Adds a place with its complement.
fn data(net: &mut OwnedNet, name: &str, role: Role, bound: u32) -> PlaceId {
    let id = PlaceId(net.places.len() as u32);
    net.places.push(OwnedPlace { role, ..OwnedPlace::new(name, 0).at_most(bound) });
    let complement = OwnedPlace::new(&format!("not_{name}"), bound).at_most(bound);
    net.places.push(OwnedPlace { role: Role::Complement(id), ..complement });
    id
}

fn transition(
    random: &mut Random,
    own: u32,
    changes: &[PlaceId],
    reads: &[PlaceId],
    at: u32,
) -> OwnedTransition {
    let mut it = OwnedTransition { line: at, ..OwnedTransition::new(&format!("t{at}")) };
    let urgent = random.chance(25);
    if !urgent {
        it = it.on(EventId(random.below(SIGNALS)));
    }
    let taken = random.below(own);
    if urgent || random.chance(93) {
        it = it.take(PlaceId(taken), 1);
    }
    // A transition that fires by itself leads onward, or it would often do so for ever.
    let first = if urgent && random.chance(95) { taken + 1 } else { 0 };
    let mut given = vec![];
    for _ in 0..u32::from(random.chance(95)) + u32::from(random.chance(15)) {
        given.extend((first < own).then(|| PlaceId(first + random.below(own - first))));
    }
    given.sort_unstable();
    given.dedup();
    for place in given {
        it = it.give(place, 1);
    }
    let one = |random: &mut Random, of: &[PlaceId]| of[random.below(of.len() as u32) as usize];
    if !changes.is_empty() && random.chance(35) {
        let flag = one(random, changes);
        let complement = PlaceId(flag.0 + 1);
        let (from, to) = if random.chance(50) { (flag, complement) } else { (complement, flag) };
        it = it.take(from, 1).give(to, 1);
    } else if !reads.is_empty() && random.chance(50) {
        let place = one(random, reads);
        let not = u32::from(random.chance(50));
        it = it.read(PlaceId(place.0 + not), 1);
    }
    for output in 0..SIGNALS {
        if random.chance(30) {
            it.emits.push(OutputId(output));
        }
    }
    it.priority = if random.chance(25) { random.below(3) as i16 - 1 } else { 0 };
    it
}

/// The events reported by a player, and the tokens of places that are not mailboxes, moved as they
/// say.
struct Watch<'s> {
    system: System<'s>,
    tokens: Tokens,
    /// The first event that is neither used nor ignored on purpose, and the tokens then.
    forgotten: Option<(Of<EventId>, Tokens)>,
    fired: u32,
}

impl<'s> Watch<'s> {
    fn new(system: System<'s>, program: &Program<'s>, marking: &[u64; WORDS]) -> Self {
        let mut tokens = BTreeMap::new();
        for (component, it) in (0..).zip(system.components) {
            for id in 0..it.net.places.len() as u32 {
                if let Some(key) = owner(&system, component, PlaceId(id))
                    && key == (component, id)
                {
                    let place = Of { component, id: PlaceId(id) };
                    tokens.insert(key, program.code().tokens(marking, place));
                }
            }
        }
        Self { system, tokens, forgotten: None, fired: 0 }
    }
}

/// Returns the owner of a place; `None` for complements and mailboxes.
fn owner(system: &System<'_>, component: u16, id: PlaceId) -> Option<(u16, u32)> {
    let place = system.components[usize::from(component)].net.places[id.0 as usize];
    match (place.role, system.target(Of { component, id })) {
        (Role::Complement(_), _) | (_, Some(Target::Mailbox(_))) => None,
        (_, Some(Target::Place(it))) => Some((it.component, it.id.0)),
        (_, None) => Some((component, id.0)),
    }
}

impl<'s> Observer<Program<'s>> for Watch<'s> {
    fn on_fire(&mut self, firing: &Firing<'_, Program<'s>>) {
        let component = firing.id.component;
        let net = self.system.components[usize::from(component)].net;
        let it = &net.transitions[firing.id.id.0 as usize];
        self.fired += 1;
        for (arcs, gives) in [(it.take, false), (it.give, true)] {
            for arc in arcs {
                let Some(key) = owner(&self.system, component, arc.place) else { continue };
                let tokens = self.tokens.get_mut(&key).unwrap();
                *tokens = if gives { *tokens + arc.weight } else { *tokens - arc.weight };
            }
        }
    }

    fn on_ignore(&mut self, event: Of<EventId>, (): ()) {
        let net: &Net<'_> = self.system.components[usize::from(event.component)].net;
        let on_purpose = net.ignored.iter().any(|it| {
            let mut asked = it.guard.iter().map(|arc| (arc.place, arc.weight));
            let holds = |(PlaceId(at), weight)| {
                let place = net.places[at as usize];
                let (of, absent) = match place.role {
                    Role::Complement(of) => (of, true),
                    _ => (PlaceId(at), false),
                };
                let key = owner(&self.system, event.component, of).unwrap();
                let tokens = self.tokens[&key];
                (if absent { place.bound - tokens } else { tokens }) >= weight
            };
            it.event == event.id && holds((it.place, 1)) && asked.all(holds)
        });
        if !on_purpose && self.forgotten.is_none() {
            self.forgotten = Some((event, self.tokens.clone()));
        }
    }
}

/// The result of playing: in how many states the system rests, or the violation, the path there and
/// the tokens there.
type Found = Result<usize, (Culprit, Vec<Step>, Tokens)>;

/// Plays everything that can happen, breadth first.
fn played<'s>(system: &System<'s>, program: &Program<'s>) -> Found {
    let wrong = |watch: Watch<'_>, player: &Played<'s>, way: &[Step]| {
        if let Some((event, tokens)) = watch.forgotten {
            return Err((Culprit::Unanswered(event), way.to_vec(), tokens));
        }
        if watch.fired >= SETTLE {
            return Err((Culprit::Forever, way.to_vec(), BTreeMap::new()));
        }
        assert_eq!(watch.tokens, Watch::new(*system, program, player.marking()).tokens);
        Ok(())
    };
    let mut steps = vec![];
    for (component, it) in system.components.iter().enumerate() {
        for event in 0..it.net.events.len() as u32 {
            let event = of(component, EventId(event));
            if !system.links.iter().any(|link| link.to == event) {
                steps.push(Step::Offered(event));
            }
        }
    }
    steps.push(Step::Round);
    let mut watch = Watch::new(*system, program, &program.code().initial);
    let player = Played::start(*program, Millis(0), &mut watch);
    wrong(watch, &player, &[])?;
    let mut known = HashSet::from([*player.marking()]);
    let mut all = vec![(player, vec![])];
    let mut at = 0;
    while at < all.len() {
        let (from, way) = all[at].clone();
        at += 1;
        for &step in &steps {
            let mut player = from;
            let mut way = way.clone();
            way.push(step);
            let mut watch = Watch::new(*system, program, player.marking());
            match step {
                Step::Offered(event) => {
                    let _ = player.offer_id(Millis(0), event, (), &mut watch);
                }
                Step::Round => {
                    let _ = player.round_with(Millis(0), &mut watch);
                }
            }
            wrong(watch, &player, &way)?;
            if known.insert(*player.marking()) {
                if known.len() > STATES {
                    return Err((Culprit::TooLarge, vec![], BTreeMap::new()));
                }
                all.push((player, way));
            }
        }
    }
    Ok(known.len())
}

#[test]
fn systems_handle_all_that_the_player_delivers() {
    let mut random = Random(Draw::new(41));
    let mut verdicts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut count = |verdict| *verdicts.entry(verdict).or_default() += 1;
    let mut decided = 0;
    for number in 0.. {
        if decided == SYSTEMS {
            break;
        }
        let parts = parts(&mut random);
        parts.with_system(|system| {
            let packed = match Packed::<WORDS, 0, SLOTS>::of(system) {
                Ok(packed) => packed,
                Err(SystemError::Overfills(_)) => {
                    count("never sound");
                    return;
                }
                Err(defect) => panic!("{number}: {defect:?} {parts:#?}"),
            };
            let (code, program) = (packed.code(), packed.load(system));
            match (judge(system, &code), played(system, &program)) {
                (Ok(states), Ok(expected)) => {
                    assert_eq!(states, expected, "{number}: {parts:#?}");
                    let claimed = check_laws(system, &code, &[Claim::HandlesAll]);
                    assert_eq!(claimed, Some(states), "{number}: {parts:#?}");
                    decided += 1;
                    count("handled");
                    let mut ignored = parts.nets.iter().flat_map(|it| &it.ignored);
                    count(if ignored.any(|it| !it.guard.is_empty()) { "guarded" } else { "plain" });
                    count(if states > 20 { "many states" } else { "few states" });
                }
                (Err(violation), Err((culprit, way, tokens))) => {
                    assert_eq!(violation.culprit, culprit, "{number}: {parts:#?}");
                    assert_eq!(violation.steps(), way, "{number}: {parts:#?}");
                    if let Culprit::Unanswered(event) = culprit {
                        let there = Watch::new(*system, &program, &violation.marking);
                        assert_eq!(there.tokens, tokens, "{number}: {parts:#?}");
                        let outside = Some(&Step::Offered(event)) == way.last();
                        count(if outside { "forgotten from outside" } else { "forgotten inside" });
                        decided += 1;
                        count("forgotten");
                    } else {
                        count("not explored");
                    }
                }
                (judged, played) => panic!("{number}: {judged:?} {played:?} {parts:#?}"),
            }
        });
    }
    let of = |verdict| verdicts.get(verdict).copied().unwrap_or(0);
    assert!(of("handled") >= 200 && of("forgotten") >= 200, "{verdicts:?}");
    assert!(of("forgotten inside") >= 50 && of("many states") >= 5, "{verdicts:?}");
    assert!(of("guarded") >= 50 && of("plain") >= 50, "{verdicts:?}");
}

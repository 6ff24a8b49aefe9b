//! Fair runs, compared with all sets of markings that a run can stay in.

use super::linear::crossing;
use super::{formula, lamp};
use crate::properties::oracle::Space;
use crate::properties::random::{Random, branching, net, state};
use cotama_checker::explicit::{BitSet, Goal, Graph, Limits};
use cotama_core::net::TransitionId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::property::{Ctl, CtlNode, Formula};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{CtlAnswer, Fairness, Rest, Run};

/// The answer, with memory enough.
fn ctl(graph: &Graph, formula: &Ctl, fairness: &Fairness<'_>) -> CtlAnswer {
    cotama_verification::temporal::ctl(graph, formula, fairness, 1 << 30, 1).unwrap()
}

/// A small graph with a bit for each state.
struct Small {
    arcs: Vec<Vec<(TransitionId, usize)>>,
    recurring: Vec<u32>,
    weak: Vec<TransitionId>,
    strong: Vec<TransitionId>,
}

impl Small {
    fn enables(&self, state: usize, transition: TransitionId) -> bool {
        self.arcs[state].iter().any(|it| it.0 == transition)
    }

    fn states(&self) -> std::ops::Range<usize> {
        0..self.arcs.len()
    }

    fn is_in(set: u32, state: usize) -> bool {
        set >> state & 1 == 1
    }

    /// States from which a goal is reached through others.
    fn reaching(&self, through: u32, goal: u32) -> u32 {
        let mut reached = goal;
        for _ in self.states() {
            for state in self.states().filter(|it| Self::is_in(through, *it)) {
                if self.arcs[state].iter().any(|it| Self::is_in(reached, it.1)) {
                    reached |= 1 << state;
                }
            }
        }
        reached
    }

    /// Whether a fair run can pass through all of these states and no other ones again and again.
    fn is_fair(&self, set: u32) -> bool {
        let members = || self.states().filter(|it| Self::is_in(set, *it));
        let inside = |transition: Option<TransitionId>| {
            let is = |it: &(TransitionId, usize)| {
                Self::is_in(set, it.1) && transition.is_none_or(|id| it.0 == id)
            };
            members().any(|state| self.arcs[state].iter().any(is))
        };
        let is_dead = set.is_power_of_two() && members().all(|it| self.arcs[it].is_empty());
        let is_connected =
            inside(None) && members().all(|it| self.reaching(set, 1 << it) & set == set);
        (is_dead || is_connected)
            && self.recurring.iter().all(|it| it & set != 0)
            && self
                .weak
                .iter()
                .all(|it| inside(Some(*it)) || members().any(|state| !self.enables(state, *it)))
            && self
                .strong
                .iter()
                .all(|it| inside(Some(*it)) || !members().any(|state| self.enables(state, *it)))
    }

    fn always(&self, region: u32) -> u32 {
        let sets =
            (1..1_u32 << self.arcs.len()).filter(|set| set & !region == 0 && self.is_fair(*set));
        sets.fold(0, |all, set| all | self.reaching(region, set))
    }

    fn labels(&self, formula: &Ctl, atoms: &dyn Fn(&Formula) -> u32) -> Vec<u32> {
        let all = (1_u32 << self.arcs.len()) - 1;
        let fair = self.always(all);
        let mut labels: Vec<u32> = Vec::new();
        for node in formula.nodes() {
            let of = |it: &u32| labels[*it as usize];
            let label = match node {
                CtlNode::State(state) => atoms(state),
                CtlNode::Not(a) => all & !of(a),
                CtlNode::And(parts) => parts.iter().fold(all, |label, it| label & of(it)),
                CtlNode::Or(parts) => parts.iter().fold(0, |label, it| label | of(it)),
                CtlNode::Next(a) => {
                    let goal = of(a) & fair;
                    let some =
                        |state: &usize| self.arcs[*state].iter().any(|it| Self::is_in(goal, it.1));
                    self.states().filter(some).fold(0, |label, it| label | 1 << it)
                }
                CtlNode::Until(a, b) => self.reaching(of(a), of(b) & fair),
                CtlNode::Globally(a) => self.always(of(a)),
            };
            labels.push(label);
        }
        labels
    }
}

/// Fires a run; the states of its loop, and the transitions fired there.
fn looped(small: &Small, run: &Run) -> (Vec<usize>, Vec<TransitionId>) {
    let fire = |state: usize, it: &TransitionId| {
        small.arcs[state].iter().find(|arc| arc.0 == *it).unwrap().1
    };
    let first = run.stem.iter().fold(0, fire);
    match &run.rest {
        Rest::Any => panic!("a fair run goes on in a fair way"),
        Rest::Stays => {
            assert!(small.arcs[first].is_empty());
            (vec![first], Vec::new())
        }
        Rest::Cycle(cycle) => {
            let mut states = vec![first];
            for it in cycle {
                states.push(fire(*states.last().unwrap(), it));
            }
            assert_eq!(states.pop(), Some(first));
            (states, cycle.clone())
        }
    }
}

#[test]
fn verdicts_on_fair_runs_are_those_of_trying_all_sets() {
    let (mut random, mut compared, mut changed, mut shown) = (Random(31), 0, 0, 0);
    while compared < 3_000 {
        let pt = net(&mut random);
        let space = Space::new(&pt);
        let said = branching(&mut random, &pt, 2);
        if space.markings.len() > 7 || space.markings.len() < 2 || said.is_state() {
            continue;
        }
        compared += 1;
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        let mut some = |most| -> Vec<TransitionId> {
            let all = (0..pt.transitions.len() as u32).map(TransitionId);
            all.filter(|_| random.below(4) < most).collect()
        };
        let (weak, strong) = (some(1), some(2));
        let recurring: Vec<Formula> =
            (0..random.below(2)).map(|_| state(&mut random, &pt, 1)).collect();
        let atoms = |formula: &Formula| {
            let holds = graph.satisfying(Goal::new(formula).unwrap(), 1);
            holds.iter().enumerate().fold(0_u32, |set, (at, it)| set | u32::from(it) << at)
        };
        let arcs = |state: u32| {
            let to = graph.successors(state).iter().map(|it| *it as usize);
            graph.transitions(state).into_iter().zip(to).collect()
        };
        let small = Small {
            arcs: (0..graph.states() as u32).map(arcs).collect(),
            recurring: recurring.iter().map(atoms).collect(),
            weak: weak.clone(),
            strong: strong.clone(),
        };
        let recurring = recurring.iter().map(|it| Goal::new(it).unwrap()).collect();
        let form = Ctl::new(&said).unwrap();
        let found = ctl(&graph, &form, &Fairness { recurring, weak, strong });
        let text =
            || format!("{} on {pt:?}, {:?} {:?}", said.display(&pt), small.weak, small.strong);
        let expected = small.labels(&form, &atoms);
        assert_eq!(found.verdict, expected[form.root() as usize] & 1 == 1, "{}", text());
        for (label, expected) in found.labels.iter().zip(&expected) {
            for (state, holds) in label.iter().flat_map(BitSet::iter).enumerate() {
                assert_eq!(holds, Small::is_in(*expected, state), "{}", text());
            }
        }
        changed += u32::from(ctl(&graph, &form, &Fairness::default()).verdict != found.verdict);
        let Some(witness) = found.witness else { continue };
        if small.weak.is_empty() && small.strong.is_empty() && small.recurring.is_empty() {
            continue;
        }
        shown += 1;
        let (states, fired) = looped(&small, &witness.run);
        let some = |holds: &dyn Fn(usize) -> bool| states.iter().any(|it| holds(*it));
        assert!(
            small.recurring.iter().all(|it| some(&|state| Small::is_in(*it, state))),
            "{}",
            text()
        );
        for it in &small.weak {
            assert!(fired.contains(it) || some(&|state| !small.enables(state, *it)), "{}", text());
        }
        for it in &small.strong {
            assert!(
                fired.contains(it) || !some(&|state| small.enables(state, *it)),
                "{}: {:?}",
                text(),
                witness.run
            );
        }
    }
    assert!(changed > 100 && shown > 500, "{changed} {shown}");
}

#[test]
fn a_lamp_that_is_often_pressed_long_enough_fails_at_last_if_failing_is_strongly_fair() {
    let pt: Pt = lamp();
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    let said = Ctl::new(&formula(&pt, "AF deadlock")).unwrap();
    let fail = || vec![TransitionId(2)];
    assert!(!ctl(&graph, &said, &Fairness { weak: fail(), ..Fairness::default() }).verdict);
    assert!(ctl(&graph, &said, &Fairness { strong: fail(), ..Fairness::default() }).verdict);
    let on = formula(&pt, "on");
    let recurring = vec![Goal::new(&on).unwrap()];
    let said = Ctl::new(&formula(&pt, "EF deadlock")).unwrap();
    assert!(!ctl(&graph, &said, &Fairness { recurring, ..Fairness::default() }).verdict);
}

#[test]
fn a_run_that_is_to_be_in_two_places_again_and_again_visits_both() {
    let pt = lamp();
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    let [on, both] = ["on", "on & off"].map(|it| formula(&pt, it));
    let said = Ctl::new(&formula(&pt, "EG !deadlock")).unwrap();
    let verdict = |all: &[&Formula]| {
        let recurring = all.iter().map(|it| Goal::new(it).unwrap()).collect();
        ctl(&graph, &said, &Fairness { recurring, ..Fairness::default() }).verdict
    };
    assert!(verdict(&[&on]));
    // The lamp is never both.
    assert!(!verdict(&[&on, &both]) && !verdict(&[&both, &on]));
    let pt = crossing();
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    let sides = ["left", "right"].map(|it| formula(&pt, it));
    let recurring = sides.iter().map(|it| Goal::new(it).unwrap()).collect();
    let said = Ctl::new(&formula(&pt, "EG !deadlock")).unwrap();
    let found = ctl(&graph, &said, &Fairness { recurring, ..Fairness::default() });
    let run = Run { stem: Vec::new(), rest: Rest::Cycle([0, 1, 2, 3].map(TransitionId).to_vec()) };
    assert_eq!(found.witness.unwrap().run, run);
}

#[test]
fn fairness_takes_memory_that_is_counted() {
    let mut net = OwnedNet::new("heap", "");
    let [heap, used] = [("heap", 1_000), ("used", 0)]
        .map(|(name, tokens)| net.place(OwnedPlace::new(name, tokens)).unwrap());
    net.transition(OwnedTransition::new("take").take(heap, 1).give(used, 1)).unwrap();
    net.transition(OwnedTransition::new("give").take(used, 1).give(heap, 1)).unwrap();
    let pt = Pt::from(&net.view().net());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    // The fewest bytes that are enough.
    let least = |text: &str, weak: &[u32], often: &[&Formula]| {
        let said = Ctl::new(&formula(&pt, text)).unwrap();
        let recurring = || often.iter().map(|it| Goal::new(it).unwrap()).collect();
        let weak: Vec<_> = weak.iter().copied().map(TransitionId).collect();
        let fits = |bytes| {
            let fairness = Fairness { recurring: recurring(), weak: weak.clone(), strong: vec![] };
            cotama_verification::temporal::ctl(&graph, &said, &fairness, bytes, 1).is_ok()
        };
        let (mut small, mut enough) = (0, 1 << 20);
        while enough - small > 1 {
            let middle = u64::midpoint(small, enough);
            *if fits(middle) { &mut enough } else { &mut small } = middle;
        }
        enough
    };
    let (states, set) = (1_001, 1_001_u64.div_ceil(64) * 8);
    let next = least("EX used >= 7", &[], &[]);
    assert!((2 * set..4 * set).contains(&next), "{next}");
    // Memory that a search takes beside its answer is given back.
    let two = least("EG used <= 7 & EG heap >= 7", &[], &[]);
    let three = least("EG used <= 7 & EG heap >= 7 & EG used <= 9", &[], &[]);
    assert!(three - two < 8 * states, "{two} {three}");
    // A transition: where it is enabled, and where it leads.
    let first = least("EX used >= 7", &[0], &[]);
    let second = least("EX used >= 7", &[0, 1], &[]) - first;
    assert!((8 * states + set..14 * states).contains(&second), "{second}");
    let often = ["used <= 7", "heap <= 7"].map(|it| formula(&pt, it));
    let [one, two] = [1, 2].map(|it| least("EX used >= 7", &[], &[&often[0], &often[1]][..it]));
    assert_eq!(two - one, set);
}

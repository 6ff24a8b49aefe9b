//! An engine of somebody else: a random walk, which only finds. Nothing of the checker knows it.

use crate::properties::random::Random;
use cotama_core::net::TransitionId;
use cotama_models::nets::families::philosophers;
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::engines::{Bid, Budget, Engine, Finding, Found, Known, Task};
use cotama_verification::property::{Condition, parse};

/// Walks so many steps, from the start again after each deadlock.
struct Walk {
    steps: u64,
}

impl Engine for Walk {
    fn name(&self) -> &'static str {
        "walk"
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = matches!(task, Task::Reach(_)) && net.time().is_none();
        does.then(|| Bid::few(Bid::GLANCE - 1, budget, self.steps))
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Reach(goal) = task else { return Finding::unsuited() };
        let Some(goal) = Condition::new(goal, net.pt()) else { return Finding::unsuited() };
        let transitions = 0..net.pt().transitions.len() as u32;
        let (mut random, mut marking, mut way) = (Random(1), net.pt().initial.clone(), Vec::new());
        for states in 1..=budget.limits.states {
            if goal.holds(marking.as_slice()) {
                return Finding { found: Found::Path(way), states };
            }
            let enabled: Vec<u32> =
                transitions.clone().filter(|&it| net.pt().enabled(&marking, it)).collect();
            if enabled.is_empty() {
                (marking, way) = (net.pt().initial.clone(), Vec::new());
                continue;
            }
            let next = *random.choose(&enabled);
            let Some(after) = net.pt().fire(&marking, next) else { break };
            marking = after;
            way.push(TransitionId(next));
        }
        Finding::undecided(budget.limits.states)
    }
}

#[test]
fn a_random_walk_is_asked_beside_the_engines_of_the_checker() {
    let net = philosophers(6).unwrap();
    let model = Model::from(&net.view().net());
    let answered = |text: &str, steps: u64| {
        let asked = parse(text, model.pt()).unwrap();
        let options = Options { engines: &[&Walk { steps }], ..Options::default() };
        let answer = check(&model, &asked, &options);
        super::replay::replays(model.pt(), &asked.question, &answer);
        (answer.verdict, answer.engine())
    };
    assert_eq!(answered("EF deadlock", 10_000), (Verdict::Holds(true), "walk"));
    assert_eq!(answered("AG !deadlock", 10_000), (Verdict::Holds(false), "walk"));
    // Questions that this engine does not decide are left to others.
    assert_eq!(answered("EF deadlock", 2), (Verdict::Holds(true), "stubborn"));
    assert_eq!(answered("EF (eat_1 & eat_2)", 1_000), (Verdict::Holds(false), "structural"));
}

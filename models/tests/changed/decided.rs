//! Drawn missions of the decisional level: flags, words and plans that come as they come, and all
//! that it finds, tells and requests.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::{chance, pick};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Body, Cause, Configuration, Decider, Flag, Flags, Health, Module, Modules, NoPlanLeft, NoPlans,
    Perceived, Plans, Why, Word, delivery, operator, recovering,
};

/// Plans that are found or not as they are drawn.
struct Drawn {
    draw: Draw,
    asked: Vec<(Why, Modules)>,
    planned: Option<Configuration>,
}

impl Plans for Drawn {
    fn is_over(&self) -> bool {
        self.asked.len() > 12
    }

    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        self.asked.push((why, available));
        self.planned = Some(*pick(&mut self.draw, Configuration::ALL));
        self.planned = self.planned.filter(|it| it.runs_on(available));
        if chance(&mut self.draw, 15) { Err(NoPlanLeft) } else { Ok(chance(&mut self.draw, 50)) }
    }

    fn configuration(&self) -> Option<Configuration> {
        self.planned
    }

    fn short(&self) -> Option<usize> {
        (self.asked.len() % 5 == 3).then_some(self.asked.len() % 2)
    }
}

/// Words, the likelier ones more often.
const WORDS: [Word; 13] = [
    Word::MissionReceived,
    Word::MissionReceived,
    Word::PathReady,
    Word::PathReady,
    Word::PathReady,
    Word::ObjectReceived,
    Word::ObjectDelivered,
    Word::Operator(operator::Event::teleoperate),
    Word::Operator(operator::Event::teleprogram),
    Word::Operator(operator::Event::waypoints),
    Word::Operator(operator::Event::new_path),
    Word::Operator(operator::Event::arrived),
    Word::Operator(operator::Event::gives_up),
];

/// Plays a mission; the decider goes on as it is afterwards.
fn play<P, const W: usize, const C: usize, const S: usize>(
    effort: &mut Effort,
    seed: u64,
    mut decider: Decider<P, W, C, S>,
) where
    P: Program<W, C, S>,
{
    let mut draw = Draw::new(seed);
    let mut plans = Drawn { draw: Draw::new(seed + 1), asked: vec![], planned: None };
    let mut now = 0;
    let mut up: Vec<Flag> = Vec::new();
    let noisy = draw.between(1, 12);
    for period in 0..draw.between(100, 400) {
        now += if chance(&mut draw, 3) { draw.between(1_000, 130_000) } else { 100 };
        let mut seen = Perceived::nothing(Modules::ALL);
        if period > 5 && chance(&mut draw, noisy) {
            let flag = *pick(&mut draw, Flag::ALL);
            up.push(flag);
            seen.raised = Flags::of(&[flag]);
            if chance(&mut draw, 20) {
                seen.raised = seen.raised.with(*pick(&mut draw, Flag::ALL));
            }
            seen.part = Modules::of(&[*pick(&mut draw, Module::ALL)]);
        } else if chance(&mut draw, 15)
            && let Some(flag) = up.pop()
        {
            seen.lowered = Flags::of(&[flag]);
        }
        if chance(&mut draw, 30) {
            seen.works = seen.works.without(Modules::of(&[*pick(&mut draw, Module::ALL)]));
        }
        let found = decider.perceive(Millis(now), seen, &mut plans);
        effort.count("findings", u64::from(found.is_some()));
        let said = match period {
            1 => Some(Word::MissionReceived),
            2 => Some(Word::PathReady),
            _ if chance(&mut draw, 12) => Some(*pick(&mut draw, &WORDS)),
            _ => None,
        };
        let body = Body { at_goal: chance(&mut draw, 4), stands: chance(&mut draw, 60) };
        effort.note(&(found, decider.listens(), decider.idle_until()));
        let round = decider.round(Millis(now), said, body, &mut ());
        effort.count("told", u64::from(round.told.is_some()));
        effort.note(&(round, decider.requests(), decider.permit().is_some()));
        effort.note(&(decider.global(), decider.situation(), decider.since()));
        effort.note(&(decider.plannings_failed(), decider.health()));
        effort.note(&(decider.available(), decider.relied_on(), decider.level().snapshot()));
        effort.note(&(decider.level().halted(), decider.level().player().wake_at()));
        if let Some(until) = decider.idle_until()
            && chance(&mut draw, 10)
        {
            now = now.max(until.0.min(now + 5_000));
            decider.idle(Millis(now), body);
        }
    }
    effort.count("plans", plans.asked.len() as u64);
    effort.note(&plans.asked);
    effort.next();
}

#[test]
fn drawn_missions_of_the_delivery_go_as_they_went() {
    type Delivering = Decider<
        delivery::Program,
        { delivery::SIZE.words },
        { delivery::SIZE.clocks },
        { delivery::SIZE.slots },
    >;
    let mut effort = Effort::new(20);
    for seed in 0..300 {
        let mut draw = Draw::new(seed);
        let planned = chance(&mut draw, 30).then(|| *pick(&mut draw, Configuration::ALL));
        let mut decider = Delivering::start(delivery::Program, 4, planned);
        if seed % 10 == 9 {
            let faulty = Modules::of(&[*pick(&mut draw, Module::ALL)]);
            decider.restart(*decider.level(), Health { faulty, ..Health::SOUND });
        }
        play(&mut effort, seed, decider);
    }
    effort.compare("tests/golden/changed_deliveries.txt");
}

#[test]
fn drawn_missions_in_which_modules_return_go_as_they_went() {
    type Recovering = Decider<
        recovering::Program,
        { recovering::SIZE.words },
        { recovering::SIZE.clocks },
        { recovering::SIZE.slots },
    >;
    let mut effort = Effort::new(20);
    for seed in 1_000..1_300 {
        let decider = Recovering::start(recovering::Program, 4, None).with_returns();
        play(&mut effort, seed, decider);
    }
    effort.compare("tests/golden/changed_returns.txt");
}

#[test]
fn each_transition_of_the_supervisors_has_its_name() {
    let mut effort = Effort::new(1);
    let level = cotama_models::cotama::DecisionalLevel::default();
    for component in 0..20 {
        for id in 0..40 {
            let id = cotama_core::net::TransitionId(id);
            effort.note(&level.named(cotama_core::system::Of { component, id }));
        }
    }
    effort.note(&(Cause::default(), level.snapshot()));
    effort.next();
    effort.compare("tests/golden/changed_names.txt");
}

#[test]
fn who_plans_nothing_is_never_over_and_never_short() {
    let mut none = NoPlans;
    assert_eq!((none.is_over(), none.configuration(), none.short()), (false, None, None));
    assert_eq!(none.plan(Why::Margin(0), Modules::ALL), Ok(false));
}

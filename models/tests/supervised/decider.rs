//! The decisional level as one component: flags in, requests out.

use cotama_core::units::{MillimetresPerSecond, Millis};
use cotama_models::cotama::FailureMode::{self, Bmp1, Mot3, Opr1, Son1, Son2};
use cotama_models::cotama::{
    Body, Configuration, Decider, DeliveryDecider, Diagnosis, FailureModes, Finding, Flag, Flags,
    Modules, NoPlanLeft, NoPlans, PATIENCE, PATIENCE_WITH_PLANNER, Perceived, Plans, Requests,
    Resource, Resources, Told, Why, Word, available, delivery, faults, operator,
};

const STANDS: Body = Body { at_goal: false, stands: true };
const QUIET: Perceived = Perceived::nothing(Modules::ALL);

/// The delivery robot, stepped by hand.
struct Robot {
    decider: DeliveryDecider,
    now: u64,
}

impl Robot {
    /// On its first drive, by all modules.
    fn following() -> Self {
        let mut robot = Self::given(Word::MissionReceived);
        robot.step(QUIET, None);
        robot.step(QUIET, Some(Word::PathReady));
        robot
    }

    fn given(word: Word) -> Self {
        let decider = DeliveryDecider::start(delivery::Program, 4, None);
        let mut robot = Self { decider, now: 0 };
        robot.step(QUIET, Some(word));
        robot
    }

    fn step(&mut self, seen: Perceived, said: Option<Word>) -> (Option<Finding>, Option<Told>) {
        self.step_with(seen, said, &mut NoPlans)
    }

    fn step_with(
        &mut self,
        seen: Perceived,
        said: Option<Word>,
        plans: &mut impl Plans,
    ) -> (Option<Finding>, Option<Told>) {
        self.now += 100;
        let found = self.decider.perceive(Millis(self.now), seen, plans);
        let round = self.decider.round(Millis(self.now), said, STANDS, &mut ());
        (found.or(round.finding), round.told)
    }

    fn sees(&mut self, flags: &[Flag]) -> Finding {
        self.step(Perceived { raised: Flags::of(flags), ..QUIET }, None).0.unwrap()
    }

    fn after(&mut self, periods: u64) -> Requests {
        for _ in 0..periods {
            self.step(QUIET, None);
        }
        self.decider.requests()
    }
}

#[test]
fn what_it_is_given_are_flags_of_observers_and_no_failure() {
    // Every field of every input: none is, or holds, a failure mode.
    let Perceived { raised, lowered, part, works } = QUIET;
    let _: (Flags, Flags, Modules, Modules) = (raised, lowered, part, works);
    let Body { at_goal, stands } = STANDS;
    let _: (bool, bool) = (at_goal, stands);
    let words = [Word::MissionReceived, Word::ObjectReceived, Word::ObjectDelivered];
    for word in words.into_iter().chain([Word::WaitOver, Word::PathReady]) {
        match word {
            Word::MissionReceived
            | Word::ObjectReceived
            | Word::ObjectDelivered
            | Word::WaitOver
            | Word::PathReady => {}
            Word::Operator(it) => {
                let _: operator::Event = it;
            }
        }
    }
}

#[test]
fn failures_that_show_the_same_are_answered_the_same() {
    // A stall is a missed contact or a carpet edge: it does not know which, and asks.
    assert_eq!(Bmp1.rule().signature.always, Mot3.rule().signature.always);
    let mut robot = Robot::following();
    let finding = robot.sees(&[Flag::Stall]);
    assert_eq!(finding.diagnosis, Diagnosis::Ambiguous(FailureModes::of(&[Bmp1, Mot3])));
    let requests = robot.after(3);
    assert!(requests.ask && !requests.drive && !requests.halt);
}

#[test]
fn a_sonar_that_sees_too_far_costs_the_sonars_and_the_speed() {
    let mut robot = Robot::following();
    let before = robot.decider.requests();
    assert_eq!(before.configuration, Some(Configuration::FollowingOptimal));
    assert_eq!((before.drive, before.speed), (true, MillimetresPerSecond(300)));
    let finding = robot.sees(&[Flag::SonarFar]);
    assert_eq!(finding.diagnosis, Diagnosis::Unique(Son1));
    assert_eq!((finding.cause.0, finding.recorded), (1, false));
    let left = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
    assert_eq!(robot.decider.available(), left);
    let after = robot.after(3);
    assert_eq!(after.configuration, Some(Configuration::FollowingDegraded));
    assert_eq!((after.drive, after.speed), (true, MillimetresPerSecond(150)));
    // The array falls silent as well: nobody looks any more, and there is nothing new to tell.
    assert_eq!(robot.sees(&[Flag::SonarSilent]).diagnosis, Diagnosis::None);
    assert_eq!(Son2.rule().signature.always, Flags::of(&[Flag::SonarSilent]));
}

#[test]
fn a_failure_that_has_passed_does_not_hide_another_one() {
    let mut robot = Robot::following();
    assert_eq!(robot.sees(&[Flag::SonarFar]).diagnosis, Diagnosis::Unique(Son1));
    robot.step(Perceived { lowered: Flags::of(&[Flag::SonarFar]), ..QUIET }, None);
    assert_eq!(robot.sees(&[Flag::SonarSilent]).diagnosis, Diagnosis::Unique(Son2));
}

#[test]
fn two_losses_at_once_are_told_one_a_round_and_what_is_said_waits() {
    let mut robot = Robot::following();
    let both = Perceived { raised: Flags::of(&[Flag::SonarFar, Flag::NoFrame]), ..QUIET };
    let (finding, first) = robot.step(both, Some(Word::PathReady));
    assert_eq!(finding.unwrap().diagnosis, Diagnosis::Unexplained);
    let second = robot.step(QUIET, Some(Word::PathReady)).1;
    let mut told = vec![first.unwrap(), second.unwrap()];
    while !robot.decider.listens() {
        told.extend(robot.step(QUIET, None).1);
    }
    let failure = |it| Told::Failure(it);
    assert!(told.contains(&failure(faults::Event::lose_sonar)), "{told:?}");
    assert!(told.contains(&failure(faults::Event::lose_camera)), "{told:?}");
    assert!(!told.contains(&Told::Drive(cotama_models::cotama::local::Event::path_ready)));
}

#[test]
fn a_planner_that_is_silent_for_too_long_has_failed() {
    let mut robot = Robot::given(Word::MissionReceived);
    let told = |robot: &mut Robot, until: u64| {
        let mut told = Vec::new();
        while robot.now < until {
            told.extend(robot.step(QUIET, None).1);
        }
        told
    };
    assert_eq!(told(&mut robot, PATIENCE_WITH_PLANNER.0), []);
    let failed = Told::Failure(faults::Event::no_path);
    assert_eq!(told(&mut robot, PATIENCE_WITH_PLANNER.0 + 500), [failed]);
    assert_eq!(robot.decider.plannings_failed(), 1);
    assert!(robot.decider.requests().ask);
}

#[test]
fn an_operator_who_is_silent_for_too_long_ends_the_mission_once() {
    let mut robot = Robot::following();
    robot.sees(&[Flag::Stall]);
    assert!(robot.after(3).ask);
    let asked = robot.decider.since().0;
    let mut findings = Vec::new();
    while !robot.decider.requests().alarm && robot.now < 200_000 {
        findings.extend(robot.step(QUIET, None).0.map(|it| (robot.now, it)));
    }
    let [(at, silence)] = findings[..] else { panic!("{findings:?}") };
    assert_eq!(silence.diagnosis, Diagnosis::Unique(Opr1));
    assert_eq!(at - asked, PATIENCE.0 + 100);
    let requests = robot.decider.requests();
    assert!(requests.halt && requests.alarm && !requests.drive);
}

/// A plan that needs the sonars, and a limit that cannot be kept without them.
struct Tight {
    asked: Vec<(Why, Modules)>,
    short: Option<usize>,
}

impl Plans for Tight {
    fn is_over(&self) -> bool {
        false
    }

    fn plan(&mut self, why: Why, available: Modules) -> Result<bool, NoPlanLeft> {
        self.asked.push((why, available));
        Err(NoPlanLeft)
    }

    fn configuration(&self) -> Option<Configuration> {
        None
    }

    fn short(&self) -> Option<usize> {
        self.short
    }
}

#[test]
fn no_plan_that_keeps_the_limits_is_a_question_to_the_operator() {
    let mut robot = Robot::following();
    let mut plans = Tight { asked: Vec::new(), short: None };
    let seen = Perceived { raised: Flags::of(&[Flag::SonarFar]), ..QUIET };
    robot.step_with(seen, None, &mut plans);
    let left = robot.decider.relied_on();
    let modules = Modules::ALL.without(left);
    let broken = Son1.health(Modules::NONE);
    assert_eq!(plans.asked, [(Why::Lost { modules, broken }, left)]);
    assert!(robot.after(6).ask);
}

#[test]
fn a_margin_below_zero_is_looked_at_once_a_second_and_asked_about_once() {
    let mut robot = Robot::following();
    let mut plans = Tight { asked: Vec::new(), short: Some(1) };
    while robot.now < 5_000 {
        robot.step_with(QUIET, None, &mut plans);
    }
    assert_eq!(plans.asked, [(Why::Margin(1), Modules::ALL)]);
    assert!(robot.decider.requests().ask);
}

#[test]
fn flags_that_no_row_explains_are_for_the_operator_and_never_a_panic() {
    for &a in Flag::ALL {
        for &b in FailureMode::ALL {
            let mut robot = Robot::following();
            robot.step(Perceived { raised: Flags::of(&[a]), ..QUIET }, None);
            let raised = b.rule().signature.always.with(a);
            robot.step(Perceived { raised, part: Modules::ALL, ..QUIET }, None);
            let requests = robot.after(40);
            assert!(!(requests.halt && requests.drive), "{a:?} {b:?}");
        }
    }
}

/// Localisation and avoidance fall silent at once, and avoidance is sound 5 s before localisation:
/// what took both is over when both have been sound for 10 s.
#[test]
fn what_took_several_modules_is_over_when_all_of_them_are_sound() {
    use cotama_models::cotama::{Module, recovering};
    type Recovering = Decider<
        recovering::Program,
        { recovering::SIZE.words },
        { recovering::SIZE.clocks },
        { recovering::SIZE.slots },
    >;
    let mut decider = Recovering::start(recovering::Program, 4, None).with_returns();
    let both = Modules::of(&[Module::Mcl, Module::Dvz]);
    let silent = Flags::of(&[Flag::ModuleSilent]);
    let (mut now, mut returned) = (0, Vec::new());
    while now < 40_000 {
        now += 100;
        let gone = match now {
            ..1_000 => Modules::NONE,
            1_000..10_000 => both,
            10_000..15_000 => Modules::of(&[Module::Mcl]),
            _ => Modules::NONE,
        };
        let works = Modules::ALL.without(gone);
        let (mut raised, mut lowered) = (Flags::NONE, Flags::NONE);
        match now {
            1_000 => raised = silent,
            10_000 => lowered = silent,
            _ => {}
        }
        let before = decider.available();
        let seen = Perceived { raised, lowered, part: both, works };
        decider.perceive(Millis(now), seen, &mut NoPlans);
        let _ = decider.round(Millis(now), None, STANDS, &mut ());
        if decider.available() != before {
            returned.push((now, decider.available()));
        }
    }
    assert_eq!(returned, [(1_000, Modules::ALL.without(both)), (25_000, Modules::ALL)]);
}

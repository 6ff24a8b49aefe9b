//! The decisional level as one component: flags in, requests out.

use cotama_core::units::{MillimetresPerSecond, Millis};
use cotama_models::cotama::FailureMode::{self, Bmp1, Mot3, Opr1, Son1, Son2};
use cotama_models::cotama::{
    Body, Class, Configuration, DeliveryDecider, Diagnosis, FailureModes, Finding, Flag, Flags,
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
fn the_decider_is_given_flags_of_observers_and_no_failure() {
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
    let first = robot.sees(&[Flag::SonarFar]);
    assert_eq!((first.diagnosis, first.cause.0), (Diagnosis::Unique(Son1), 1));
    robot.step(Perceived { lowered: Flags::of(&[Flag::SonarFar]), ..QUIET }, None);
    let second = robot.sees(&[Flag::SonarSilent]);
    assert_eq!((second.diagnosis, second.cause.0), (Diagnosis::Unique(Son2), 2));
}

#[test]
fn two_losses_at_once_are_told_one_a_round_and_words_wait() {
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
    let first = robot.now + 100;
    assert_eq!(told(&mut robot, first), []);
    let since = robot.decider.since().0;
    assert_eq!(told(&mut robot, since + PATIENCE_WITH_PLANNER.0 - 100), []);
    let failed = Told::Failure(faults::Event::no_path);
    assert_eq!(told(&mut robot, since + PATIENCE_WITH_PLANNER.0), [failed]);
    assert_eq!(robot.decider.plannings_failed(), 1);
    assert!(robot.after(3).ask);
}

#[test]
fn a_planner_has_not_failed_while_a_failure_is_still_to_be_told() {
    let mut robot = Robot::given(Word::MissionReceived);
    robot.step(QUIET, None);
    let last = robot.decider.since().0 + PATIENCE_WITH_PLANNER.0 - 100;
    while robot.now < last {
        robot.step(QUIET, None);
    }
    let told = robot.step(Perceived { raised: Flags::of(&[Flag::SonarFar]), ..QUIET }, None).1;
    assert_eq!(told, Some(Told::Failure(faults::Event::lose_sonar)));
    assert_eq!(robot.decider.plannings_failed(), 0);
    while !robot.decider.listens() {
        robot.step(QUIET, None);
    }
    robot.step(QUIET, None);
    assert_eq!(robot.decider.plannings_failed(), 1);
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
    // The mission is in `Safe`, behind waiting, four objectives, done and security.
    assert_eq!(robot.decider.global().0, 7);
}

#[test]
fn an_operator_who_drives_is_not_silent_until_the_robot_stands() {
    let mut robot = Robot::following();
    robot.sees(&[Flag::Stall]);
    assert!(robot.after(3).ask);
    robot.step(QUIET, Some(Word::Operator(operator::Event::teleoperate)));
    robot.after(2);
    let mut until_found = |stands: bool, until: u64| {
        while robot.now < until {
            robot.now += 100;
            let now = Millis(robot.now);
            assert_eq!(robot.decider.perceive(now, QUIET, &mut NoPlans), None);
            let body = Body { at_goal: false, stands };
            if robot.decider.round(now, None, body, &mut ()).finding.is_some() {
                break;
            }
        }
        robot.now
    };
    assert_eq!(until_found(false, 300_000), 300_000);
    assert_eq!(until_found(true, 600_000), 300_000 + PATIENCE.0);
}

/// A plan that needs the sonars, and a limit that cannot be kept without them.
#[derive(Default)]
struct Tight {
    asked: Vec<(Why, Modules)>,
    short: Option<usize>,
    over: bool,
}

impl Plans for Tight {
    fn is_over(&self) -> bool {
        self.over
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
    let mut plans = Tight::default();
    let seen = Perceived { raised: Flags::of(&[Flag::SonarFar]), ..QUIET };
    robot.step_with(seen, None, &mut plans);
    let left = robot.decider.relied_on();
    let modules = Modules::ALL.without(left);
    let broken = Son1.health(Modules::NONE);
    assert_eq!(plans.asked, [(Why::Lost { modules, broken }, left)]);
    assert!(robot.after(6).ask);
}

#[test]
fn when_all_is_done_nothing_is_planned_again() {
    let mut robot = Robot::following();
    let mut plans = Tight { over: true, ..Tight::default() };
    let seen = Perceived { raised: Flags::of(&[Flag::SonarFar]), ..QUIET };
    robot.step_with(seen, None, &mut plans);
    assert_eq!(plans.asked, []);
}

/// He drives, and the link to him is lost: nobody can be asked whether the robot goes on alone.
#[test]
fn an_operator_who_cannot_be_reached_is_no_way_out() {
    let mut robot = Robot::following();
    robot.sees(&[Flag::Stall]);
    assert!(robot.after(3).ask);
    robot.step(QUIET, Some(Word::Operator(operator::Event::teleoperate)));
    robot.after(2);
    let judged = robot.sees(&[Flag::LinkDown]).judged.unwrap();
    assert_eq!(judged.by_availability, Class::Global);
}

#[test]
fn a_margin_below_zero_is_looked_at_once_a_second_and_asked_about_once() {
    let mut robot = Robot::following();
    let mut plans = Tight { short: Some(1), ..Tight::default() };
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

/// A plan that is always there, and never keeps its limit.
struct Short(u32);

impl Plans for Short {
    fn is_over(&self) -> bool {
        false
    }

    fn plan(&mut self, _: Why, _: Modules) -> Result<bool, NoPlanLeft> {
        self.0 += 1;
        Ok(true)
    }

    fn configuration(&self) -> Option<Configuration> {
        None
    }

    fn short(&self) -> Option<usize> {
        Some(0)
    }
}

#[test]
fn a_margin_below_zero_is_planned_away_once_a_second() {
    let (mut robot, mut plans) = (Robot::following(), Short(0));
    assert!(robot.now < 1_000);
    while robot.now < 5_900 {
        robot.step_with(QUIET, None, &mut plans);
    }
    assert_eq!(plans.0, 5);
    assert!(!robot.decider.requests().ask);
}

/// The adapter takes fewer particles while readings are rejected, and for five seconds afterwards.
#[test]
fn an_adapted_setting_lasts_for_five_seconds_after_its_flag() {
    let mut robot = Robot::following();
    robot.sees(&[Flag::SonarOutliers]);
    robot.after(9);
    let last_seen = robot.now;
    robot.step(Perceived { lowered: Flags::of(&[Flag::SonarOutliers]), ..QUIET }, None);
    assert_eq!(robot.decider.requests().adjusted.quality, 750);
    while robot.decider.requests().adjusted.quality < 1_000 {
        robot.after(1);
    }
    assert_eq!(robot.now - last_seen, 5_000);
}

#[test]
fn a_bump_on_the_way_makes_the_robot_go_carefully() {
    let mut robot = Robot::following();
    let before = robot.after(1);
    let finding = robot.sees(&[Flag::Bumper]);
    assert_eq!(finding.diagnosis, Diagnosis::Unique(FailureMode::Col1));
    let after = robot.after(3);
    assert!(after.drive && !after.ask);
    // In thousandths.
    assert_eq!((before.adjusted.speed, after.adjusted.speed), (1_000, 500));
}

//! Drawn losses and flags: what is available, diagnosed, reported and decided.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::{chance, pick};
use cotama_core::executive::{Overruns, TaskSet};
use cotama_models::cotama::load::{self, Load, MOST, SPARE};
use cotama_models::cotama::{
    Adjustment, Adjustments, Configuration, FailureMode, FailureModes, Flag, Flags, Health, Loss,
    Losses, Mode, Module, Modules, Probe, Probes, Report, Resource, Resources, Return, Severity,
    Situation, Told, ambiguity_groups, are_confusable, available, by_availability, by_rules,
    by_severity, confusable_pairs, decide, diagnose, is_detectable, is_settled, judge, local,
    lost_after, path_following, severity, shared_flags, teleoperation, undetectable, unwatched,
};

const MODES: [Mode; 5] =
    [Mode::Rest, Mode::Autonomous, Mode::HandOver, Mode::Teleprogrammed, Mode::Teleoperated];

/// Some of these, mostly few.
fn few<T: Copy>(draw: &mut Draw, from: &[T]) -> Vec<T> {
    (0..draw.between(0, 3)).map(|_| *pick(draw, from)).collect()
}

#[test]
fn losses_leave_the_same_modules_and_configurations() {
    let (mut draw, mut effort) = (Draw::new(101), Effort::new(100));
    for _ in 0..2_000 {
        let faulty = Modules::of(&few(&mut draw, Module::ALL));
        let lost = Resources::of(&few(&mut draw, Resource::ALL));
        let suspected = Modules::of(&few(&mut draw, Module::ALL));
        let left = available(faulty, lost);
        effort.count("modules left", left.len() as u64);
        let health = Health { faulty, lost, suspected };
        let status = health.status_vector();
        effort.note(&(health, health.available(), health.relied_on(), status));
        effort.note(&(status.available(), status.suspect(), health.union(unwatched(left))));
        effort.note(&Module::ALL.iter().map(|it| status.of(*it)).collect::<Vec<_>>());
        let runs = |it: &&Configuration| it.runs_on(left);
        effort.note(&Configuration::ALL.iter().filter(runs).collect::<Vec<_>>());
        effort.note(&(Configuration::running_on(left), Losses::lacking(left)));
        effort.note(&Return::ALL.map(|it| (it.loss(), it.works(left))));
        effort.note(&Loss::ALL.iter().map(|it| Told::lost(*it, health)).collect::<Vec<_>>());
        effort.note(&(undetectable(left), unwatched(left), Flags::seen_by(left)));
        effort.note(&ambiguity_groups(left).collect::<Vec<_>>());
        effort.note(&confusable_pairs(left).collect::<Vec<_>>());
        if effort.instances() == 3 {
            // They try many sets of probes.
            effort.note(&(Probes::least(left), Probes::least_that_help(left)));
        }
        let (a, b) = (*pick(&mut draw, FailureMode::ALL), *pick(&mut draw, FailureMode::ALL));
        effort.note(&(is_detectable(a, left), are_confusable(a, b, left)));
        effort.note(&Probes::that_separate(a, b, left));
        effort.note(&Probe::ALL.iter().map(|it| it.separates(a, b)).collect::<Vec<_>>());
        let some = FailureModes::of(&few(&mut draw, FailureMode::ALL));
        effort.note(&(some, shared_flags(some, left)));
        // As the flags of a failure are raised, and others.
        let of_a = a.rule().signature.always;
        let flags = Flags::of(&few(&mut draw, Flag::ALL));
        for raised in [of_a, of_a.union(flags), flags] {
            let found = diagnose(raised, left);
            let part = Modules::of(&[*pick(&mut draw, Module::ALL)]);
            effort.note(&(found, found.health(part)));
            for mode in MODES {
                effort.note(&found.judged(raised, mode));
            }
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_health.txt");
}

#[test]
fn each_member_of_each_list_has_its_facts() {
    let mut effort = Effort::new(1);
    for it in Module::ALL {
        effort.note(&(it, it.name(), it.doc(), it.facts(), Module::named(it.name())));
    }
    effort.next();
    for it in Configuration::ALL {
        effort.note(&(it, it.name(), it.doc(), it.facts(), it.scheduled()));
    }
    effort.next();
    for it in FailureMode::ALL {
        effort.note(&(it, it.name(), it.rule(), it.description(), it.adjustment()));
        for mode in MODES {
            effort.note(&it.severity(mode));
        }
        for part in Module::ALL {
            effort.note(&it.health(Modules::of(&[*part])));
        }
    }
    effort.next();
    for it in Flag::ALL {
        effort.note(&(it, it.name(), it.doc(), it.observers(), it.observed()));
        effort.note(&(it.is_seen_by(Modules::ALL), it.is_seen_by(Modules::NONE)));
    }
    effort.next();
    for it in Probe::ALL {
        effort.note(&(it, it.name(), it.doc(), it.shows(), it.needs()));
    }
    effort.next();
    for it in Report::ALL {
        effort.note(&(it, it.name(), it.loss()));
    }
    effort.next();
    for it in Adjustment::ALL {
        effort.note(&(it, it.name(), it.doc(), MODES.map(|mode| it.effect(mode))));
    }
    effort.next();
    for it in [Severity::Weak, Severity::Medium, Severity::Hard, Severity::Fatal] {
        effort.note(&(it, it.class(), it.name()));
    }
    for it in Loss::ALL {
        effort.note(&(it, it.name(), it.doc(), Loss::named(it.name()), Loss::named("")));
    }
    for it in Resource::ALL {
        effort.note(&(it, it.name(), it.doc()));
    }
    effort.next();
    effort.compare("tests/golden/changed_facts.txt");
}

/// The sets are sets of their members.
#[test]
fn drawn_sets_are_united_cut_and_named_the_same() {
    let (mut draw, mut effort) = (Draw::new(102), Effort::new(500));
    for _ in 0..1_000 {
        let a = Modules::of(&few(&mut draw, Module::ALL));
        let b = Modules::of(&few(&mut draw, Module::ALL));
        let one = *pick(&mut draw, Module::ALL);
        effort.note(&(a.with(one), a.without(b), a.union(b), a.common(b), a.has(one)));
        effort.note(&(a.covers(b), a.is(b), a.is(a), a.is_empty(), a.len(), a.first()));
        effort.note(&(a.bits(), Modules::from_bits(a.bits()), a.to_string()));
        effort.note(&(a.iter().collect::<Vec<_>>(), Modules::from_bits(1 << draw.between(0, 31))));
        let adjusted = Adjustments::of(&few(&mut draw, Adjustment::ALL));
        effort.note(&(adjusted, MODES.map(|mode| adjusted.effect(mode))));
        effort.next();
    }
    effort.compare("tests/golden/changed_sets.txt");
}

#[test]
fn drawn_situations_are_judged_the_same() {
    use local::State::{End, Following, HandOver, Idle, Planning, Teleoperated, Teleprogrammed};
    use path_following::State::{Degraded, Odometric, Off, Optimal, Reactive, Reduced};
    let locals = [Idle, Planning, Following, HandOver, Teleprogrammed, Teleoperated, End];
    let followings = [Off, Optimal, Reduced, Odometric, Reactive, Degraded];
    let driven =
        [teleoperation::State::Off, teleoperation::State::Full, teleoperation::State::Degraded];
    let (mut draw, mut effort) = (Draw::new(103), Effort::new(500));
    while effort.instances() < 10_000 {
        let situation = Situation {
            local: *pick(&mut draw, &locals),
            following: *pick(&mut draw, &followings),
            teleoperation: *pick(&mut draw, &driven),
            level: draw.between(0, 3) as u8,
            lost: Losses::of(&few(&mut draw, Loss::ALL)),
        };
        if !situation.is_consistent() && chance(&mut draw, 90) {
            continue;
        }
        effort.count("consistent", u64::from(situation.is_consistent()));
        effort.note(&(situation, situation.mode(), situation.configuration()));
        effort.note(&(situation.lost.health(), situation.lost.available()));
        let report = *pick(&mut draw, Report::ALL);
        let (decided, ruled) = (decide(report, situation), by_rules(report, situation));
        effort.note(&(report, decided, ruled, decided.class().name()));
        effort.note(&(decided.class().worse(ruled.class()), ruled.class().name()));
        effort.note(&(severity(report, situation), by_severity(report, situation)));
        effort.note(&(is_settled(report, situation), lost_after(report, situation)));
        for it in [Severity::Weak, Severity::Medium, Severity::Hard, Severity::Fatal] {
            effort.note(&judge(report, it, situation));
        }
        let left = available(
            Modules::of(&few(&mut draw, Module::ALL)),
            Resources::of(&few(&mut draw, Resource::ALL)),
        );
        for operator in [true, false] {
            effort.note(&by_availability(situation, left, operator));
        }
        let mode = *pick(&mut draw, FailureMode::ALL);
        let part = Modules::of(&[*pick(&mut draw, Module::ALL)]);
        effort.note(&(mode.effective(part, situation), situation.lost.following()));
        for planned in Configuration::ALL {
            effort.note(&situation.lost.beside(*planned));
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_situations.txt");
}

#[test]
fn every_configuration_has_the_same_response_times_under_every_load() {
    let mut effort = Effort::new(1);
    for load in [Load::Quiet, Load::Busy, Load::Heavy] {
        for &configuration in Configuration::ALL {
            let mut memory = [SPARE; MOST];
            effort.note(&load::most_particles(configuration, load, &mut memory));
            for particles in [0, 1, 50, 100, 101, 150, 400, u32::MAX] {
                let tasks = load::tasks(configuration, load, particles, &mut memory);
                effort.note(&tasks);
                let set = TaskSet::new(tasks);
                effort.note(&set.err());
                let Ok(set) = set else { continue };
                for overruns in [Overruns::None, Overruns::One, Overruns::All] {
                    effort.note(&set.response_times(overruns).collect::<Vec<_>>());
                }
            }
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_load.txt");
}

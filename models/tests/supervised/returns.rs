//! The modules that the decisional level uses again where they may return, and when.

use cotama_core::units::Millis;
use cotama_models::cotama::Return::{Avoidance, Mcl, Sonar};
use cotama_models::cotama::{
    Body, Decider, Flag, Module, Modules, NoPlans, Perceived, Resource, Resources, Return, Told,
    available, recovering,
};

const STANDS: Body = Body { at_goal: false, stands: true };
const QUIET: Perceived = Perceived::nothing(Modules::ALL);

/// From when to when (ms) a flag is up, of which module, and which modules are broken then.
type Span = (u64, u64, Flag, Modules, Modules);

/// When the modules that the decisional level takes for available become more, where modules may
/// return: the time, what is missing still, and what the
/// supervisors are told of it.
fn returns(spans: &[Span]) -> (Vec<(u64, Modules)>, Vec<Return>) {
    type Recovering = Decider<
        recovering::Program,
        { recovering::SIZE.words },
        { recovering::SIZE.clocks },
        { recovering::SIZE.slots },
    >;
    let mut decider = Recovering::start(recovering::Program, 4, None).with_returns();
    let (mut returned, mut told) = (Vec::new(), Vec::new());
    for now in (100..50_000).step_by(100) {
        let mut seen = QUIET;
        for &(from, to, flag, part, gone) in spans {
            if now == from {
                (seen.raised, seen.part) = (seen.raised.with(flag), part);
            }
            if now == to {
                seen.lowered = seen.lowered.with(flag);
            }
            if (from..to).contains(&now) {
                seen.works = seen.works.without(gone);
            }
        }
        let before = decider.available();
        decider.perceive(Millis(now), seen, &mut NoPlans);
        let round = decider.round(Millis(now), None, STANDS, &mut ());
        told.extend(
            round.told.and_then(|it| if let Told::Return(it) = it { Some(it) } else { None }),
        );
        let after = decider.available();
        if after != before && after.covers(before) {
            returned.push((now, Modules::ALL.without(after)));
        }
    }
    (returned, told)
}

/// Localisation and avoidance fall silent at once, and avoidance is sound 5 s before localisation:
/// what took both is over when both have been sound for 10 s.
#[test]
fn a_failure_of_several_modules_is_over_when_all_of_them_are_sound() {
    let [dvz, mcl] = [Module::Dvz, Module::Mcl].map(|it| Modules::of(&[it]));
    let both = dvz.union(mcl);
    let spans = [
        (1_000, 10_000, Flag::ModuleSilent, both, dvz),
        (1_100, 15_000, Flag::OneLate, Modules::NONE, mcl),
    ];
    assert_eq!(returns(&spans).0, [(25_000, Modules::NONE)]);
}

/// Nothing asks for the camera to return, so what took it as well is never over.
#[test]
fn a_failure_of_a_module_that_does_not_return_is_not_over() {
    let both = Modules::of(&[Module::Cam, Module::Mcl]);
    assert_eq!(returns(&[(1_000, 10_000, Flag::ModuleSilent, both, both)]).0, []);
}

/// The sonars return twice, which is all that they may; localisation returned with them and has
/// its own returns still.
#[test]
fn a_module_that_returns_with_the_sonars_keeps_its_own_returns() {
    let left = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
    let gone = Modules::ALL.without(left);
    let mcl = Modules::of(&[Module::Mcl]);
    let spans = [
        (1_000, 2_000, Flag::SonarSilent, Modules::NONE, gone),
        (13_000, 14_000, Flag::SonarSilent, Modules::NONE, gone),
        (25_000, 26_000, Flag::ModuleSilent, mcl, mcl),
    ];
    let whole = |now| (now, Modules::NONE);
    let (returned, told) = returns(&spans);
    assert_eq!(returned, [12_000, 24_000, 36_000].map(whole));
    // Losses hidden by the sonars are reported first, so that they are there when the sonars are.
    assert_eq!(told, [Mcl, Avoidance, Sonar, Mcl, Avoidance, Sonar, Mcl]);
}

/// The sonars are read again, but the flag that they fell silent is not lowered.
#[test]
fn a_failure_that_is_still_shown_is_not_over() {
    let left = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
    let gone = Modules::ALL.without(left);
    let shown = (1_000, 50_000, Flag::SonarSilent, Modules::NONE, Modules::NONE);
    let lost = (1_000, 2_000, Flag::OneLate, Modules::NONE, gone);
    assert_eq!(returns(&[shown, lost]).0, []);
}

/// The sonars are read again for 28 s, and then the flag is lowered: they are sound from there on,
/// and are used after ten seconds, as any others.
#[test]
fn a_flag_that_is_lowered_late_gives_its_modules_back() {
    let left = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
    let gone = Modules::ALL.without(left);
    let shown = (1_000, 30_000, Flag::SonarSilent, Modules::NONE, Modules::NONE);
    let lost = (1_000, 2_000, Flag::OneLate, Modules::NONE, gone);
    let (returned, told) = returns(&[shown, lost]);
    assert_eq!(returned, [(40_000, Modules::NONE)]);
    assert_eq!(told, [Mcl, Avoidance, Sonar]);
}

/// A false alarm: a flag is up for a second though all modules say that they work. Two of them are
/// two returns, and the third one is for good.
#[test]
fn a_flag_that_goes_up_and_down_is_held_back_as_a_loose_contact_is() {
    let alarm = |from| (from, from + 1_000, Flag::SonarSilent, Modules::NONE, Modules::NONE);
    let whole = |now| (now, Modules::NONE);
    let (returned, _) = returns(&[alarm(1_000), alarm(5_000), alarm(20_000), alarm(33_000)]);
    assert_eq!(returned, [16_000, 31_000].map(whole));
}

//! The component of the boards beside a simulated robot: with the same flags it comes to the same.

use super::world::World;
use super::{Driven, Injection, Memory, SLOTS, Script};
use crate::plan::{Planning, Progress};
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::level::{Cause, Decider, Drive, Level, Perceived, Tables, Told};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{Moment, RobotFile};
use proptest::prelude::*;
use std::sync::LazyLock;

fn driven<P: Program<W, 0, SLOTS> + Copy, const W: usize>(
    it: &Driven<'_>,
    tables: &Tables<'_>,
    program: P,
    script: &Script,
) -> usize {
    let start = Progress::start(Millimetres(0));
    let planning = Planning::start(&it.plannable, &start, it.mission.available()).unwrap();
    let watching = super::Watching::new(&it.monitors);
    let world = World::start(tables, program, planning, script, None, Millis(1_000), watching);
    let mut world = world.unwrap();
    let mut twin = Decider::new(Level::start(tables, program));
    let (mut compared, mut up) = (0, 0);
    let robot = it.mission.robot().unwrap().robot();
    loop {
        let before = world.run.conduct.len();
        if !world.goes_on() {
            break;
        }
        let Some(it) = world.observed.take() else { break };
        let seen = Perceived { raised: it.raised, lowered: up & !it.up, works: it.works };
        up = it.up;
        twin.perceive(it.now, seen);
        // No flag tells that no plan is left.
        let rows = &robot.failures;
        let new = world.run.conduct.iter().skip(before).filter(|it| it.detected.is_some());
        let new = new.map(|it| it.failure);
        new.filter(|it| rows[*it].no_plan).for_each(|it| twin.report(it, Cause(0)));
        let told = world.run.told.last().filter(|it| it.0 == world.run.rounds).map(|it| it.1);
        let said = told.filter(|it| !matches!(it, Told::Report(_) | Told::Back(_)));
        // The simulator says what the drive shows.
        let drive = Drive { at_goal: false, stands: false };
        let round = twin.period(it.now, said, drive, &mut ());
        let (own, other) = (world.level(), twin.level());
        assert_eq!(round.told, told, "{:?}", it.now);
        assert_eq!(
            (own.place(), own.global(), own.permits(), own.lost(), own.is_halted()),
            (other.place(), other.global(), other.permits(), other.lost(), other.is_halted())
        );
        compared += 1;
    }
    compared
}

/// The shift of a transport robot that asks first, and masks flags in all ways.
static ASKING: LazyLock<Mission> = LazyLock::new(|| {
    let more = [
        ("depth_late", "ask = { times = 1 }"),
        ("scan_late", "ask = { times = 2 }\norder = [\"ask\", \"restart\"]"),
        ("load_shift", "mask = { flags = [\"load_shift\"], on = \"order\", lasts_ms = 9_000 }"),
        ("guard_late", "mask = { flags = [\"guard_late\"], on = \"order\" }"),
        ("poor_match", "mask = { flags = [\"poor_match\"], lasts_ms = 5_000 }"),
    ];
    let text = cotama_models::robots::embedded("transport").unwrap().text.to_owned();
    let text = more.into_iter().fold(text, |text, (flag, more)| {
        let flags = format!("flags = [\"{flag}\"]");
        text.replace(&flags, &format!("{flags}\n{more}"))
    });
    let robot = RobotFile::parse("transport.toml", &text).unwrap();
    let shift = embedded::mission("shift").unwrap();
    Mission::parse_under(shift.name, shift.text, Some(robot)).unwrap()
});

fn shipped(mission: &str) -> Mission {
    let mission = embedded::mission(mission).unwrap();
    Mission::parse(mission.name, mission.text).unwrap()
}

fn compared(mission: &Mission, failures: &[(usize, u64, Option<u64>)]) -> usize {
    let it = Driven::new(mission).unwrap();
    let rows = mission.robot().unwrap().robot().failures.len();
    let injections = failures.iter().map(|(failure, at, lasts)| Injection {
        when: Moment::At(Millis(*at)),
        failure: failure % rows,
        until: lasts.map(|it| Moment::At(Millis(at + it))),
    });
    let script = Script { injections: injections.collect(), ..Script::default() };
    let tables = it.tables.view();
    it.system.with(|system| match &it.packed {
        Memory::Small(packed) => driven(&it, &tables, packed.load(system), &script),
        Memory::Large(packed) => driven(&it, &tables, packed.load(system), &script),
    })
}

proptest! {
    #[test]
    fn the_component_of_the_boards_decides_as_the_simulated_robot(
        failures in prop::collection::vec(
            (0_usize..1_000, 0_u64..200_000, prop::option::of(100_u64..60_000)), 0..6,
        ),
    ) {
        prop_assert!(compared(&shipped("delivery"), &failures) > 0);
        prop_assert!(compared(&shipped("shift"), &failures) > 0);
        prop_assert!(compared(&ASKING, &failures) > 0);
    }
}

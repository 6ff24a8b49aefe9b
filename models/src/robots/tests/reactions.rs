//! Steps that are tried first, in their order, and masks: as the observation module and the level
//! do it, and each cause of refusal once.

use super::broken::{FILE, refused};
use super::{fires, net, places};
use crate::level::{Decider, Drive, Level, Perceived, Told};
use crate::robots::supervisors::{system, word};
use crate::robots::{Decision, OwnedTables, Robot, Situation, ask_first};
use cotama_core::player::Packed;
use cotama_core::units::Millis;
use std::collections::BTreeSet;

const STUCK: &str = "severity = { autonomous = \"hard\" }\nflags = [\"stuck\"]";
const LATE: &str = "severity = { autonomous = \"medium\" }\nflags = [\"late\"]";

/// The file with more in the row of the scanner and in that of being stuck.
fn robot(scan: &str, stuck: &str) -> Robot {
    let text = FILE.replace(LATE, &format!("{LATE}\n{scan}"));
    let text = text.replace(STUCK, &format!("{STUCK}\n{stuck}"));
    Robot::parse("r.toml", &text).unwrap_or_else(|it| panic!("{it}"))
}

#[test]
fn reactions_and_masks_that_make_no_sense_are_refused() {
    let both = "[[failure]]\nid = \"STK2\"\nmode = \"stuck by a wall\"\n";
    let hides = format!("flags = [\"stuck\", \"late\"]\nmask = {{ flags = [\"late\"] }}\n{both}");
    let hard = "severity = { autonomous = \"hard\" }\nflags = [\"stuck\"]";
    let cases = [
        (
            LATE,
            format!("{LATE}\nask = {{ times = 0 }}"),
            "39:17: `times` must be 1 to 9, not `0`",
            "change the value",
        ),
        (
            LATE,
            format!("{LATE}\nmask = {{ flags = [\"stuck\"] }}"),
            "39:19: `stuck` is no flag of this failure",
            "a failure masks what it holds up itself: name one of its flags",
        ),
        (
            LATE,
            format!("{LATE}\nmask = {{ flags = [\"late\"], on = \"wish\" }}"),
            "39:33: unknown occasion `wish`",
            "known: told, order",
        ),
        (
            LATE,
            format!("{LATE}\nmask = {{ flags = [\"late\"], on = \"order\" }}"),
            "39:8: nobody is asked for `LID1`, and so nobody orders its mask",
            "call it `hard`, or add `ask = { times = 1 }`, with an operator",
        ),
        (
            LATE,
            format!("{LATE}\norder = [\"restart\"]"),
            "39:9: this failure tries nothing, and `order` says otherwise",
            "name each reaction once; `set` is tried where it has `times`",
        ),
        (
            LATE,
            format!("{LATE}\nask = {{ times = 1 }}\norder = [\"ask\", \"ask\"]"),
            "40:9: this failure tries `ask`, and `order` says otherwise",
            "name each reaction once; `set` is tried where it has `times`",
        ),
        (
            LATE,
            format!("{LATE}\nask = {{ times = 1 }}\norder = [\"aks\"]"),
            "40:10: unknown reaction `aks`; did you mean `ask`?",
            "write `ask`",
        ),
        (
            hard,
            format!("{hard}\nask = {{ times = 1 }}"),
            "52:7: `STK1` is hard, and asks the operator anyway",
            "leave `ask` out",
        ),
        (
            "severity = { autonomous = \"weak\", operator = \"fatal\" }",
            "severity = { autonomous = \"fatal\" }\nmask = { flags = [\"silent\"] }".into(),
            "45:8: `LNK1` ends the mission, and masks something",
            "leave `mask` out, or let him be asked first",
        ),
        (
            "flags = [\"stuck\"]",
            format!("{hides}{hard}"),
            "52:8: `STK1` masks `late`, and nothing else shows `LID1`",
            "let another flag show it too, or mask nothing here",
        ),
    ];
    let said = cases.each_ref().map(|it| refused(it.0, &it.1));
    assert_eq!(said, cases.map(|it| format!("r.toml:{} | help: {}", it.2, it.3)));
}

/// A robot whose operator is gone with the failure that a mask hides.
#[test]
fn a_mask_hides_nothing_hard_after_which_nobody_can_help() {
    let more = "flags = [\"stuck\", \"silent\"]\nloses = [\"radio\"]\n\
        [[failure]]\nid = \"WET1\"\nmode = \"wet\"\nseverity = { autonomous = \"weak\" }\n\
        flags = [\"late\", \"stuck\"]\nmask = { flags = [\"stuck\"] }\n\
        [[failure]]\nid = \"HIT1\"\nmode = \"hit\"\nseverity = { autonomous = \"hard\" }\n\
        flags = [\"silent\"]";
    let said = refused("flags = [\"stuck\"]", more);
    assert_eq!(
        said,
        "r.toml:58:8: `WET1` masks `stuck`, which shows `STK1`: nobody can be asked then, and \
         there is no configuration below | help: mask nothing that shows what is hard, or add one \
         that is slower"
    );
}

#[test]
fn the_contextual_net_asks_first_as_the_function_in_every_situation() {
    let robot = robot("ask = { times = 2 }", "");
    let (system, report) = (system(&robot), 0);
    let mut asks = 0;
    for (at, marked) in places(&robot) {
        for lost in (0..=robot.losses.all()).filter(|it| it & 1 == 1) {
            let losses = robot.losses.losses.iter().enumerate();
            let losses = losses.filter(|it| lost >> it.0 & 1 == 1);
            let losses = losses.map(|it| format!("lost_{}", word(&it.1.name)));
            let marked: BTreeSet<_> = marked.iter().cloned().chain(losses).collect();
            let said = fires(net(&system, "cs"), "ask_LID1", &marked).map(|it| it.concat());
            let expected = match ask_first(&robot, report, Situation { at, lost }) {
                Decision::Record => None,
                Decision::Ask => Some("local_event"),
                Decision::Stop => Some("global_event"),
                Decision::Adapt => Some("adapt_Follow"),
            };
            assert_eq!(said.as_deref(), expected, "{at:?} {lost:b}");
            asks += u32::from(said.as_deref() == Some("local_event"));
        }
    }
    assert_eq!(asks, 3); // in three configurations, as long as the link works
}

#[test]
fn reactions_are_tried_in_the_order_of_the_row() {
    let tries = "restart = { module = \"scan\", times = 1 }\nask = { times = 1 }\n\
        set = { speed_permille = 500, times = 1 }";
    let order = |order: &str| {
        let robot = robot(&format!("{tries}\n{order}"), "");
        let system = system(&robot);
        let gom = net(&system, "gom");
        let lines = gom.transitions.iter().filter(|it| it.name.starts_with("LID1_"));
        let lines: Vec<_> =
            lines.map(|it| it.name.trim_start_matches("LID1_").to_owned()).collect();
        (lines.join(" "), robot.failures[0].reaction(&robot))
    };
    assert_eq!(
        order(""),
        (
            "restarts sets asks asks_again again".to_owned(),
            "start scan anew once; then set 50 % of the speed once; then stop, ask the operator \
             once; then another configuration"
                .to_owned()
        )
    );
    assert_eq!(
        order("order = [\"ask\", \"set\", \"restart\"]").0,
        "asks asks_again sets restarts again"
    );
}

/// The words that a robot is told in periods of a tenth of a second. In each period flags are
/// raised and lowered, and something is said, which is heard where nothing else is told.
fn told(robot: &Robot, periods: &[(u64, u64, Option<Told>)]) -> Vec<(u64, Told)> {
    let system = system(robot);
    let tables = OwnedTables::of(robot, &[], &system);
    let tables = tables.view();
    system.with(|system| {
        let packed = Packed::<8, 0, 256>::of(system).unwrap();
        let mut decider = Decider::new(Level::start(&tables, packed.load(system)));
        let mut all = Vec::new();
        for (period, (raised, lowered, said)) in periods.iter().enumerate() {
            let now = Millis(100 * period as u64);
            let works = (1 << robot.modules.len()) - 1;
            let seen = Perceived { raised: *raised, lowered: *lowered, works };
            decider.perceive(now, seen);
            let drive = Drive { at_goal: false, stands: true };
            let round = decider.period(now, *said, drive, &mut ());
            all.extend(round.told.map(|it| (period as u64, it)));
        }
        all
    })
}

const LATE_UP: u64 = 1;
const STUCK_UP: u64 = 4;
const NOTHING: (u64, u64, Option<Told>) = (0, 0, None);

#[test]
fn a_failure_that_is_not_over_is_told_again_once_the_operator_is_done() {
    let robot = robot("ask = { times = 1 }", "");
    let said = |told| (0, 0, Some(told));
    let until_done = [
        said(Told::Begins),
        NOTHING,
        (LATE_UP, 0, None),
        NOTHING,
        NOTHING,
        said(Told::Chooses(1)),
        NOTHING,
        said(Told::Done(1)),
    ];
    let scan = Told::Report(0);
    let done = vec![(0, Told::Begins), (2, scan), (5, Told::Chooses(1)), (7, Told::Done(1))];
    let goes_on = [&until_done[..], &[NOTHING; 3]].concat();
    assert_eq!(told(&robot, &goes_on), [&done[..], &[(8, scan)]].concat());
    let is_over = [&until_done[..], &[(0, LATE_UP, None), NOTHING, NOTHING]].concat();
    assert_eq!(told(&robot, &is_over), done);
}

#[test]
fn a_mask_on_order_holds_from_the_operators_choice_for_its_time() {
    let robot = robot("", "mask = { flags = [\"stuck\"], on = \"order\", lasts_ms = 1_000 }");
    let (down, up) = ((0, STUCK_UP, None), (STUCK_UP, 0, None));
    let said = |told| (0, 0, Some(told));
    let mut periods = vec![said(Told::Begins), NOTHING, up, down, up, NOTHING, NOTHING];
    periods.extend([said(Told::Chooses(1)), down, up, down, up]);
    periods.extend([NOTHING; 8]);
    let stuck = Told::Report(2);
    let expected = [
        (0, Told::Begins),
        (2, stuck),
        (4, stuck), // he has ordered nothing yet
        (7, Told::Chooses(1)),
        (17, stuck), // a second after his order, since it is up still
    ];
    assert_eq!(told(&robot, &periods), expected);
}

#[test]
fn a_mask_hides_its_flags_and_its_own_failure_and_nothing_else() {
    let both = "flags = [\"late\", \"stuck\"]";
    let text = FILE.replace("flags = [\"late\"]", both)
        + "[[failure]]\nid = \"LAT1\"\n\
        mode = \"late\"\nseverity = { autonomous = \"hard\" }\nflags = [\"late\"]\n";
    let mask = format!("{both}\nmask = {{ flags = [\"stuck\"] }}");
    let hidden = Robot::parse("r.toml", &text.replace(both, &mask)).unwrap_err().to_string();
    assert!(hidden.contains("`LID1` masks `stuck`, and nothing else shows `STK1`"), "{hidden}");
    let text = text.replace(both, &mask).replace("[\"stuck\"]\n", "[\"stuck\", \"silent\"]\n");
    let robot = Robot::parse("r.toml", &text).unwrap_or_else(|it| panic!("{it}"));
    let up = |flags| (flags, 0, None);
    let periods =
        [(0, 0, Some(Told::Begins)), NOTHING, up(LATE_UP | STUCK_UP), (0, 5, None), up(STUCK_UP)];
    let periods = [&periods[..], &[(0, 5, None), up(LATE_UP), NOTHING, NOTHING]].concat();
    let late = robot.failure("LAT1").unwrap();
    let late = robot.losses.reports.iter().position(|it| it.failures.contains(&late)).unwrap();
    let expected = [(0, Told::Begins), (2, Told::Report(0)), (6, Told::Report(late))];
    assert_eq!(told(&robot, &periods), expected);
}

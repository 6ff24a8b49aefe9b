//! Trees with a supervisor beside them: nets of the project, and what their players do.

use crate::maker::Maker;
use crate::plain::{agrees, properties};
use cotama_core::net::Net;
use cotama_core::player::Outcome;
use cotama_core::system::{Component, System};
use cotama_core::units::Millis;
use cotama_models::nets::{by_hand, door};
use cotama_trees::explore::{
    Assumptions, End, Limits, Pair, Run, Space, check_property, parse_property,
};
use cotama_trees::findings::{Report, Wishes, check};
use cotama_trees::machine::{Event, Machine, Stop};
use cotama_trees::plain::walk;
use cotama_trees::reader::{self, Options};
use cotama_trees::replay::{frames, lines};
use cotama_trees::supervisor::{Bindings, Supervisor};
use cotama_trees::tree::Tree;

fn supervisor(net: &Net<'_>, period: Option<u32>) -> Supervisor {
    let alone = [Component::alone(net)];
    Supervisor::of(&System::alone(&alone), period, &[]).unwrap()
}

/// Reads a tree of which every leaf is known, or bound.
fn bound(nodes: &str, bonds: &str, net: Supervisor) -> Tree {
    let text =
        format!(r#"<root BTCPP_format="4"><BehaviorTree ID="Main">{nodes}</BehaviorTree></root>"#);
    let all = Bindings::read(bonds).unwrap();
    let leaves = all.leaves();
    let mut file = |_: &str| Ok(text.clone().into_bytes());
    let options = Options { leaves, ..Options::default() };
    let mut tree = reader::read("main.xml", &mut file, &options).unwrap().tree;
    all.bind(&mut tree, net).unwrap();
    tree
}

fn report(tree: &Tree) -> Report {
    check(tree, &Wishes::default(), Limits::default())
}

/// Returns what was found under a name, each with its run.
fn found(tree: &Tree, question: &str) -> Vec<(String, Vec<String>)> {
    let all = report(tree).findings.into_iter().filter(|it| it.question == question);
    let run = |it: &Run| lines(tree, it);
    all.map(|it| (it.message, it.run.as_ref().map_or(Vec::new(), run))).collect()
}

fn asked(tree: &Tree, text: &str) -> (Option<bool>, Vec<String>) {
    let property = parse_property(tree, text).unwrap();
    let limits = Limits::default();
    let it = check_property(tree, &property, false, Assumptions::default(), limits);
    (it.holds, it.run.map_or(Vec::new(), |it| lines(tree, &it)))
}

const OPENS: &str = "OpenDoor starts Call succeeds at Open or after opened";

#[test]
fn a_robot_drives_into_a_door_that_closes_until_its_tree_looks_at_the_door() {
    let tree = bound("<Sequence><OpenDoor/><A1/></Sequence>", OPENS, supervisor(&door::NET, None));
    let never = "AG !(A1.running & net.Closing)";
    let run =
        ["   1  OpenDoor>Call OpenDoor=R -> R", "   2  (EndOpen) (close) OpenDoor=S A1:R -> R"];
    assert_eq!(asked(&tree, never), (Some(false), run.map(str::to_owned).to_vec()));
    let mended = bound(
        "<RetryUntilSuccessful num_attempts='3'><Sequence><OpenDoor/>
           <ReactiveSequence><DoorIsOpen/><A1/></ReactiveSequence>
         </Sequence></RetryUntilSuccessful>",
        &format!("{OPENS}\nDoorIsOpen reads at Open"),
        supervisor(&door::NET, None),
    );
    assert_eq!(asked(&mended, never).0, Some(true));
    assert_eq!(asked(&mended, "EF (A1.running & net.obstacle)").0, Some(true));
    let others: Vec<_> = report(&mended).findings.iter().map(|it| it.message.clone()).collect();
    assert_eq!(others, [""; 0]);
}

#[test]
fn a_door_that_opens_and_closes_between_two_ticks_is_missed_where_time_is_free() {
    let nodes = "<OpenDoor/>";
    let bonds = "OpenDoor starts Call succeeds at Open";
    let free = bound(nodes, bonds, supervisor(&door::NET, None));
    let stuck = found(&free, "stuck");
    let missed = "   2  (EndOpen) (close) (EndClosed) OpenDoor=R -> R";
    assert_eq!(stuck[0].1[1], missed);
    // Nothing will ever end it, so no fairness is assumed of it.
    assert_eq!(asked(&free, "AF done").0, Some(false));
    // The door stays open for 5 s: a tick in 100 ms does not miss it.
    let timed = bound(nodes, bonds, supervisor(&door::NET, Some(100)));
    assert_eq!(found(&timed, "stuck"), []);
    assert_eq!(asked(&timed, "AF done").0, Some(true));
    // A leaf that remembers does not miss it either.
    let latched = bound(nodes, "OpenDoor starts Call succeeds after opened or at Open", {
        supervisor(&door::NET, None)
    });
    assert_eq!(found(&latched, "stuck"), []);
}

#[test]
fn a_drive_is_refused_where_the_last_one_has_not_been_done() {
    let nodes = "<Sequence><Drive name='ToA'/><Drive name='ToB'/></Sequence>";
    let local = || supervisor(&by_hand::local::NET, None);
    let early = bound(nodes, "Drive starts start_drive succeeds at End", local());
    let refused = found(&early, "refused");
    let message =
        "ToB is started by start_drive, which the supervisor ignores at End, camera, wifi";
    let run = [
        "   1  ToA>start_drive ToA=R -> R",
        "   2  (path_ready) (goal_reached) ToA=S ToB>start_drive:ignored ToB=F -> F",
    ];
    assert_eq!(refused, [(message.to_owned(), run.map(str::to_owned).to_vec())]);
    let tries = bound(nodes, "Drive tries start_drive succeeds at End", local());
    assert_eq!(found(&tries, "refused"), []);
    let done = bound(nodes, "Drive starts start_drive succeeds upon drive_done", local());
    assert_eq!(found(&done, "refused"), []);
    let waits = bound(
        "<Sequence><Drive name='ToA'/><Stands/><Drive name='ToB'/></Sequence>",
        "Drive starts start_drive succeeds at End\nStands succeeds at Idle",
        local(),
    );
    assert_eq!(found(&waits, "refused"), []);
}

#[test]
fn a_drive_that_is_halted_unheard_is_in_the_way_of_the_next() {
    let nodes = "<RetryUntilSuccessful num_attempts='2'>
        <Timeout msec='60000'><Drive/></Timeout></RetryUntilSuccessful>";
    let local = || supervisor(&by_hand::local::NET, None);
    let unheard = bound(nodes, "Drive starts start_drive succeeds upon drive_done", local());
    let run = &found(&unheard, "refused")[0].1;
    assert_eq!(run[1], "   2  Timeout?T Drive! Drive>start_drive:ignored Drive=F -> F");
    let heard = "Drive starts start_drive succeeds upon drive_done halts gs_abort";
    assert_eq!(found(&bound(nodes, heard, local()), "refused"), []);
    // The supervisor knows nothing of this event where it plans.
    let wrong = "Drive starts start_drive succeeds upon drive_done halts op_goal_reached";
    let refused = found(&bound(nodes, wrong, local()), "refused");
    assert!(refused[0].0.starts_with("Drive is started by"), "{refused:?}");
    assert!(refused[1].0.starts_with("Drive is halted by op_goal_reached"), "{refused:?}");
}

/// Offers the door each event that a tree's tick offered, and panics where it did otherwise.
fn play(door: &mut door::Player, tree: &Tree, event: Event, now: &mut Millis) {
    let bonds = tree.bonds.as_deref().unwrap();
    let (name, accepted) = match event {
        Event::Moved(it) => (bonds.of_move(it), None),
        Event::Offered(node, part, accepted) => {
            (bonds.offered(node as usize, part).unwrap(), Some(accepted))
        }
        _ => return,
    };
    let event = match name {
        "Call" => door::Event::Call,
        "EndOpen" => door::Event::EndOpen,
        "EndClosed" => door::Event::EndClosed,
        "Obstacle" => door::Event::Obstacle,
        "Clear" => door::Event::Clear,
        _ => {
            // Time passes until it closes by itself.
            if let Some(due) = door.wake_at() {
                *now = due;
                let _ = door.advance(due);
            }
            return;
        }
    };
    let outcome = door.offer(*now, &event);
    if let Some(accepted) = accepted {
        assert_eq!(matches!(outcome, Outcome::Fired { .. }), accepted, "{name}");
    }
}

/// Walks through random ticks of random trees beside a door; returns the ticks.
fn walks(count: usize, period: Option<u32>) -> usize {
    let mut maker = Maker::new("beside a door");
    let net = supervisor(&door::NET, period);
    let mut ticks = 0;
    for _ in 0..count {
        let text = maker.tree();
        let mut tree = reader::read_text(&text).unwrap().tree;
        let all = Bindings::read(&bonds(&tree, DOORS)).unwrap();
        all.bind(&mut tree, net.clone()).unwrap();
        let mut machine = Machine::new(&tree);
        let (mut door, mut now) = (door::Player::new(), Millis(0));
        for _ in 0..20 {
            let mut stop = machine.tick();
            while let Stop::Asked(question) = stop {
                stop = machine.reply(question.replies[maker.below(question.replies.len())]);
            }
            if let Some(ms) = period {
                now = Millis(now.0 + u64::from(ms));
                let _ = door.advance(now);
            }
            for event in machine.take_events() {
                play(&mut door, &tree, event, &mut now);
            }
            let marked = machine.marked();
            let state = format!("{:?}", door.state());
            assert!(marked.contains(&state.as_str()), "{marked:?} {state} {text}");
            let obstacle = door.tokens(door::Place::obstacle) > 0;
            assert_eq!(marked.contains(&"obstacle"), obstacle, "{text}");
            ticks += 1;
            if matches!(stop, Stop::Thrown(_) | Stop::Halted) {
                break;
            }
        }
    }
    ticks
}

/// Lines of actions and services, of conditions, of leaves that end at once, and of the
/// supervisor's own doing in one tree of three.
type Lines = [&'static [&'static str]; 4];

const DRIVES: Lines = [
    &[
        "starts start_drive succeeds at End halts gs_abort",
        "starts start_drive succeeds upon drive_done fails at HandOver or after abort",
        "tries op_teleoperate fails at End or after l12",
        "succeeds at Idle or after l2 halts op_teleprogram",
    ],
    &["reads at Idle or at End", "reads not at Following"],
    &["starts gs_abort", "tries local_event"],
    &["cancel after l12 or at Teleprogrammed\n"],
];

const DOORS: Lines = [
    &[
        "starts Call succeeds at Open fails at Blocked",
        "tries Call succeeds after closed or at Blocked halts Obstacle",
        "starts Obstacle fails after free",
        "succeeds not at Opening halts Call",
    ],
    &["reads at Open or at Opening", "reads not at Closed"],
    &["starts Clear", "tries EndClosed"],
    &["cancel after free\n"],
];

/// Binds three of four leaves of a random tree, by their letters and numbers.
fn bonds(tree: &Tree, lines: Lines) -> String {
    let mut all =
        if tree.nodes.len().is_multiple_of(3) { lines[3].join("\n") } else { String::new() };
    for it in tree.nodes.iter().filter(|it| !it.is_built_in()) {
        let list = match &it.tag[..1] {
            "A" | "B" => lines[0],
            "C" => lines[1],
            "S" => lines[2],
            _ => continue,
        };
        let number: usize = it.tag[1..].parse().unwrap();
        if number % 4 != 3 {
            all += &format!("{} {}\n", it.tag, list[number % list.len()]);
        }
    }
    all
}

#[test]
fn the_door_beside_a_tree_does_what_its_player_does() {
    assert_eq!((walks(300, None), walks(300, Some(700))), (5_589, 5_918));
}

/// Compares 200 random trees: how many were small enough, leaves that were refused, runs that were
/// repeated, properties that were false and true.
fn compared(mut maker: Maker) -> (usize, usize, usize, [usize; 2]) {
    let nets = [
        (supervisor(&door::NET, Some(1_500)), DOORS),
        (supervisor(&by_hand::local::NET, None), DRIVES),
    ];
    let (mut compared, mut refused, mut runs) = (0, 0, 0);
    let (mut dice, mut said) = (Maker::new("properties beside"), [0; 2]);
    for number in 0..200 {
        let text = maker.tree_of(2);
        let mut tree = reader::read_text(&text).unwrap().tree;
        let (net, lines) = &nets[number % 2];
        let all = Bindings::read(&bonds(&tree, *lines)).unwrap();
        all.bind(&mut tree, net.clone()).unwrap();
        let Some(plain) = walk(&tree, &Wishes::default(), None, 2_000) else { continue };
        let none = Assumptions::default();
        let mut space = Space::explore(&tree, false, none, Limits::default());
        let facts = space.facts(&[]);
        agrees(&facts, &plain, &text);
        for property in properties(&tree, &mut dice) {
            let found =
                check_property(&tree, &property, false, Assumptions::default(), Limits::default());
            let plain = walk(&tree, &Wishes::default(), Some(&property), 20_000);
            assert_eq!(plain.and_then(|it| it.holds), found.holds, "{property:?} {text}");
            said[found.holds.unwrap() as usize] += 1;
        }
        let pairs = |all: &[Pair]| all.iter().map(|it| (it.nodes, it.ticks)).collect();
        assert_eq!(facts.states, plain.states, "{text}");
        assert_eq!(facts.ends, plain.ends, "{text}");
        assert_eq!((facts.stuck, facts.spins), (plain.stuck, plain.spins), "{text}");
        assert_eq!(plain.lost, pairs(&facts.success_lost), "{text}");
        assert_eq!(plain.both, pairs(&facts.both_running), "{text}");
        assert_eq!(plain.overlap, pairs(&facts.started_while_running), "{text}");
        let vain = facts.refused.iter().map(|it| ((it.vain.node, it.vain.part), it.ticks));
        assert_eq!(plain.refused, vain.collect(), "{text}");
        refused += plain.refused.len();
        for it in report(&tree).findings.iter().filter_map(|it| it.run.as_ref()) {
            assert!(frames(&tree, it).is_ok(), "{text}");
            runs += 1;
        }
        compared += 1;
    }
    (compared, refused, runs, said)
}

#[test]
fn explorations_beside_a_supervisor_agree_with_a_plain_walk() {
    assert_eq!(compared(Maker::new("plain, supervised")), (196, 15, 105, [310, 474]));
}

#[test]
fn explorations_beside_a_supervisor_agree_where_trees_tick_when_they_are_halted() {
    assert_eq!(compared(Maker::steered("steered, supervised")), (196, 18, 159, [344, 440]));
}

#[test]
fn a_supervisor_halts_the_tree_before_its_next_tick() {
    let nodes = "<Sequence><Drive/><A1/></Sequence>";
    let bonds = "Drive starts start_drive succeeds upon drive_done halts gs_abort
        cancel at HandOver or after l12";
    let tree = bound(nodes, bonds, supervisor(&by_hand::local::NET, None));
    let run =
        ["   1  Drive>start_drive Drive=R -> R", "   2  (local_event) Drive! Drive>gs_abort -> H"];
    assert_eq!(asked(&tree, "AG !(done & net.Idle & A1.idle)").1, run);
    assert_eq!(report(&tree).facts.ends[&End::Halted], 2);
    // The operator takes over before the tree looks again.
    assert_eq!(asked(&tree, "EF (root.running & net.Teleoperated)").0, Some(true));
    assert_eq!(asked(&tree, "EF (root.running & net.HandOver)").0, Some(false));
}

#[test]
fn events_that_never_happen_leave_their_states_out() {
    let nodes = "<Sequence><OpenDoor/><A1/></Sequence>";
    let alone = [Component::alone(&door::NET)];
    let net = |never: &[&str]| Supervisor::of(&System::alone(&alone), None, never).unwrap();
    let calm = net(&["Obstacle", "close"]);
    assert_eq!((net(&[]).states, calm.states), (8, 3));
    let tree = bound(nodes, &format!("{OPENS}\nnever Obstacle close\nnever close"), calm);
    assert_eq!(asked(&tree, "AG !(A1.running & net.Closing)").0, Some(true));
    let moves = &tree.bonds.as_deref().unwrap().moves;
    assert_eq!(moves.len(), 3);
}

#[test]
fn mistakes_in_a_file_of_bonds_are_told_with_their_places() {
    let said = |bonds: &str| {
        let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
            <Sequence><A1/><C1/><S1/><L1/></Sequence></BehaviorTree></root>"#;
        let mut tree = reader::read_text(text).unwrap().tree;
        let net = supervisor(&door::NET, None);
        let it = Bindings::read(bonds).and_then(|it| it.bind(&mut tree, net)).unwrap_err();
        format!("{}:{}: {}", it.line, it.column, it.message)
    };
    let all = [
        ("A1 starts", "1:4: after `starts` stands an event"),
        (
            "A1 strats Call",
            "1:4: `strats` is none of starts, tries, succeeds, fails, halts, reads; \
          did you mean starts?",
        ),
        ("A1", "1:1: A1: a leaf starts, tries, succeeds, fails or reads something"),
        ("A1 succeeds at", "1:13: after `at` stands a name"),
        (
            "A1 succeeds Open",
            "1:13: after `succeeds` stands at PLACE, not at PLACE, after \
          TRANSITION or upon OUTPUT",
        ),
        ("# one\n\nA1 starts Cal", "3:11: no event Cal; did you mean Call?"),
        ("A1 starts close", "1:11: no event close"),
        ("A1 succeeds at open", "1:16: no place open; did you mean Open?"),
        ("A1 succeeds after Opened", "1:19: no transition Opened; did you mean opened?"),
        ("A1 succeeds upon Halt", "1:18: no output Halt"),
        ("A1 starts Call\nA1 starts Call", "2:1: A1 is bound in line 1 already"),
        ("A1 starts Call starts Call", "1:16: `starts` a second time"),
        ("\"A1 starts", "1:1: a name without its closing quote"),
        ("A2 starts Call", "1:1: no leaf A2; did you mean A1?"),
        ("A1 reads at Open", "1:1: A1 is an action: say what it `starts`, and when it `succeeds`"),
        ("C1 starts Call", "1:1: C1 is a condition: say what it `reads`"),
        ("C1 reads after opened", "1:16: a condition has no start: it reads places"),
        (
            "S1 starts Call fails at Open",
            "1:1: S1 is `sync`, and ends at once: it cannot wait for \
          anything",
        ),
        ("cancel at", "1:8: after `at` stands a name"),
        ("cancel at Open A1", "1:16: nothing is expected here"),
        ("never", "1:1: after `never` stand events"),
        ("never clse", "1:7: no event clse; did you mean close?"),
        ("A1 starts Call\nnever Clear Call", "2:13: a leaf offers Call"),
        ("L1 reads at Open", "1:1: L1 begins by a rule of its own"),
        ("Sequence starts Call", "1:1: Sequence is no leaf: the library answers for it"),
        (
            "A1 starts Call halts Call",
            "1:1: A1: it answers at once, and is never halted: say when \
          it succeeds or fails",
        ),
    ];
    for (bonds, message) in all {
        assert_eq!(said(bonds), message);
    }
}

//! Random trees: ticked by ours and by the second program, and read after random damage.

use crate::folder::folder;
use crate::maker::Maker;
use cotama_trees::explore::{Assumptions, Limits, Space};
use cotama_trees::machine::{Machine, Reply, Stop};
use cotama_trees::reader::{Options, read, read_text};
use std::fmt::Write as _;

impl Maker {
    /// Plays runs with random replies, and writes them as a trace.
    fn trace(&mut self, text: &str, runs: usize) -> String {
        let tree = read_text(text).unwrap_or_else(|it| panic!("{text}: {it}")).tree;
        let mut out = String::new();
        for run in 1..=runs {
            let mut machine = Machine::new(&tree);
            for step in 1..=8 {
                let once = self.below(4) == 0;
                let halts = self.below(8) == 0;
                let mut parts = Vec::new();
                let mut ticks = |maker: &mut Maker, machine: &mut Machine| loop {
                    let mut stop = machine.tick();
                    while let Stop::Asked(question) = stop {
                        let reply = question.replies[maker.below(question.replies.len())];
                        stop = machine.reply(reply);
                    }
                    let events = machine.take_events();
                    let shown: Vec<_> = events.iter().map(|it| it.shown(&tree)).collect();
                    parts.push(shown.join(" "));
                    let status = match stop {
                        Stop::Answered(answer) => answer.letter().to_string(),
                        Stop::Thrown(it) => match it.node {
                            Some(node) => format!("X@{}", tree.nodes[node].name),
                            None => "X".to_owned(),
                        },
                        Stop::Asked(_) | Stop::Halted => unreachable!("it was answered"),
                    };
                    if !once || status != "R" || !machine.take_wake() {
                        return status;
                    }
                    if parts.len() == 20 {
                        return "SPIN".to_owned();
                    }
                };
                let (op, status) = if halts {
                    let status = if machine.halt_tree() == Stop::Halted { "H" } else { "X" };
                    let events = machine.take_events();
                    let shown: Vec<_> = events.iter().map(|it| it.shown(&tree)).collect();
                    parts.push(shown.join(" "));
                    ("halt", status.to_owned())
                } else {
                    (if once { "once" } else { "tick" }, ticks(self, &mut machine))
                };
                let events = Some(parts.join("|")).filter(|it| !it.is_empty());
                let events = events.unwrap_or("-".to_owned());
                let board = machine.blackboard();
                let _ = writeln!(out, "{run}\t{step}\t{op}\t0\t-\t{events}\t{status}\t{board}");
                if status.starts_with('X') || status == "SPIN" {
                    break;
                }
            }
        }
        out
    }
}

/// Runs through all traces of a folder, and prints those that differ.
const REPLAY: &str = "
import sys, os
sys.path.insert(0, sys.argv[1])
import replay
different = 0
for n in range(int(sys.argv[3])):
    path = os.path.join(sys.argv[2], str(n))
    rows = [line.rstrip('\\n').split('\\t') for line in open(path + '.tsv')]
    wrong = replay.check(path + '.xml', rows)
    if wrong:
        different += 1
        print(path, wrong[0])
print(different, 'differ')
";

#[test]
#[ignore = "some seconds, and Python: CI runs it"]
fn a_thousand_random_trees_tick_as_in_the_second_program() {
    let Some(folder) = folder() else { return };
    let mut maker = Maker::new("trees");
    let place = std::env::temp_dir().join(format!("cotama-trees-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    for number in 0..1_000 {
        let text = maker.tree();
        let trace = maker.trace(&text, 8);
        std::fs::write(place.join(format!("{number}.xml")), &text).unwrap();
        std::fs::write(place.join(format!("{number}.tsv")), &trace).unwrap();
    }
    let mut command = std::process::Command::new("python3");
    command.args(["-c", REPLAY]).arg(folder.join("reference")).arg(&place).arg("1000");
    let output = command.output().unwrap();
    let (said, wrong) = (
        String::from_utf8_lossy(&output.stdout).into_owned(),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    );
    assert!(said.ends_with("\n0 differ\n") || said == "0 differ\n", "{said}{wrong}");
    std::fs::remove_dir_all(&place).unwrap();
}

/// Walks at random through what was explored of all trees of a folder: tree, run, events, status.
const WALK: &str = "
import sys, os, random
sys.path.insert(0, sys.argv[1])
import tree as loader
from explore import Space
from sample import walks
draw = random.Random(46)
for n in range(int(sys.argv[3])):
    try:
        space = Space(loader.load(os.path.join(sys.argv[2], str(n)) + '.xml'), False, 3000)
    except MemoryError:
        continue
    for run, answers, rows in walks(space, 8, 10, draw):
        for row in rows:
            print(n, run, row[3], row[4], sep='\\t')
";

#[test]
#[ignore = "half a minute, and Python: CI runs it"]
fn walks_through_what_the_second_program_explored_are_walks_of_ours() {
    let Some(folder) = folder() else { return };
    let mut maker = Maker::new("walks");
    let place = std::env::temp_dir().join(format!("cotama-walks-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    let texts: Vec<_> = (0..1_000).map(|_| maker.tree_of(2)).collect();
    for (number, text) in texts.iter().enumerate() {
        std::fs::write(place.join(format!("{number}.xml")), text).unwrap();
    }
    let mut command = std::process::Command::new("python3");
    command.args(["-c", WALK]).arg(folder.join("reference")).arg(&place).arg("1000");
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let rows: Vec<Vec<_>> = said.lines().map(|it| it.split('\t').collect()).collect();
    let (mut walks, mut at) = (0, 0);
    while at < rows.len() {
        let (number, run) = (rows[at][0], rows[at][1]);
        let tree = read_text(&texts[number.parse::<usize>().unwrap()]).unwrap().tree;
        let mut machine = Machine::new(&tree);
        while at < rows.len() && rows[at][..2] == [number, run] {
            let words = rows[at][2].split(' ');
            let mut replies = words.filter_map(|it| {
                let asked = it.contains([':', '~', '?']);
                asked.then(|| Reply::of_letter(it.chars().last()?)).flatten()
            });
            machine.take_wake();
            let mut stop = machine.tick();
            while let Stop::Asked(_) = stop {
                stop = machine.reply(replies.next().unwrap());
            }
            let events = machine.take_events();
            let shown: Vec<_> = events.iter().map(|it| it.shown(&tree)).collect();
            let shown = if shown.is_empty() { "-".to_owned() } else { shown.join(" ") };
            assert_eq!(shown, rows[at][2], "{number}.xml, run {run}");
            let status = match stop {
                Stop::Answered(it) => it.letter().to_string(),
                Stop::Thrown(it) => {
                    it.node.map_or("X".to_owned(), |it| format!("X@{}", tree.nodes[it].name))
                }
                Stop::Asked(_) | Stop::Halted => unreachable!("it was answered"),
            };
            assert_eq!(status, rows[at][3], "{number}.xml, run {run}");
            at += 1;
        }
        walks += 1;
    }
    assert_eq!(walks, 7_800);
    std::fs::remove_dir_all(&place).unwrap();
}

/// Explores all trees of a folder, and prints their facts, or why there are none.
const EXPLORE: &str = "
import sys, os, json
sys.path.insert(0, sys.argv[1])
import tree as loader
from explore import Space
for n in range(int(sys.argv[3])):
    try:
        space = Space(loader.load(os.path.join(sys.argv[2], str(n)) + '.xml'), False, 3000)
        print(json.dumps(space.facts()))
    except MemoryError:
        print('null')
";

#[test]
#[ignore = "a minute, and Python: CI runs it"]
fn facts_of_random_trees_equal_those_of_the_second_program() {
    let Some(folder) = folder() else { return };
    let mut maker = Maker::new("facts");
    let place = std::env::temp_dir().join(format!("cotama-facts-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    let texts: Vec<_> = (0..500).map(|_| maker.tree_of(2)).collect();
    for (number, text) in texts.iter().enumerate() {
        std::fs::write(place.join(format!("{number}.xml")), text).unwrap();
    }
    let mut command = std::process::Command::new("python3");
    command.args(["-c", EXPLORE]).arg(folder.join("reference")).arg(&place).arg("500");
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(said.lines().count(), 500, "{}", String::from_utf8_lossy(&output.stderr));
    let mut compared = 0;
    for (text, line) in texts.iter().zip(said.lines()) {
        let mut wanted: serde_json::Value = serde_json::from_str(line).unwrap();
        // The second program merges questions whatever wake-up is pending: with timers it finds
        // circles of wake-ups that are none.
        if ["Sleep", "Delay", "Timeout"].iter().any(|it| text.contains(it)) && !wanted.is_null() {
            wanted.as_object_mut().unwrap().remove("spins");
        }
        if !wanted.is_null() {
            crate::facts::compare(text, &read_text(text).unwrap().tree, &wanted);
            compared += 1;
        }
    }
    assert_eq!(compared, 487);
    std::fs::remove_dir_all(&place).unwrap();
}

/// Reads damaged trees; whatever can be read is explored a little.
fn damaged(count: usize) -> (usize, usize) {
    let mut maker = Maker::new("damage");
    let signs = b"<>/\"'=&; {}AxR01-\n\xff";
    let (mut loaded, mut refused) = (0, 0);
    for _ in 0..count {
        let mut bytes = maker.tree().into_bytes();
        for _ in 0..1 + maker.below(3) {
            let (at, to) = (maker.below(bytes.len()), maker.below(bytes.len()));
            match maker.below(4) {
                0 => bytes[at] = signs[maker.below(signs.len())],
                1 => drop(bytes.drain(at.min(to)..at.max(to).min(at.min(to) + 20))),
                2 => bytes.insert(at, signs[maker.below(signs.len())]),
                _ => bytes.swap(at, to),
            }
        }
        let mut files = |_: &str| Ok(bytes.clone());
        match read("tree.xml", &mut files, &Options::default()) {
            Ok(tree) => {
                loaded += 1;
                let limits = Limits { nodes: 200, ..Limits::default() };
                let mut space = Space::explore(&tree.tree, true, Assumptions::default(), limits);
                let _ = space.facts(&[]);
            }
            Err(refusal) => {
                refused += 1;
                assert!(!refusal.first().message.is_empty());
            }
        }
    }
    (loaded, refused)
}

#[test]
fn damaged_files_are_refused_or_read() {
    let (loaded, refused) = damaged(2_000);
    assert!(loaded > 50 && refused > 1_000, "{loaded} {refused}");
}

#[test]
#[ignore = "a minute: CI runs it"]
fn a_hundred_thousand_damaged_files_are_refused_or_read() {
    let (loaded, refused) = damaged(100_000);
    assert_eq!(loaded + refused, 100_000);
}

#[test]
fn many_files_are_included_and_one_that_includes_itself_is_read_once() {
    let mut files = |path: &str| {
        let number: usize = path.trim_end_matches(".xml").parse().unwrap_or(0);
        let next = (number + 1) % 1_000;
        let text = format!(
            "<root BTCPP_format=\"4\" main_tree_to_execute=\"T0\"><include path=\"{next}.xml\"/>\
             <include path=\"{number}.xml\"/><BehaviorTree ID=\"T{number}\"><A1/></BehaviorTree>\
             </root>"
        );
        Ok(text.into_bytes())
    };
    let loaded = read("0.xml", &mut files, &Options::default()).unwrap();
    assert_eq!((loaded.tree.nodes.len(), loaded.tree.files.len()), (1, 1_000));
}

#[test]
fn subtrees_that_double_and_levels_without_end_are_refused() {
    let mut text = "<root BTCPP_format=\"4\" main_tree_to_execute=\"T0\">".to_owned();
    for it in 0..40 {
        let next = it + 1;
        let _ = write!(
            text,
            "<BehaviorTree ID=\"T{it}\"><Sequence><SubTree ID=\"T{next}\"/>\
             <SubTree ID=\"T{next}\"/></Sequence></BehaviorTree>"
        );
    }
    text += "<BehaviorTree ID=\"T40\"><A1/></BehaviorTree></root>";
    let refused = read_text(&text).unwrap_err();
    assert!(refused.first().message.starts_with("more than 20000 nodes"), "{refused}");
    let mut chain = "<root BTCPP_format=\"4\" main_tree_to_execute=\"T0\">".to_owned();
    for it in 0..600 {
        let next = it + 1;
        let _ = write!(
            chain,
            "<BehaviorTree ID=\"T{it}\"><Inverter><SubTree ID=\"T{next}\"/></Inverter>\
             </BehaviorTree>"
        );
    }
    chain += "<BehaviorTree ID=\"T600\"><A1/></BehaviorTree></root>";
    let refused = read_text(&chain).unwrap_err();
    assert!(refused.first().message.starts_with("more than 512 levels"), "{refused}");
    let deep = format!(
        "<root><BehaviorTree ID=\"T\">{}<A1/>{}</BehaviorTree></root>",
        "<Inverter>".repeat(10_000),
        "</Inverter>".repeat(10_000)
    );
    let refused = read_text(&deep).unwrap_err();
    assert_eq!(refused.first().message, "more than 256 levels of nodes");
}

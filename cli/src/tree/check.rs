//! `cotama check` of a behaviour tree.

use super::{certificate, limits, only, sarif, sound, source};
use crate::answers::check::tree::{TreeAnswer, TreeNoteRow, TreeRow, TreeTickRow};
use crate::args::{CheckArgs, Deny, EngineName};
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use cotama_trees::explore::{
    Assumptions, Limits, Run, check_property, parse_assumption, parse_property,
};
use cotama_trees::findings::{Level, Report, Wishes, check as ask, timeouts};
use cotama_trees::kinds::LeafKind;
use cotama_trees::page::{self, Section};
use cotama_trees::reader::Loaded;
use cotama_trees::replay::frames;
use cotama_trees::tree::{Gate, Kind, Queue, Tree};
use std::time::Instant;

const ENGINE: &str = "explicit";

/// Answers all questions about a tree.
pub(crate) fn check(args: &CheckArgs, screen: &Screen) -> Result<Exit, Failure> {
    refuse_others(args)?;
    if let Some(folder) = &args.wishes.html {
        output::report(folder)?;
    }
    let begun = Instant::now();
    let source = source(&args.model, &args.tree, args.wishes.period)?;
    let loaded = &source.loaded;
    sound(loaded)?;
    let tree = &loaded.tree;
    let wishes = wishes(args, tree)?;
    let properties = args.property.iter().map(|text| {
        parse_property(tree, text).map_err(|(at, why)| {
            let errors = FileErrors::at("--property", text.clone(), 1, at + 1, why);
            Failure::Text(Box::new(errors))
        })
    });
    let properties = properties.collect::<Result<Vec<_>, _>>()?;
    let limits = limits(&args.budget);
    let report = ask(tree, &wishes, limits);
    let seconds = begun.elapsed().as_secs_f64();
    let mut answer = answer(&args.model, loaded, &report, seconds);
    if let Some(period) = args.wishes.period {
        answer.notes[0] = free(tree, true);
        answer.notes.extend(timed(tree, period, &wishes, &report, limits));
    }
    let mut runs: Vec<Option<Run>> = runs(&report);
    for (text, property) in args.property.iter().zip(&properties) {
        let begun = Instant::now();
        let (skips, assumptions) = (wishes.skips, wishes.assumptions.clone());
        let found = check_property(tree, property, skips, assumptions, limits);
        let (verdict, level) = match found.holds {
            Some(true) => ("true", None),
            Some(false) => ("false", Some(Level::Error.word())),
            None => ("unknown", None),
        };
        answer.results.push(TreeRow {
            name: "property".to_owned(),
            property: text.clone(),
            verdict,
            level,
            message: level.map(|_| format!("{text} is false")),
            help: None,
            nodes: Vec::new(),
            file: None,
            line: None,
            column: None,
            engine: ENGINE,
            states: found.states,
            seconds: begun.elapsed().as_secs_f64(),
            trace: found.run.as_ref().map(|it| ticks(tree, it)),
            repeats_from: found.run.as_ref().and_then(|it| it.again_from).map(|it| it + 1),
        });
        runs.push(found.run);
    }
    written(args, tree, &answer, &runs, screen)?;
    if let Some(path) = &args.certificate {
        certificate::write(path, args, &source, &answer, screen)?;
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::tree::check(&answer, args.wishes.notes, screen.width()))?;
    }
    Ok(ended(args, &answer))
}

fn refuse_others(args: &CheckArgs) -> Result<(), Failure> {
    only(&[
        ("--mission", args.mission.is_some()),
        ("--properties", args.properties.is_some()),
        ("--initial", args.initial),
        ("--engine", args.engine != EngineName::Auto),
        ("--untimed", args.untimed),
        ("--semantics", args.semantics.is_some()),
        ("--trace", args.trace.is_some()),
        ("--watch", args.watch),
        ("--junit", args.junit.is_some()),
        ("--mcc", args.mcc),
        ("--max-seconds", args.budget.max_seconds.is_some()),
        ("--jobs", args.budget.jobs != 1),
    ])
}

fn wishes(args: &CheckArgs, tree: &Tree) -> Result<Wishes, Failure> {
    let asked = &args.wishes;
    let assumptions = asked.assume.iter().map(|text| {
        parse_assumption(tree, text)
            .map_err(|why| Failure::new(format!("--assume '{text}': {why}")))
    });
    let assumptions = assumptions.collect::<Result<Vec<_>, _>>()?;
    Ok(Wishes {
        exclusive: exclusive(args, tree)?,
        given: asked.given.clone(),
        skips: asked.skips,
        assumptions: Assumptions::new(assumptions).every(asked.period),
    })
}

/// Returns the actions that exclude each other.
pub(super) fn exclusive(args: &CheckArgs, tree: &Tree) -> Result<Vec<usize>, Failure> {
    let mut exclusive = Vec::new();
    for name in &args.wishes.exclusive {
        let nodes = tree.nodes.iter().enumerate().filter(|(_, it)| it.is_action());
        let found: Vec<_> = nodes
            .clone()
            .filter(|(_, it)| it.label == *name || it.name == *name || it.tag == *name)
            .map(|it| it.0)
            .collect();
        if found.is_empty() {
            let near = crate::names::near(name, nodes.map(|it| it.1.label.as_str()));
            let failure = Failure::new(format!("--exclusive: no action {name}"));
            return Err(match near {
                Some(near) => failure.help(format!("did you mean {near}?")),
                None => failure,
            });
        }
        exclusive.extend(found);
    }
    Ok(exclusive)
}

/// Returns bounds of timeouts, and which answers are others where timers are free.
fn timed(
    tree: &Tree,
    period: u32,
    wishes: &Wishes,
    report: &Report,
    limits: Limits,
) -> Vec<String> {
    let mut notes: Vec<_> = timeouts(tree, period)
        .into_iter()
        .map(|(node, bound)| match bound {
            Some((ticks, ms)) => {
                let node = tree.shown(node);
                format!("{node} halts its child at most {ticks} ticks, {ms} ms, after its start")
            }
            None => format!("{} has no bound: an entry says it", tree.shown(node)),
        })
        .collect();
    let assumptions = wishes.assumptions.clone().every(None);
    let free = ask(tree, &Wishes { assumptions, ..wishes.clone() }, limits);
    for (free, timed) in free.asked.iter().zip(&report.asked) {
        if free.holds != timed.holds {
            let said = |it: Option<bool>| it.map_or("unknown".to_owned(), |it| it.to_string());
            let (now, before) = (said(timed.holds), said(free.holds));
            let why = match (free.holds, timed.holds) {
                (Some(false), Some(true)) => "a timer would have to go off at another tick",
                (Some(true), Some(false)) => "no timer goes off at the tick that this takes",
                _ => "a limit was met",
            };
            notes.push(format!("{}: {now}, with free timers {before}: {why}", timed.question));
        }
    }
    notes
}

/// Returns what is free.
fn free(tree: &Tree, timed: bool) -> String {
    let count = |is: &dyn Fn(&Kind) -> bool| tree.nodes.iter().filter(|it| is(&it.kind)).count();
    let bound = tree.bonds.iter().flat_map(|it| &it.of).flatten().count();
    let leaves = count(&|it| matches!(it, Kind::Leaf(_))) - bound;
    let latches = count(&|it| {
        matches!(it, Kind::Leaf(LeafKind::Latch | LeafKind::FirstSuccess | LeafKind::FirstFailure))
    });
    let rate = |it: &Kind| matches!(it, Kind::Gate(Gate::Rate { .. }));
    let gates = count(&|it| {
        let is_gate =
            matches!(it, Kind::Gate(_) | Kind::PathLongerOnApproach | Kind::PauseResumeController);
        is_gate && !(timed && rate(it))
    });
    let timers = count(&|it| {
        matches!(it, Kind::Delay { .. } | Kind::Timeout { .. } | Kind::Sleep { .. }) && !timed
    });
    let mut all = vec![format!("answers of leaves: {leaves}")];
    if latches > 0 {
        all.push(format!("of which begin by a rule: {latches}"));
    }
    all.extend((gates > 0).then(|| format!("gates: {gates}")));
    all.extend((timers > 0).then(|| format!("timers: {timers}")));
    let (queues, menus) = (count(&is_queue), count(&is_menu));
    all.extend((queues > 0).then(|| format!("queues: {queues}")));
    all.extend((menus > 0).then(|| format!("choices: {menus}")));
    format!("free: {}; what leaves write is not followed", all.join(", "))
}

/// Returns what a supervisor does by itself.
fn beside(tree: &Tree) -> Option<String> {
    let bonds = tree.bonds.as_deref()?;
    let moves: Vec<_> = bonds.moves.iter().map(|it| bonds.net.events[*it].as_str()).collect();
    let (name, states) = (&bonds.net.name, bonds.net.states);
    Some(match moves.len() {
        0 => format!("beside it: {name}, {states} states, which does nothing by itself"),
        1..=12 => format!("beside it: {name}, {states} states; by itself: {}", moves.join(", ")),
        more => format!("beside it: {name}, {states} states; {more} events come by themselves"),
    })
}

fn is_queue(it: &Kind) -> bool {
    matches!(it, Kind::Loop { queue: Queue::Entry(..), .. })
}

fn is_menu(it: &Kind) -> bool {
    matches!(it, Kind::ManualSelector { .. })
}

/// Returns what is assumed of runs without end.
fn fair(tree: &Tree) -> String {
    let has = |is: &dyn Fn(&Kind) -> bool| tree.nodes.iter().any(|it| is(&it.kind));
    let mut all = "fair: actions that run end or are halted, gates open again and again".to_owned();
    if has(&is_queue) {
        all += ", queues are empty at last";
    }
    if has(&is_menu) {
        all += ", somebody chooses at last";
    }
    if has(&|it| *it == Kind::PauseResumeController) {
        all += ", pauses do not come for ever";
    }
    all
}

fn ticks(tree: &Tree, run: &Run) -> Vec<TreeTickRow> {
    let all = frames(tree, run).unwrap_or_default().into_iter().enumerate();
    all.map(|(at, it)| TreeTickRow {
        tick: at + 1,
        events: it.events,
        status: it.status,
        blackboard: it.blackboard,
        marked: it.marked,
    })
    .collect()
}

fn runs(report: &Report) -> Vec<Option<Run>> {
    let clean = report.asked.iter().filter(|it| it.holds != Some(false)).map(|_| None);
    report.findings.iter().map(|it| it.run.clone()).chain(clean).collect()
}

/// Returns the answer without own properties: findings, then questions without one.
fn answer(model: &str, loaded: &Loaded, report: &Report, seconds: f64) -> TreeAnswer {
    let tree = &loaded.tree;
    let states = report.facts.states;
    let mut results = Vec::new();
    for it in &report.findings {
        let wish = report.asked.iter().find(|asked| asked.question == it.question);
        let place = it.nodes.first().map(|node| tree.nodes[*node].place);
        let file = place.and_then(|it| tree.files.get(it.file as usize)).cloned();
        results.push(TreeRow {
            name: it.question.to_owned(),
            property: wish.map_or("", |it| it.wish).to_owned(),
            verdict: "false",
            level: Some(it.level.word()),
            message: Some(it.message.clone()),
            help: Some(it.help.to_owned()),
            nodes: it.nodes.iter().map(|it| tree.shown(*it)).collect(),
            file,
            line: place.map(|it| it.line),
            column: place.map(|it| it.column),
            engine: ENGINE,
            states,
            seconds,
            trace: it.run.as_ref().map(|run| ticks(tree, run)),
            repeats_from: it.run.as_ref().and_then(|it| it.again_from).map(|it| it + 1),
        });
    }
    for it in report.asked.iter().filter(|it| it.holds != Some(false)) {
        results.push(TreeRow {
            name: it.question.to_owned(),
            property: it.wish.to_owned(),
            verdict: if it.holds.is_some() { "true" } else { "unknown" },
            level: None,
            message: None,
            help: None,
            nodes: Vec::new(),
            file: None,
            line: None,
            column: None,
            engine: ENGINE,
            states,
            seconds,
            trace: None,
            repeats_from: None,
        });
    }
    let warnings = loaded.notes.iter().map(|it| TreeNoteRow {
        file: it.file.clone(),
        line: it.place.line,
        column: it.place.column,
        message: it.message.clone(),
        help: it.help.clone(),
    });
    TreeAnswer {
        schema: "cotama/check-tree/1",
        model: model.to_owned(),
        tree: tree.name.clone(),
        nodes: tree.nodes.len(),
        notes: [free(tree, false), fair(tree)].into_iter().chain(beside(tree)).collect(),
        warnings: warnings.collect(),
        unused_assumptions: report.unused.clone(),
        complete: report.complete,
        results,
    }
}

/// Writes the files that were asked for.
fn written(
    args: &CheckArgs,
    tree: &Tree,
    answer: &TreeAnswer,
    runs: &[Option<Run>],
    screen: &Screen,
) -> Result<(), Failure> {
    let said = |path: &std::path::Path| {
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    };
    if let Some(folder) = &args.wishes.html {
        let rows = answer.results.iter().zip(runs);
        let sections: Vec<_> = rows
            .filter_map(|(row, run)| {
                let (title, class) = (row.message.clone()?, row.level?);
                let help = row.help.clone().unwrap_or_default();
                Some(Section { class, title, help, run: run.as_ref() })
            })
            .collect();
        let title = format!("{}: {}", answer.tree, answer.model);
        let path = folder.join("index.html");
        output::make_folder(folder)?;
        output::file(&path, page::html(tree, &title, &sections).as_bytes())?;
        said(&path);
    }
    if let Some(path) = &args.sarif {
        output::file(path, sarif::text(answer).as_bytes())?;
        said(path);
    }
    Ok(())
}

fn ended(args: &CheckArgs, answer: &TreeAnswer) -> Exit {
    let denied: &[&str] = match args.wishes.deny {
        None => &["error"],
        Some(Deny::Warnings) => &["error", "warning"],
        Some(Deny::Notes) => &["error", "warning", "note"],
    };
    let is_denied = |it: &TreeRow| it.level.is_some_and(|it| denied.contains(&it));
    let warns = args.wishes.deny.is_some() && !answer.warnings.is_empty();
    if warns || answer.results.iter().any(is_denied) {
        return Exit::Violated;
    }
    let unknown = answer.results.iter().any(|it| it.verdict == "unknown");
    if unknown { Exit::Unknown } else { Exit::Success }
}

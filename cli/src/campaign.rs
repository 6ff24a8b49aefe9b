//! `cotama campaign`: many missions under drawn faults, and what comes of them.
#![allow(clippy::cast_precision_loss)] // numbers of runs need no more than 52 bits

use crate::answers::campaign::{CampaignAnswer, DecisionRow, FailureRow, Outcomes, RequirementRow};
use crate::answers::estimate::Measured;
use crate::answers::risk::HeldAnswer;
use crate::args::{CampaignArgs, PolicyName};
use crate::exit::{Exit, Failure};
use crate::margins;
use crate::margins::watch::Watch;
use crate::measurement;
use crate::mission;
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use crate::team::Chosen;
use asked::Test;
use cotama_campaign::findings::Findings;
use cotama_campaign::results::{Header, Tally};
use cotama_campaign::run::{Campaign, Line, Settings, Shard};
use cotama_campaign::statistics::{Decision, Interval};
use cotama_campaign::strategy::BLOCK;
use cotama_campaign::subject::{Policy, Subject};
use cotama_models::margins::Calibration;
use cotama_models::missions::Mission;
use cotama_models::robots::Measurement;
use cotama_models::team::scenario::On;
use cotama_pages::campaign::{self as page, Shown};
use cotama_sim::options::STEPS;
use cotama_sim::trace::{FloorText, RobotText};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use store::Store;

mod asked;
mod compared;
mod derived;
mod indicators;
mod junit;
mod lines;
mod merge;
#[cfg(any(test, feature = "fuzz"))]
pub(crate) mod mutants;
#[cfg(feature = "parquet")]
mod parquet;
mod progress;
mod store;
mod sums;

/// Runs a campaign, or puts the shards of one together.
pub(crate) fn campaign(args: &CampaignArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.junit {
        output::place(path)?;
    }
    if args.scenario == "merge" {
        return merge::merge(args, screen);
    }
    if let Some(folder) = args.shards.first() {
        let message = format!("`{}`: folders are for `merge`", folder.display());
        return Err(Failure::new(message).help("cotama campaign merge DIR... --out DIR"));
    }
    if args.policy() == PolicyName::Exact && (args.objective.is_some() || args.allocator.is_some())
    {
        let message = "--policy exact says who plans: it goes with neither --objective nor \
                       --allocator";
        return Err(Failure::new(message).help("--objective paper --allocator exact is the same"));
    }
    if let Some(team) = Chosen::of(&args.scenario)? {
        return of_team(args, &team, screen);
    }
    let mission = mission::loaded(&args.scenario, args.supervised.as_deref(), Some(screen))?;
    if args.compare {
        held_back(args, &mission)?;
        return compared::compared(args, &mission, screen);
    }
    let policy = args.policy_for(&mission)?;
    let of = asked::Of::mission(&mission);
    let settings = asked::settings(args, of, mission.source(), Some(&mission))?;
    let measured = args.measured.as_deref();
    let measured = measurement::of_run(measured, &mission, policy.fidelity)?;
    let margins = held_back(args, &mission)?;
    let held = indicators::Held { measured: measured.clone(), margins: margins.clone() };
    let campaign = ready(&mission, policy, settings, (measured, margins.clone()))?;
    if let Some(path) = &args.indicators {
        indicators::may_be_written(path, &campaign)?;
    }
    let shard = args.shard.unwrap_or(Shard::ALL);
    let texts = (mission.source(), mission.text());
    let usual = args.policy().policy(mission.is_supervised(), STEPS);
    let planner = policy.planner.filter(|it| *it != usual.of(&mission));
    let header = Header::new(texts, &campaign.settings, args.policy().name(), shard);
    let robot = mission.robot().map(RobotText::of);
    let floor = mission.way.as_ref().map(FloorText::of);
    let fidelity = policy.fidelity;
    let header = Header { planner, robot, floor, fidelity, ..header };
    let exit = conduct(args, &header, &campaign, margins.as_deref(), screen)?;
    if let Some(path) = &args.indicators {
        indicators::write(path, (&mission, &campaign), &held, screen)?;
    }
    Ok(exit)
}

/// Runs a campaign over a team.
fn of_team(args: &CampaignArgs, team: &Chosen, screen: &Screen) -> Result<Exit, Failure> {
    let given = [
        ("--compare", args.compare),
        ("--supervised", args.supervised.is_some()),
        ("--measured", args.measured.is_some()),
        ("--margins", args.margins.is_some()),
        ("--activities", args.activities.is_some()),
        ("--indicators", args.indicators.is_some()),
        ("--policy", args.policy.is_some()),
        ("--objective", args.objective.is_some()),
        ("--allocator", args.allocator.is_some()),
    ];
    if let Some((option, _)) = given.into_iter().find(|it| it.1) {
        let message = format!("{option} is for missions, and this is a team");
        return Err(Failure::new(message).help("the file of a team says how its tasks are given"));
    }
    let source = args.scenario.as_str();
    let settings = asked::settings(args, asked::Of::Team, source, None)?;
    let scenario = team.scenario();
    let floor = scenario.floor.on().and_then(On::ways).map(FloorText::of_team);
    let robots = RobotText::of_team(&scenario);
    let subject = Subject::of_team(scenario, None).named(source);
    let campaign =
        Campaign::new(subject, settings).map_err(|it| Failure::of(source, it.to_string()))?;
    let texts = (source, team.text());
    let shard = args.shard.unwrap_or(Shard::ALL);
    let texts = (texts.0, texts.1.as_str());
    let header = Header::new(texts, &campaign.settings, args.policy().name(), shard);
    conduct(args, &Header { floor, robots, ..header }, &campaign, None, screen)
}

/// Runs what is not stored yet, and answers.
fn conduct(
    args: &CampaignArgs,
    header: &Header,
    campaign: &Campaign<'_>,
    margins: Option<&Calibration>,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let shard = header.shard;
    let mut watch = margins.map(Watch::new);
    let mut table = table(args, campaign)?;
    let mut test = Test::of(args, campaign)?;
    let (mut tally, mut store, mut done) = (Tally::default(), None, 0);
    if let Some(folder) = &args.out {
        let again = |block| campaign.block(block);
        let (opened, blocks) = Store::open(folder, header, &again, &mut |line, text| {
            tally.add(line, text);
            test.iter_mut().for_each(|it| it.add(!line.violated.is_empty()));
        })?;
        derived::clear(folder)?;
        (store, done) = (Some(opened), blocks);
    }
    let wanted = shard.blocks(campaign.settings.runs).count();
    let progress = progress::Progress::new(campaign.settings.runs / shard.of);
    let mut failure = None;
    if done < wanted && !test.is_some_and(|it| it.is_decided()) {
        // A block that was begun is counted as a whole, so that it is kept as a whole.
        campaign.run(shard, done, jobs(args), &mut |lines| {
            let block = lines.first().map_or(0, |it| it.run / BLOCK);
            let texts: Vec<(Line, String)> = lines
                .into_iter()
                .filter_map(|it| serde_json::to_string(&it).ok().map(|text| (it, text)))
                .collect();
            for (line, text) in &texts {
                if let Some((mission, table)) = &mut table {
                    table.add(mission, line.run, &line.observed.spent);
                }
                watch.iter_mut().for_each(|it| it.add(&line.observed.spent));
                tally.add(line, text);
                test.iter_mut().for_each(|it| it.add(!line.violated.is_empty()));
            }
            if let Some(Err(error)) = store.as_mut().map(|it| it.append(block, &texts)) {
                failure = Some(error);
                return ControlFlow::Break(());
            }
            progress.show(tally.runs, tally.failing);
            let over = test.is_some_and(|it| it.is_decided());
            if over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
    }
    progress.clear();
    if let Some(failure) = failure {
        return Err(failure);
    }
    if let Some(((_, table), path)) = table.as_ref().zip(args.activities.as_deref()) {
        table.write(path, screen)?;
    }
    let decision = test.map(|it| decision(&it, args, &tally));
    let held = watch.map(|it| it.held());
    let answer = finish(args, header, campaign, &tally, (decision, held))?;
    ended(args, &answer, screen)
}

/// Returns the margins that the runs of a campaign hold back. Results that are kept, or compared,
/// say nothing of them.
fn held_back(args: &CampaignArgs, mission: &Mission) -> Result<Option<Arc<Calibration>>, Failure> {
    let margins = margins::of_run(args.margins.as_deref(), mission)?;
    let given = [
        ("--compare", args.compare),
        ("--out", args.out.is_some()),
        ("--shard", args.shard.is_some()),
    ];
    let beside = given.into_iter().find(|it| it.1 && margins.is_some());
    let Some((option, _)) = beside else { return Ok(margins) };
    let message = match &args.margins {
        Some(_) => format!("{option} goes without --margins: what it keeps says nothing of them"),
        None => format!(
            "{option} goes without margins, and `{}` names some: what it keeps says nothing of \
             them",
            mission.name
        ),
    };
    Err(Failure::new(message).help(format!("leave {option} out, or say --margins none")))
}

fn ready(
    mission: &Mission,
    policy: Policy,
    settings: Settings,
    (measured, margins): (Option<Arc<Measurement>>, Option<Arc<Calibration>>),
) -> Result<Campaign<'_>, Failure> {
    let subject = Subject::holding(mission, policy, margins)
        .map_err(|error| Failure::of(mission.source(), error.to_string()))?;
    let subject = match measured {
        Some(it) => subject.measured(it),
        None => subject,
    };
    let subject = mission::named(subject, mission.source());
    Campaign::new(subject, settings)
        .map_err(|error| Failure::of(mission.source(), error.to_string()))
}

/// The table of what activities take, where one is wanted.
fn table<'m>(
    args: &CampaignArgs,
    campaign: &Campaign<'m>,
) -> Result<Option<(&'m Mission, margins::Table)>, Failure> {
    let Some(path) = &args.activities else { return Ok(None) };
    output::place(path)?;
    if campaign.settings.runs > margins::MOST_RUNS {
        let message = format!("--activities writes at most {} runs", margins::MOST_RUNS);
        return Err(Failure::new(message).help("ask for fewer --runs"));
    }
    Ok(campaign.subject.mission().map(|it| (it, margins::Table::new())))
}

fn jobs(args: &CampaignArgs) -> usize {
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    args.jobs.map_or_else(processors, |it| usize::try_from(it).unwrap_or(1))
}

fn decision(test: &Test, args: &CampaignArgs, tally: &Tally) -> DecisionRow {
    let verdict = |is_small: bool| if is_small { "at_most" } else { "more" };
    match test {
        Test::Sequential(test) => {
            let (at_most, more_from) = test.between();
            let verdict = test.decision().map_or("undecided", |it| verdict(it == Decision::Small));
            let (confidence, runs) = (args.confidence(), test.runs());
            DecisionRow { verdict, at_most, more_from, confidence, runs, exact: false }
        }
        &Test::Counted(at_most) => {
            let share = tally.failing as f64 / tally.runs.max(1) as f64;
            let (verdict, runs) = (verdict(share <= at_most), tally.runs);
            DecisionRow { verdict, at_most, more_from: at_most, confidence: 1.0, runs, exact: true }
        }
    }
}

/// Makes failures small, writes what is to be written, and answers.
fn finish(
    args: &CampaignArgs,
    header: &Header,
    campaign: &Campaign<'_>,
    tally: &Tally,
    (decision, held): (Option<DecisionRow>, Option<HeldAnswer>),
) -> Result<CampaignAnswer, Failure> {
    let whole = header.shard.of == 1;
    // A file of faults says nothing of margins, without which the failure does not come back.
    let shrinks = whole && held.is_none();
    let most = args.shrink.unwrap_or(if shrinks { 20 } else { 0 });
    let most = usize::try_from(most).unwrap_or(0);
    let requirements = &campaign.settings.requirements;
    let mut findings = Findings::of(&campaign.subject, requirements, tally, most);
    let sampling = campaign.sampling(tally.runs, decision.is_some());
    if args.confidence.is_some() && !sampling.estimates() {
        let message = "--confidence: these plans were not drawn, and no interval is given";
        return Err(Failure::new(message).help("leave --confidence out"));
    }
    let estimate =
        |hits: u64| sampling.interval(hits, tally.runs, args.confidence()).map(Measured::from);
    let rows = requirements.iter().map(|it| {
        let violated = tally.violated.get(&it.to_string()).copied().unwrap_or(0);
        let (requirement, text) = (it.to_string(), campaign.subject.meaning(it));
        RequirementRow { requirement, text, violated, probability: estimate(violated) }
    });
    let failures = findings.clusters.iter().map(|it| FailureRow {
        fault_file: None,
        requirement: it.requirement.to_string(),
        signature: it.signature.clone(),
        count: it.runs.len() as u64,
        run: it.runs.first().copied().unwrap_or(0),
        scenario: it.scenario.clone(),
    });
    let mut answer = CampaignAnswer {
        schema: "cotama/campaign/1",
        mission: campaign.subject.name().to_owned(),
        runs: tally.runs,
        seed: header.seed,
        strategy: header.strategy.clone(),
        policy: header.policy.clone(),
        planner: campaign.subject.words(),
        shard: (!whole).then(|| format!("{}/{}", header.shard.index, header.shard.of)),
        outcomes: Outcomes::from(tally.outcomes),
        failing: tally.failing,
        failure_probability: estimate(tally.failing),
        requirements: rows.collect(),
        failures: failures.collect(),
        shrunk: findings.shrunk,
        shrinking_runs: findings.cost.0,
        decision,
        held,
        digest: tally.digest(),
        policies: Vec::new(),
        report: None,
    };
    if let Some(folder) = &args.out {
        scenarios(folder, &mut answer, &mut findings)?;
        if whole {
            let confidence = args.confidence();
            let shown = Shown { planner: &answer.planner, sampling, confidence };
            let page = page::html(header, campaign, tally, &findings, &shown);
            #[cfg(feature = "parquet")]
            parquet::write(folder, tally.runs)?;
            let path = folder.join("index.html");
            output::file(&path, page.as_bytes())?;
            answer.report = Some(path.display().to_string());
        }
    }
    Ok(answer)
}

/// Writes the failures beside the results.
fn scenarios(
    folder: &Path,
    answer: &mut CampaignAnswer,
    findings: &mut Findings,
) -> Result<(), Failure> {
    if !answer.failures.is_empty() {
        output::make_folder(&derived::failures(folder))?;
    }
    let rows = answer.failures.iter_mut().zip(&mut findings.clusters);
    for (number, (row, cluster)) in (1..).zip(rows) {
        let path = derived::failure(folder, number);
        output::file(&path, row.scenario.as_bytes())?;
        row.fault_file = Some(path.display().to_string());
        cluster.file.clone_from(&row.fault_file);
    }
    Ok(())
}

fn ended(args: &CampaignArgs, answer: &CampaignAnswer, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.junit {
        output::file(path, junit::suite(answer).text().as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    }
    if args.json.json {
        Screen::json(answer)?;
    } else {
        screen.print(&render::campaign::screen(answer, screen.width()))?;
    }
    Ok(match answer.decision.map(|it| it.verdict) {
        Some("at_most") => Exit::Success,
        Some("undecided") => Exit::Unknown,
        None if answer.failing == 0 => Exit::Success,
        _ => Exit::Violated,
    })
}

impl From<Interval> for Measured {
    fn from(it: Interval) -> Self {
        Self { estimate: it.estimate, low: it.low, high: it.high, confidence: it.confidence }
    }
}

impl From<[u64; 3]> for Outcomes {
    fn from([completed, safe, failed]: [u64; 3]) -> Self {
        Self { completed, safe, failed }
    }
}

//! `cotama run two-ways`: the experiment of a short and a long way among moving discs.

use crate::answers::ways::{
    ConditionRow, MeanRow, RatioRow, ShareRow, TrainingRow, WaysAnswer, WaysPolicyRow,
};
use crate::args::{ChoiceRuleName, MemoryName, RunArgs};
use crate::exit::{Exit, Failure};
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use cotama_campaign::statistics::{Interval, clopper_pearson};
use cotama_risk::{ChoiceRule, Memory, Wrong};
use cotama_ways::{
    CONFIDENCE, Condition, InCondition, Learned, Mean, ObjectSpeed, Place, Policy, Ratio, Results,
    Row, Rules, Series, Visit, Way, World, gain, run as make, to_csv, to_svg, train,
};
use std::path::Path;

/// The name on the command line.
pub(crate) const NAME_OF_ALL: &str = "two-ways";
/// Description, for `cotama list`.
pub(crate) const ABOUT: &str =
    "Two ways among moving discs: a robot learns which to risk (Rohrmueller 2011)";

/// Refuses options that are for the experiment alone.
pub(crate) fn none_given(args: &RunArgs) -> Result<(), Failure> {
    match args.ways.first() {
        None => Ok(()),
        Some(option) => Err(Failure::new(format!("{option} is for `cotama run {NAME_OF_ALL}`"))),
    }
}

/// Runs the experiment.
pub(crate) fn run(args: &RunArgs, screen: &Screen) -> Result<Exit, Failure> {
    let others = [("--faults", args.faults != "script"), ("--report", args.report.is_some())];
    let other = others.into_iter().find(|it| it.1).map(|it| it.0);
    let recorded = args.recording.first_of_plane();
    if let Some(option) = args.first_of_missions().or(recorded).or(other).or(args.team.first()) {
        let message = format!("{option} changes nothing in {NAME_OF_ALL}");
        return Err(Failure::new(message).help(format!("leave {option} out")));
    }
    let files = [&args.ways.learned, &args.ways.svg, &args.recording.csv];
    files.into_iter().flatten().try_for_each(|path| output::place(path))?;
    let speed = args.ways.object_speed.map_or(ObjectSpeed::Medium, Into::into);
    let mut world = World::new(args.seed.unwrap_or(0), speed);
    let (learned, trained) = train(&mut world).map_err(wrong)?;
    let policies = match args.ways.policy.as_slice() {
        [] => Policy::COMPARED.to_vec(),
        some => some.to_vec(),
    };
    let of_all = policies.iter().map(|it| runs(args, &mut world, *it, &learned));
    let of_all = of_all.collect::<Result<Vec<_>, _>>().map_err(wrong)?;
    write(args, &world, &learned, &of_all, &trained, screen)?;
    let answer = answer(args, speed, &learned, &policies, &of_all);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::ways::screen(&answer, screen.width()))?;
    }
    Ok(Exit::Success)
}

fn wrong(it: Wrong) -> Failure {
    Failure::new(it.message)
}

fn rules(args: &RunArgs) -> Rules {
    let choice = args.ways.rule.map(|it| match it {
        ChoiceRuleName::Thesis => ChoiceRule::Thesis,
        ChoiceRuleName::Exact => ChoiceRule::Exact,
        ChoiceRuleName::Total => ChoiceRule::Total,
    });
    let memory = args.ways.memory.map(|it| match it {
        MemoryName::Product => Memory::Product,
        MemoryName::Sum => Memory::Sum,
    });
    let usual = Rules::default();
    Rules { choice: choice.unwrap_or(usual.choice), memory: memory.unwrap_or(usual.memory) }
}

/// The runs of a policy; online, each goes on with what the runs before it learned.
fn runs(
    args: &RunArgs,
    world: &mut World,
    policy: Policy,
    learned: &Learned,
) -> Result<Vec<Vec<Visit>>, Wrong> {
    let (mut own, online) = (learned.clone(), args.ways.online);
    let of = |at| make(world, Series::Run(at), policy, rules(args), &mut own, online);
    (0..args.ways.runs.unwrap_or(1)).map(of).collect()
}

/// Writes the files that were asked for.
fn write(
    args: &RunArgs,
    world: &World,
    learned: &Learned,
    of_all: &[Vec<Vec<Visit>>],
    trained: &[Row],
    screen: &Screen,
) -> Result<(), Failure> {
    let written = |path: &Path, text: &str| {
        output::file(path, text.as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        Ok::<_, Failure>(())
    };
    if let Some(path) = &args.ways.learned {
        written(path, &learned.network().map_err(wrong)?.to_bif())?;
    }
    if let Some(path) = &args.recording.csv {
        let visits = of_all.iter().flatten().flatten();
        let rows = trained.iter().chain(visits.flat_map(|it| &it.rows)).copied();
        written(path, &to_csv(&rows.collect::<Vec<_>>()))?;
    }
    if let Some(path) = &args.ways.svg {
        let map = args.ways.map.map_or(0, |it| it as usize - 1);
        let visits = of_all.first().and_then(|it| it.first());
        let is = |it: &&Visit| it.condition == Condition::Limited && it.map == map;
        let rows = visits.and_then(|it| it.iter().find(is)).map_or(&[][..], |it| &it.rows);
        let track = |(trial, row): (usize, &Row)| {
            let condition = Condition::Limited;
            world.track(Place { series: Series::Run(0), condition, map, trial }, row.way)
        };
        let tracks: Vec<_> = rows.iter().enumerate().map(track).collect();
        written(path, &to_svg(world.ring(map), &tracks))?;
    }
    Ok(())
}

fn answer(
    args: &RunArgs,
    speed: ObjectSpeed,
    learned: &Learned,
    policies: &[Policy],
    of_all: &[Vec<Vec<Visit>>],
) -> WaysAnswer {
    let Rules { choice, memory } = rules(args);
    let cell = |ratio: Ratio, way: Way| {
        let [of, failed] = learned.tally(ratio, way);
        let failed = share(clopper_pearson(failed, of, CONFIDENCE), of);
        TrainingRow { ratio: ratio.name(), way: way.name(), failed }
    };
    let cells = Ratio::ALL.iter().flat_map(|ratio| Way::ALL.map(|way| cell(*ratio, way)));
    let policy = |(at, runs): (usize, &Vec<Vec<Visit>>)| {
        let results = Results::new(policies[at], runs);
        let first = of_all.first().filter(|_| at > 0);
        let maps = results.runs * 40;
        WaysPolicyRow {
            policy: results.policy.to_string(),
            reward: mean(results.reward),
            gain: first.and_then(|it| gain(it, runs)).map(|it| MeanRow {
                mean: it.estimate,
                low: Some(it.low),
                high: Some(it.high),
            }),
            reliability: results.reliability.map(|it| share(it, maps)),
            conditions: results.conditions.iter().map(|it| condition(it, maps / 2)).collect(),
        }
    };
    WaysAnswer {
        schema: "cotama/run-two-ways/1",
        seed: args.seed.unwrap_or(0),
        runs: args.ways.runs.unwrap_or(1),
        object_speed: speed.m_s(),
        rule: match choice {
            ChoiceRule::Thesis => "thesis",
            ChoiceRule::Exact => "exact",
            ChoiceRule::Total => "total",
        },
        memory: match memory {
            Memory::Sum => "sum",
            Memory::Product => "product",
        },
        online: args.ways.online,
        training: cells.collect(),
        policies: of_all.iter().enumerate().map(policy).collect(),
    }
}

fn share(it: Interval, of: u64) -> ShareRow {
    ShareRow { share: it.estimate, low: it.low, high: it.high, of }
}

fn mean(it: Mean) -> MeanRow {
    let Mean { value, interval } = it;
    MeanRow { mean: value, low: interval.map(|it| it.low), high: interval.map(|it| it.high) }
}

fn condition(it: &InCondition, maps: u64) -> ConditionRow {
    let ratio = |it: &cotama_ways::AtRatio| RatioRow {
        ratio: it.ratio.name(),
        errors: mean(it.errors),
        reward: mean(it.reward),
        short_first: it.short_first,
        maps: it.maps,
    };
    ConditionRow {
        condition: it.condition.name(),
        errors: mean(it.errors),
        reward: mean(it.reward),
        reward_with_stops: mean(it.reward_with_stops),
        reliability: it.reliability.map(|it| share(it, maps)),
        relative_error: it.relative_error,
        switched: share(it.switched, it.second_trials),
        to_fewer: share(it.to_fewer.0, it.to_fewer.1),
        ratios: it.ratios.iter().map(ratio).collect(),
    }
}

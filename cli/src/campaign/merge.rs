//! `cotama campaign merge`: the shards of one campaign put together.

use super::lines::{Block, Lines};
use super::store::{Store, differs, header};
use super::sums::Sums;
use super::{asked, derived, ended, finish};
use crate::args::CampaignArgs;
use crate::args::PolicyName;
use crate::exit::{Exit, Failure};
use crate::kind::{self, Kind};
use crate::mission;
use crate::output::Screen;
use cotama_campaign::results::{Header, Tally};
use cotama_campaign::run::{Campaign, Shard};
use cotama_campaign::subject::{Policy, Subject};
use cotama_models::missions::Mission;
use cotama_models::team::scenario::Scenario;
use cotama_sim::options::STEPS;
use cotama_sim::trace::RobotText;
use std::path::Path;

/// Puts shards together: the same bytes as one run.
pub(super) fn merge(args: &CampaignArgs, screen: &Screen) -> Result<Exit, Failure> {
    asked::only_merged(args)?;
    let (mut parts, first) = all(args)?;
    let whole = Header { shard: Shard::ALL, ..first };
    // A team is as good a subject: its text says which it is.
    let team = kind::is_of(&whole.mission, Kind::TeamAtWork);
    let settings = whole.settings().map_err(|error| Failure::new(error.to_string()))?;
    if team {
        let ways = whole.floor.as_ref().map(|it| it.ways(&whole.mission));
        let source = &whole.mission_source;
        let robots: Vec<_> = whole.robots.iter().map(RobotText::file).collect::<Result<_, _>>()?;
        let scenario = Scenario::parse_on(source, &whole.mission, ways.as_ref(), &robots)?;
        let subject = Subject::of_team(scenario, None).named(&whole.mission_source);
        let campaign =
            Campaign::new(subject, settings).map_err(|it| Failure::new(it.to_string()))?;
        return merged(args, &whole, &mut parts, &campaign, screen);
    }
    let robot = whole.robot.as_ref().map(RobotText::file).transpose()?;
    let way = whole.floor.as_ref().map(|it| it.way(&whole.mission));
    let (source, text) = (&whole.mission_source, &whole.mission);
    let mission = Mission::parse_on(source, text, robot, way.as_ref())?;
    let unknown = || Failure::new("the campaign names a policy or a setting that is not known");
    let policy = PolicyName::ALL.into_iter().find(|it| it.name() == whole.policy);
    let policy = policy.ok_or_else(unknown)?.policy(mission.is_supervised(), STEPS);
    let planner = whole.planner.or(policy.planner);
    let policy = Policy { planner, fidelity: whole.fidelity, ..policy };
    let subject =
        Subject::new(&mission, policy).map_err(|error| Failure::new(error.to_string()))?;
    let subject = mission::named(subject, &whole.mission_source);
    let campaign =
        Campaign::new(subject, settings).map_err(|error| Failure::new(error.to_string()))?;
    merged(args, &whole, &mut parts, &campaign, screen)
}

/// Puts the lines of the parts together, and answers.
fn merged(
    args: &CampaignArgs,
    whole: &Header,
    parts: &mut [Part],
    campaign: &Campaign<'_>,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let again = |block| campaign.block(block);
    let mut tally = Tally::default();
    // Everything is read before anything is written.
    let mut kept = Vec::new();
    for block in Shard::ALL.blocks(whole.runs) {
        let number = usize::try_from(block).unwrap_or(usize::MAX);
        let (at, position) = (number % parts.len(), number / parts.len());
        let Part { lines: file, sums } = &mut parts[at];
        let Block::Whole(lines, _) = file.block(block, whole.runs)? else {
            let message = "the shard is not complete: the file ends here";
            let help = "give the command of the shard again: it goes on from there";
            return Err(file.wrong_at(file.number(), message, help));
        };
        sums.check(position, block, &lines, file, &again)?;
        lines.iter().for_each(|(line, text)| tally.add(line, text));
        if args.out.is_some() {
            kept.push((block, lines));
        }
    }
    for Part { lines, .. } in &mut *parts {
        if !lines.is_at_end() {
            return Err(lines.wrong("more lines than the campaign has runs"));
        }
    }
    if let Some(folder) = &args.out {
        let (mut store, done) = Store::open(folder, whole, &again, &mut |_, _| {})?;
        derived::clear(folder)?;
        for (block, lines) in kept.iter().skip(done) {
            store.append(*block, lines)?;
        }
    }
    let answer = finish(args, whole, campaign, &tally, (None, None))?;
    ended(args, &answer, screen)
}

/// The results of a shard with their checksums.
struct Part {
    lines: Lines,
    sums: Sums,
}

/// The results of all shards in the order of their numbers, and the header of one of them.
fn all(args: &CampaignArgs) -> Result<(Vec<Part>, Header), Failure> {
    let Some(first) = args.shards.first() else {
        let message = "merge needs the folders of all shards";
        return Err(Failure::new(message).help("cotama campaign merge DIR... --out DIR"));
    };
    let expected = header(first)?;
    let count = usize::try_from(expected.shard.of).unwrap_or(usize::MAX);
    let mut found: Vec<Option<&Path>> = vec![None; count.min(100_000)];
    for folder in &args.shards {
        let (it, name) = (header(folder)?, folder.display().to_string());
        if let Some(what) = differs(&it, &expected) {
            let message = format!(
                "this is no part of the campaign in `{}`: its {what} differs",
                first.display()
            );
            return Err(Failure::of(name, message).help("merge shards of one campaign"));
        }
        let at = usize::try_from(it.shard.index).unwrap_or(0).wrapping_sub(1);
        match found.get_mut(at) {
            Some(slot @ None) => *slot = Some(folder),
            Some(Some(other)) => {
                let (index, of) = (it.shard.index, it.shard.of);
                let message =
                    format!("shard {index}/{of} is there twice: also in `{}`", other.display());
                return Err(Failure::of(name, message).help("give each shard once"));
            }
            None => return Err(Failure::of(name, "its number is not one of the shards")),
        }
    }
    if let Some(missing) = found.iter().position(Option::is_none) {
        let message = format!("shard {}/{count} is missing", missing + 1);
        return Err(Failure::new(message).help("give the folders of all shards"));
    }
    let part = |folder: &Path| {
        let sums = Sums::of(folder, &header(folder)?)?;
        Ok::<_, Failure>(Part { lines: Lines::of(folder)?, sums })
    };
    let parts = found.into_iter().flatten().map(part).collect::<Result<_, _>>()?;
    Ok((parts, expected))
}

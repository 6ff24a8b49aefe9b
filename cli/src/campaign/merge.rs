//! `cotama campaign merge`: the shards of one campaign put together.

use super::store::{Block, Lines, Store, header};
use super::{ended, finish};
use crate::args::CampaignArgs;
use crate::args::PolicyName;
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use cotama_models::missions::Mission;
use cotama_sim::campaign::results::{Header, Tally};
use cotama_sim::campaign::run::{Campaign, Shard};
use cotama_sim::campaign::strategy::BLOCK;
use cotama_sim::campaign::subject::Subject;
use std::path::Path;

/// Puts shards together: the same bytes as one run.
pub(super) fn merge(args: &CampaignArgs, screen: &Screen) -> Result<Exit, Failure> {
    let (mut parts, first) = all(args)?;
    let whole = Header { shard: Shard::ALL, ..first };
    let mission = Mission::parse(&whole.mission_source, &whole.mission)?;
    let unknown = || Failure::new("the campaign names a policy or a setting that is not known");
    let policy = PolicyName::ALL.into_iter().find(|it| it.name() == whole.policy);
    let policy = policy.ok_or_else(unknown)?.policy(mission.supervisor().is_some());
    let subject =
        Subject::new(&mission, policy).map_err(|error| Failure::new(error.to_string()))?;
    let campaign = Campaign::new(subject, whole.settings().ok_or_else(unknown)?)
        .map_err(|error| Failure::new(error.to_string()))?;
    let mut tally = Tally::default();
    // Everything is read before anything is written.
    let mut text = String::new();
    for block in Shard::ALL.blocks(whole.runs) {
        let at = usize::try_from(block).unwrap_or(usize::MAX) % parts.len();
        match parts[at].block(block, whole.runs)? {
            Block::Whole(lines, _) => {
                for (line, json) in &lines {
                    tally.add(line, json);
                    if args.out.is_some() {
                        text.push_str(json);
                        text.push('\n');
                    }
                }
            }
            Block::Torn => {
                let message = "the shard is not complete: the file ends here";
                return Err(parts[at].wrong_with(
                    message,
                    "give the command of the shard again: it goes on from there",
                ));
            }
        }
    }
    for part in &mut parts {
        if !part.is_at_end() {
            return Err(part.wrong("more lines than the campaign has runs"));
        }
    }
    if let Some(folder) = &args.out {
        let (mut store, done) = Store::open(folder, &whole, &mut |_, _| false)?;
        let skipped = Shard::ALL.blocks(whole.runs).take(done).count() as u64 * BLOCK;
        let kept = text.lines().take(usize::try_from(skipped).unwrap_or(usize::MAX));
        let bytes = kept.map(|it| it.len() + 1).sum();
        store.append(text.get(bytes..).unwrap_or_default())?;
    }
    let answer = finish(args, &whole, &campaign, &tally, None)?;
    ended(args, &answer, screen)
}

/// The results of all shards in the order of their numbers, and the header of one of them.
fn all(args: &CampaignArgs) -> Result<(Vec<Lines>, Header), Failure> {
    let Some(first) = args.shards.first() else {
        let message = "merge needs the folders of all shards";
        return Err(Failure::new(message).help("cotama campaign merge DIR... --out DIR"));
    };
    let expected = header(first)?;
    let count = usize::try_from(expected.shard.of).unwrap_or(usize::MAX);
    let mut found: Vec<Option<&Path>> = vec![None; count.min(100_000)];
    for folder in &args.shards {
        let (it, name) = (header(folder)?, folder.display().to_string());
        if let Some(what) = it.differs_from(&expected) {
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
    let parts = found.into_iter().flatten().map(Lines::of).collect::<Result<_, _>>()?;
    Ok((parts, expected))
}

//! Mutants of the two files of a campaign, for tests and fuzz targets.

use super::lines::{Block, Lines};
use super::store::header_in;
use crate::exit::Failure;
use cotama_campaign::results::{Header, Tally};
use cotama_campaign::run::Line;
use cotama_campaign::strategy::BLOCK;
use cotama_fuzz::Reader;
use std::path::Path;

pub(crate) const CAMPAIGNS: Reader = Reader {
    name: "campaigns",
    words: &[
        "null",
        "[]",
        "{}",
        "\"runs\":",
        "\"index\":",
        "\"faults\":",
        "\"cotama-campaign/1\"",
        "\"even\"",
        "\"fmeca\"",
        "\"random\"",
        "18446744073709551615",
        "\"AG !gs.Safe\"",
        "\\u0000",
    ],
    read: read_campaign,
};

pub(crate) const RUNS: Reader = Reader {
    name: "runs",
    words: &[
        "null",
        "[]",
        "{}",
        "\n",
        "\"run\":",
        "\"outcome\":",
        "\"safe\"",
        "\"witness\":",
        "\"at_ms\":0",
        "\"seen\":[]",
        "\"plan\":",
        "18446744073709551615",
        "\\u0000",
    ],
    read: read_runs,
};

/// The runs of the corpus.
const COUNT: u64 = 3;

/// A refusal says in which file, and in which line where that is one of lines.
fn is_refusal(refused: &Failure, file: &str) {
    let Failure::Message { file: Some(place), message, help } = refused else {
        panic!("without its place: {refused:?}")
    };
    assert!(place.starts_with(file) && !message.is_empty() && help.is_some(), "{refused:?}");
}

/// A header that was read is written and read again, and so is what it asks for; its blocks are
/// those of its runs.
fn read_campaign(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let header = match header_in("campaign.json", &text) {
        Ok(header) => header,
        Err(refused) => {
            is_refusal(&refused, "campaign.json");
            return false;
        }
    };
    let written = serde_json::to_string_pretty(&header).expect("it was read");
    assert_eq!(header_in("again", &written).expect("it was written"), header);
    let settings = header.settings().expect("it was asked for");
    let mission = (header.mission_source.as_str(), header.mission.as_str());
    let again = Header::new(mission, &settings, &header.policy, header.shard);
    assert_eq!(again.settings(), Ok(settings));
    let runs = header.runs.min(10 * BLOCK);
    assert!(header.shard.blocks(runs).all(|it| it * BLOCK < runs));
    true
}

/// Lines that were read are those that were asked for, and are written and read again.
fn read_runs(bytes: &[u8]) -> bool {
    let mut lines = Lines::new(Path::new("runs.jsonl"), bytes);
    match lines.block(0, COUNT) {
        Ok(Block::Whole(block, length)) => {
            let rest = &bytes[usize::try_from(length).expect("it was read")..];
            assert_eq!(lines.is_at_end(), rest.iter().all(u8::is_ascii_whitespace));
            let mut tally = Tally::default();
            for (run, (line, text)) in (0..).zip(&block) {
                assert_eq!(line.run, run);
                tally.add(line, text);
                let written = serde_json::to_string(line).expect("it was read");
                let again: Line = serde_json::from_str(&written).expect("it was written");
                assert_eq!(again, *line);
            }
            assert_eq!(tally.runs, COUNT);
            true
        }
        Ok(Block::Torn) => false,
        Err(refused) => {
            is_refusal(&refused, "runs.jsonl:");
            false
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_campaign::run::{Campaign, Settings, Shard};
    use cotama_campaign::subject::{Policy, Subject};
    use cotama_models::missions::{Mission, embedded};

    /// The corpus: a campaign whose requirements are one of each kind, part of it, and its runs.
    #[test]
    fn the_corpora_are_files_of_a_campaign() {
        let texts = ["completed", "energy<=8640000", "never gs.abort", "AG !ls.End"];
        let requirements = texts.map(|it| it.parse().unwrap()).into();
        let settings = Settings { runs: 4_600, requirements, ..Settings::new(true) };
        let shard = Shard { index: 2, of: 3 };
        let header = Header::new(("own.toml", "[limits]\n"), &settings, "usual", shard);
        let text = serde_json::to_string_pretty(&header).unwrap() + "\n";
        CAMPAIGNS.keeps("shard.json", text.as_bytes());

        let patrol = embedded::mission("patrol").unwrap();
        let mission = Mission::parse(patrol.name, patrol.text).unwrap();
        let requirements = ["completed".parse().unwrap()].into();
        let settings = Settings { runs: COUNT, requirements, ..Settings::new(false) };
        let subject = Subject::new(&mission, Policy::default()).unwrap();
        let lines = Campaign::new(subject, settings).unwrap().block(0);
        assert!(lines.iter().any(|it| it.plan.is_some()));
        let text = |it: &Line| serde_json::to_string(it).unwrap() + "\n";
        RUNS.keeps("patrol.jsonl", lines.iter().map(text).collect::<String>().as_bytes());
    }

    #[test]
    fn campaigns_are_read_or_refused_in_a_thousand_mutants() {
        CAMPAIGNS.run(1_000);
    }

    #[test]
    #[ignore = "a minute in a release build, by hand"]
    fn campaigns_are_read_or_refused_in_a_million_mutants() {
        CAMPAIGNS.run_a_million();
    }

    #[test]
    fn runs_are_read_or_refused_in_a_thousand_mutants() {
        RUNS.run(1_000);
    }

    #[test]
    #[ignore = "a minute in a release build, by hand"]
    fn runs_are_read_or_refused_in_a_million_mutants() {
        RUNS.run_a_million();
    }
}

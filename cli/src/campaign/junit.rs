//! Requirements as test cases.

use crate::answers::campaign::{CampaignAnswer, RequirementRow};
use crate::junit::{Case, End, Suite};
use crate::render::campaign::{interval, number};
use std::fmt::Write;

/// One test suite, the mission, with a test case for each requirement. Where it was asked whether
/// failures are rare enough, that is the only test case: a requirement may be broken then.
pub(super) fn suite(answer: &CampaignAnswer) -> Suite {
    let cases = match answer.decision {
        None => answer.requirements.iter().map(|it| requirement(answer, it)).collect(),
        Some(it) => {
            let asked: Vec<_> = answer.requirements.iter().map(|it| &*it.requirement).collect();
            let name = format!("{} in all but {} of runs", asked.join(" and "), it.at_most);
            let message = format!(
                "{} of {} runs break a requirement",
                number(answer.failing),
                number(answer.runs)
            );
            let mut more = String::new();
            answer.requirements.iter().for_each(|it| more.push_str(&told(answer, it)));
            let end = match it.verdict {
                "at_most" => End::Passed,
                "more" => End::Failed(message, more),
                _ => End::Unknown(format!("not decided: {message}"), more),
            };
            vec![Case { name, seconds: None, end }]
        }
    };
    let part = answer.shard.as_ref().map_or_else(String::new, |it| format!(", part {it}"));
    Suite { name: format!("{}{part}", answer.mission), cases }
}

fn requirement(answer: &CampaignAnswer, row: &RequirementRow) -> Case {
    let end = if row.violated == 0 {
        End::Passed
    } else {
        let message = format!("broken in {} of {} runs", number(row.violated), number(answer.runs));
        End::Failed(message, told(answer, row))
    };
    Case { name: row.requirement.clone(), seconds: None, end }
}

/// A requirement in words, how often it is broken, and the causes that were found.
fn told(answer: &CampaignAnswer, row: &RequirementRow) -> String {
    // Writing to a string cannot fail.
    let mut text = format!("{}: {}\n", row.requirement, row.text);
    let _ = write!(text, "broken in {} of {} runs", number(row.violated), number(answer.runs));
    let _ = match row.probability {
        Some(it) => writeln!(text, " {}", interval(it)),
        None => writeln!(text),
    };
    for cause in answer.failures.iter().filter(|it| it.requirement == row.requirement) {
        let file = cause.fault_file.as_deref().unwrap_or("its file:");
        let _ =
            writeln!(text, "\n{}, in {} of those made small: {file}", cause.signature, cause.count);
        text.push_str(&cause.scenario);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::campaign::{DecisionRow, FailureRow, Outcomes};

    fn answer(broken: &[(&str, u64)]) -> CampaignAnswer {
        let row = |(name, violated): &(&str, u64)| RequirementRow {
            requirement: (*name).to_owned(),
            text: "in words".to_owned(),
            violated: *violated,
            probability: None,
        };
        CampaignAnswer {
            schema: "cotama/campaign/1",
            mission: "own & \"mine\"".to_owned(),
            runs: 20,
            seed: 0,
            strategy: String::new(),
            policy: String::new(),
            planner: String::new(),
            shard: None,
            outcomes: Outcomes::from([20, 0, 0]),
            failing: broken.iter().map(|it| it.1).max().unwrap_or(0),
            failure_probability: None,
            requirements: broken.iter().map(row).collect(),
            failures: Vec::new(),
            shrunk: 0,
            shrinking_runs: 0,
            decision: None,
            held: None,
            digest: String::new(),
            policies: Vec::new(),
            report: None,
        }
    }

    #[test]
    fn each_requirement_is_a_case_and_a_broken_one_fails_with_its_causes() {
        let mut answer = answer(&[("time<=5", 3), ("AG (a -> <b>)", 0), ("brakes", 20)]);
        answer.failures.push(FailureRow {
            fault_file: Some("found/failures/001.toml".to_owned()),
            requirement: "time<=5".to_owned(),
            signature: "SON1".to_owned(),
            count: 3,
            run: 7,
            scenario: "# Breaks `time<=5`\n".to_owned(),
        });
        let text = suite(&answer).text();
        for part in [
            "name=\"own &amp; &quot;mine&quot;\" tests=\"3\" failures=\"2\" errors=\"0\"",
            "name=\"time&lt;=5\">\n      <failure message=\"broken in 3 of 20 runs\">",
            "SON1, in 3 of those made small: found/failures/001.toml&#10;# Breaks `time&lt;=5`",
            "name=\"AG (a -&gt; &lt;b&gt;)\"/>",
            "name=\"brakes\">\n      <failure message=\"broken in 20 of 20 runs\">",
        ] {
            assert!(text.contains(part), "{part}\n{text}");
        }
    }

    #[test]
    fn the_decision_is_the_only_case_where_failures_may_be_rare() {
        for (verdict, counts) in [
            ("at_most", "failures=\"0\" errors=\"0\""),
            ("more", "failures=\"1\" errors=\"0\""),
            ("undecided", "failures=\"0\" errors=\"1\""),
        ] {
            let mut answer = answer(&[("completed", 1), ("time<=5", 0)]);
            let (at_most, more_from, confidence, runs) = (0.1, 0.2, 0.95, 20);
            let exact = false;
            answer.decision =
                Some(DecisionRow { verdict, at_most, more_from, confidence, runs, exact });
            let text = suite(&answer).text();
            assert!(text.contains("tests=\"1\"") && text.contains(counts), "{verdict}\n{text}");
            assert!(text.contains("name=\"completed and time&lt;=5 in all but 0.1 of runs\""));
        }
    }
}

//! A campaign as one page: what came of the runs, why they failed, what was covered.

mod pictures;

use crate::format::{count, grouped};
use crate::frame;
use cotama_campaign::findings::Findings;
use cotama_campaign::results::{Header, Tally};
use cotama_campaign::run::Campaign;
use cotama_campaign::sampling::Sampling;
use cotama_campaign::statistics::Interval;
use cotama_core::text::markup;
use cotama_models::robots::Robot;
use std::fmt::Write;

/// The most causes that are shown with their files.
const MOST_CAUSES: usize = 60;

/// How a campaign is shown.
///
/// ```
/// use cotama_campaign::sampling::Sampling;
/// use cotama_pages::campaign::Shown;
/// let shown = Shown { planner: "a search", sampling: Sampling::Fixed, confidence: 0.95 };
/// assert!(shown.sampling.estimates());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown<'s> {
    /// The planner in words, as they follow "plans are made by".
    pub planner: &'s str,
    /// The sampling of the runs.
    pub sampling: Sampling,
    /// How often an interval holds the truth, at least: from 0 to 1.
    pub confidence: f64,
}

/// Writes the report of a campaign as an HTML page, which needs nothing else and suits wide and
/// narrow screens, light and dark ones, and paper.
pub fn html(
    header: &Header,
    campaign: &Campaign<'_>,
    tally: &Tally,
    findings: &Findings,
    shown: &Shown<'_>,
) -> String {
    let &Shown { sampling, confidence, .. } = shown;
    let name = markup(campaign.subject.name());
    let mut page = String::new();
    let team = campaign.subject.is_team();
    head(&mut page, header, shown, (&name, team), tally);
    outcomes(&mut page, team, tally, sampling, confidence);
    requirements(&mut page, campaign, tally, sampling, confidence);
    causes(&mut page, header, findings);
    // A team has no path on which its runs could end.
    if !team {
        page.push_str(&pictures::ends(tally, campaign.subject.path_length().0));
    }
    let robot = campaign.subject.mission().and_then(|it| it.robot());
    if let Some(robot) = robot {
        coverage(&mut page, tally, robot.robot());
    }
    page.push_str(&pictures::settles(tally, sampling, confidence));
    assumptions(&mut page, header, sampling);
    let title = format!("{}: campaign report", campaign.subject.name());
    frame::page(&title, &[include_str!("campaign.css")], &page)
}

fn head(
    page: &mut String,
    header: &Header,
    shown: &Shown<'_>,
    (name, team): (&str, bool),
    tally: &Tally,
) {
    let (class, shape, sentence) = if tally.failing == 0 {
        ("completed", "M9 17l5 5 9-12", "No run breaks a requirement".to_owned())
    } else {
        let one = if tally.failing == 1 { "run breaks" } else { "runs break" };
        let sentence = format!("{} {one} a requirement", grouped(tally.failing.into()));
        ("failed", "M16 8v10M16 22.5v.5", sentence)
    };
    let faults = match header.faults {
        (least, most) if least == most => count(most, "fault"),
        (least, most) => format!("{least} to {most} faults"),
    };
    let _ = write!(
        page,
        "<header><p class=\"kicker\">Report of a fault campaign</p>\n<h1>{name}</h1>\n\
         <div class=\"outcome {class}\"><svg viewBox=\"0 0 32 32\" aria-hidden=\"true\">\
         <circle cx=\"16\" cy=\"16\" r=\"15\"/><path d=\"{shape}\"/></svg>\
         <p><strong>{sentence}</strong><span>of {}, {faults} each, drawn by the strategy \
         {}, seed {}. {} {}.</span></p></div>\n</header>\n",
        count(tally.runs, "run"),
        markup(&header.strategy),
        header.seed,
        if team { "Tasks are given out by the" } else { "Plans are made by" },
        markup(shown.planner)
    );
}

/// A share with its interval, as a bar.
fn bar(class: &str, it: Interval) -> String {
    let percent = |it: f64| format!("{:.3}", 100.0 * it);
    format!(
        "<div class=\"interval\" role=\"img\" aria-label=\"{} to {} percent\">\
         <i class=\"{class}\" style=\"width:{}%\"></i>\
         <b style=\"left:{}%;width:{}%\"></b></div>",
        percent(it.low),
        percent(it.high),
        percent(it.estimate),
        percent(it.low),
        percent(it.high - it.low)
    )
}

/// A share in percent, with as many digits as a small one needs.
fn share(it: f64) -> String {
    let percent = 100.0 * it;
    if percent == 0.0 || percent >= 1.0 {
        return format!("{percent:.1} %");
    }
    let enough = |it: &u8| percent * libm::pow(10.0, f64::from(*it)) >= 1.0;
    let digits = usize::from((1..12).find(enough).unwrap_or(12)) + 1;
    format!("{percent:.digits$} %")
}

fn between(it: Interval) -> String {
    format!("{} to {}", share(it.low), share(it.high))
}

/// A share without an interval, as a bar.
fn plain_bar(class: &str, share: f64) -> String {
    format!(
        "<div class=\"interval\"><i class=\"{class}\" style=\"width:{:.3}%\"></i></div>",
        100.0 * share
    )
}

fn outcomes(page: &mut String, team: bool, tally: &Tally, sampling: Sampling, confidence: f64) {
    page.push_str("<section><h2>How the runs ended</h2>\n<table class=\"campaign\">\n");
    let safe = if team { "some tasks reported" } else { "stopped safely" };
    let names = [("completed", "good"), (safe, "warn"), ("failed", "bad")];
    for ((name, class), hits) in names.into_iter().zip(tally.outcomes) {
        let part = hits as f64 / tally.runs.max(1) as f64;
        let interval = sampling.interval(hits, tally.runs, confidence);
        let _ = writeln!(
            page,
            "<tr><th>{name}</th><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
            count(hits, "run"),
            share(part),
            interval.map_or_else(|| plain_bar(class, part), |it| bar(class, it))
        );
    }
    let thin = if sampling.estimates() {
        format!(
            " The thin bar is the interval that holds the share of all such runs with {} % \
             confidence.",
            100.0 * confidence
        )
    } else {
        String::new()
    };
    let mean = |sum: u128| sum as f64 / tally.runs.max(1) as f64;
    let [seconds, joules] = [0, 1].map(|it| mean(tally.sums[it]) / 1_000.0);
    let requests = if team {
        String::new()
    } else {
        format!(" and {:.2} requests to the operator", mean(tally.sums[2]))
    };
    let between = if team { " and" } else { "," };
    let _ = write!(
        page,
        "</table>\n<p class=\"note\">On average {seconds:.1} s{between} {joules:.1} \
         J{requests}.{thin}</p></section>\n"
    );
}

fn requirements(
    page: &mut String,
    campaign: &Campaign<'_>,
    tally: &Tally,
    sampling: Sampling,
    confidence: f64,
) {
    page.push_str("<section><h2>What must hold</h2>\n<table class=\"campaign\">\n");
    for it in &campaign.settings.requirements {
        let name = it.to_string();
        let hits = tally.violated.get(&name).copied().unwrap_or(0);
        let (class, words) = if hits == 0 {
            ("good", "holds in all runs".to_owned())
        } else {
            ("bad", format!("broken in {}", count(hits, "run")))
        };
        let interval = match (sampling, sampling.interval(hits, tally.runs, confidence)) {
            (_, Some(it)) => format!("probability {}", between(it)),
            (Sampling::Every, _) => {
                format!("{} of all plans, exactly", share(hits as f64 / tally.runs.max(1) as f64))
            }
            _ => "no probability: plans were chosen, not drawn".to_owned(),
        };
        let _ = writeln!(
            page,
            "<tr><th><code>{}</code><small>{}</small></th><td class=\"{class}\">{words}\
             <small>{interval}</small></td></tr>",
            markup(&name),
            markup(&campaign.subject.meaning(it))
        );
    }
    page.push_str("</table></section>\n");
}

fn causes(page: &mut String, header: &Header, findings: &Findings) {
    if findings.clusters.is_empty() {
        return;
    }
    let _ = write!(
        page,
        "<section><h2>Why they failed</h2>\n<p>{} made small in {}, at most {} for one. Failures \
         with the same faults left are put together. A file of a failure says who plans and how \
         the run ends: it is run again so and compared, and exit code 1 says that it does not come \
         back.</p>\n",
        count(findings.shrunk, "failing run"),
        count(findings.cost.0, "run"),
        grouped(findings.cost.1.into())
    );
    for it in findings.clusters.iter().take(MOST_CAUSES) {
        let _ = writeln!(
            page,
            "<details class=\"cause\"><summary><span class=\"many\">{}</span> \
             <span>{}</span> <span class=\"broken\">breaks <code>{}</code></span></summary>\
             <p>{}</p><pre>{}</pre></details>",
            count(it.runs.len() as u64, "run"),
            markup(&it.signature),
            markup(&it.requirement.to_string()),
            again(it.file.as_deref(), &header.mission_source),
            markup(&it.scenario)
        );
    }
    if findings.clusters.len() > MOST_CAUSES {
        let more = findings.clusters.len() - MOST_CAUSES;
        let _ = writeln!(page, "<p class=\"note\">And {} more.</p>", count(more as u64, "cause"));
    }
    page.push_str("</section>\n");
}

/// The command that runs a failure again.
fn again(file: Option<&str>, mission: &str) -> String {
    let code = |line: String| format!("<code>{}</code>", markup(&line));
    if let Some(file) = file {
        return code(format!("cotama replay {}", shell_word(file)));
    }
    let line = format!("cotama replay failure.toml --mission {}", shell_word(mission));
    format!("Saved as <code>failure.toml</code>: {}", code(line))
}

/// A word as a shell takes it.
fn shell_word(word: &str) -> String {
    let safe = |it: char| it.is_alphanumeric() || "-_./:=+@,".contains(it);
    if !word.is_empty() && word.chars().all(safe) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// Rows of the FMECA by the place of the local supervisor, as a heat map.
fn coverage(page: &mut String, tally: &Tally, robot: &Robot) {
    let parts = robot.sub_objectives.iter().map(|it| it.name.as_str());
    let states: Vec<&str> = parts.chain(["Waits"]).collect();
    let most = tally.cells.values().map(|it| it.0).max().unwrap_or(1).max(1) as f64;
    page.push_str(
        "<section><h2>What was covered</h2>\n<p>In how many runs a row of the FMECA was met in \
         each place of the local supervisor; darker is more, red are cells with failing runs.</p>\n\
         <div class=\"scroll\"><table class=\"heat\">\n<tr><th></th>",
    );
    states.iter().for_each(|it| {
        let _ = write!(page, "<th>{}</th>", markup(it));
    });
    page.push_str("</tr>\n");
    let mut empty = 0;
    for row in &robot.failures {
        let _ = write!(page, "<tr><th>{}</th>", markup(&row.id));
        for state in &states {
            let cell = tally.cells.get(&format!("{}@{state}", row.id));
            let (met, failing) = cell.copied().unwrap_or((0, 0));
            empty += u64::from(met == 0);
            // The shade is the root of the share, so that rare cells are seen beside frequent ones.
            let shade = (met as f64 / most).sqrt();
            let class = if failing > 0 { "hot" } else { "met" };
            let title = format!("{met} runs, {failing} failing");
            let _ = write!(
                page,
                "<td class=\"{class}\" title=\"{title}\" style=\"--s:{shade:.3}\">{}</td>",
                if met == 0 { "·".to_owned() } else { grouped(met.into()) }
            );
        }
        page.push_str("</tr>\n");
    }
    let _ = write!(
        page,
        "</table></div>\n<p class=\"note\">{} of {} cells were not met.</p></section>\n",
        empty,
        robot.failures.len() * states.len()
    );
}

fn assumptions(page: &mut String, header: &Header, sampling: Sampling) {
    let rates = if header.rates == "fmeca" {
        "Rows of the FMECA are as likely as their mean times between failures say, most of which \
         are assumed; that one fails at all is given."
    } else {
        "All kinds of faults are equally likely, which no robot's are: a share of failures is one \
         of plans drawn so, and no rate of failures in use."
    };
    let drawn = match sampling {
        Sampling::Fixed => {
            "Plans are drawn independently of each other, so the intervals are exact (Clopper and \
             Pearson)."
        }
        Sampling::Stopped => {
            "Plans are drawn independently of each other until a test is decided; the intervals \
             hold whenever that is (Robbins), and are wider than those of a fixed number of runs."
        }
        Sampling::Every => {
            "Every plan of the strategy's timeline was run: shares are exact, and need no interval."
        }
        Sampling::Chosen => {
            "Plans are chosen, not drawn independently, so shares estimate nothing: they say what \
             was found."
        }
    };
    let _ = write!(
        page,
        "<section><h2>What this rests on</h2>\n<p>{rates} {drawn} What faults do to the robot is \
         the simulator's model of them. Version {}, policy {}.</p></section>\n",
        markup(&header.version),
        markup(&header.policy)
    );
}

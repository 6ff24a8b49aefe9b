//! A campaign as one page: what came of the runs, why they failed, what was covered.

use super::format::{count, grouped};
use super::svg::escape;
use crate::campaign::findings::Findings;
use crate::campaign::results::{Header, Tally};
use crate::campaign::run::Campaign;
use crate::campaign::statistics::{Interval, clopper_pearson};
use cotama_models::cotama::FailureMode;
use cotama_models::missions::faults::Moment;
use std::fmt::Write;

/// The most causes that are shown with their files.
const MOST_CAUSES: usize = 60;

/// Writes the report of a campaign as an HTML page, which needs nothing else and suits wide and
/// narrow screens, light and dark ones, and paper.
pub fn html(
    header: &Header,
    campaign: &Campaign<'_>,
    tally: &Tally,
    findings: &Findings,
    confidence: f64,
) -> String {
    let name = escape(&campaign.subject.mission().name);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{name}: campaign report\
         </title>\n<style>\n{}{}</style>\n</head>\n<body>\n<main>\n",
        include_str!("style.css"),
        include_str!("campaign.css")
    );
    head(&mut page, header, &name, tally);
    outcomes(&mut page, tally, confidence);
    requirements(&mut page, campaign, tally, confidence);
    causes(&mut page, findings);
    if campaign.subject.is_supervised() {
        coverage(&mut page, tally);
    }
    course(&mut page, tally, campaign.estimates(), confidence);
    assumptions(&mut page, header, campaign);
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

fn head(page: &mut String, header: &Header, name: &str, tally: &Tally) {
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
         {}, seed {}.</span></p></div>\n</header>\n",
        count(tally.runs, "run"),
        escape(&header.strategy),
        header.seed
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
    let enough = |it: &u8| percent * 10_f64.powi(i32::from(*it)) >= 1.0;
    let digits = usize::from((1..12).find(enough).unwrap_or(12)) + 1;
    format!("{percent:.digits$} %")
}

fn between(it: Interval) -> String {
    format!("{} to {}", share(it.low), share(it.high))
}

fn outcomes(page: &mut String, tally: &Tally, confidence: f64) {
    page.push_str("<section><h2>How the runs ended</h2>\n<table class=\"campaign\">\n");
    let names = [("completed", "good"), ("stopped safely", "warn"), ("failed", "bad")];
    for ((name, class), hits) in names.into_iter().zip(tally.outcomes) {
        let it = clopper_pearson(hits, tally.runs, confidence);
        let _ = writeln!(
            page,
            "<tr><th>{name}</th><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
            grouped(hits.into()),
            share(it.estimate),
            bar(class, it)
        );
    }
    let mean = |sum: u128| sum as f64 / tally.runs.max(1) as f64;
    let _ = write!(
        page,
        "</table>\n<p class=\"note\">On average {:.1} s, {:.1} J and {:.2} requests to the \
         operator. The thin bar is the interval that holds the share of all such runs with {} % \
         confidence.</p></section>\n",
        mean(tally.sums[0]) / 1_000.0,
        mean(tally.sums[1]) / 1_000.0,
        mean(tally.sums[2]),
        100.0 * confidence
    );
}

fn requirements(page: &mut String, campaign: &Campaign<'_>, tally: &Tally, confidence: f64) {
    page.push_str("<section><h2>What must hold</h2>\n<table class=\"campaign\">\n");
    for it in &campaign.settings.requirements {
        let name = it.to_string();
        let hits = tally.violated.get(&name).copied().unwrap_or(0);
        let found = tally.probability(&name, confidence);
        let (class, words) = if hits == 0 {
            ("good", "holds in all runs".to_owned())
        } else {
            ("bad", format!("broken in {}", count(hits, "run")))
        };
        let interval = if campaign.estimates() {
            format!("probability {}", between(found))
        } else {
            "no probability: plans were not drawn independently".to_owned()
        };
        let _ = writeln!(
            page,
            "<tr><th><code>{}</code><small>{}</small></th><td class=\"{class}\">{words}\
             <small>{interval}</small></td></tr>",
            escape(&name),
            escape(&it.words())
        );
    }
    page.push_str("</table></section>\n");
}

fn causes(page: &mut String, findings: &Findings) {
    if findings.clusters.is_empty() {
        return;
    }
    let _ = write!(
        page,
        "<section><h2>Why they failed</h2>\n<p>{} made small in {}, at most {} for one. Failures \
         with the same faults left are put together. Each file replays one of them: save it, and \
         <code>cotama run MISSION --faults FILE</code>.</p>\n",
        count(findings.shrunk, "failing run"),
        count(findings.cost.0, "run"),
        grouped(findings.cost.1.into())
    );
    for it in findings.clusters.iter().take(MOST_CAUSES) {
        let _ = writeln!(
            page,
            "<details class=\"cause\"><summary><b>{}</b> {} <code>{}</code></summary>\
             <pre>{}</pre></details>",
            grouped((it.runs.len() as u64).into()),
            escape(&it.signature),
            escape(&it.requirement.to_string()),
            escape(&it.scenario)
        );
    }
    if findings.clusters.len() > MOST_CAUSES {
        let more = findings.clusters.len() - MOST_CAUSES;
        let _ = writeln!(page, "<p class=\"note\">And {} more.</p>", count(more as u64, "cause"));
    }
    page.push_str("</section>\n");
}

/// Rows of the FMECA by the place of the local supervisor, as a heat map.
fn coverage(page: &mut String, tally: &Tally) {
    let states = Moment::STATES.map(|it| it.0);
    let most = tally.cells.values().map(|it| it.0).max().unwrap_or(1).max(1) as f64;
    page.push_str(
        "<section><h2>What was covered</h2>\n<p>In how many runs a row of the FMECA was met in \
         each place of the local supervisor; darker is more, red are cells with failing runs.</p>\n\
         <div class=\"scroll\"><table class=\"heat\">\n<tr><th></th>",
    );
    states.iter().for_each(|it| {
        let _ = write!(page, "<th>{it}</th>");
    });
    page.push_str("</tr>\n");
    let mut empty = 0;
    for mode in FailureMode::ALL {
        let _ = write!(page, "<tr><th>{}</th>", mode.name());
        for state in states {
            let cell = tally.cells.get(&format!("{}@{state}", mode.name()));
            let (met, failing) = cell.copied().unwrap_or((0, 0));
            empty += u64::from(met == 0);
            // Its root, so that rare cells are seen beside frequent ones.
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
        FailureMode::ALL.len() * states.len()
    );
}

fn course(page: &mut String, tally: &Tally, estimates: bool, confidence: f64) {
    if !estimates {
        return;
    }
    page.push_str(
        "<section><h2>How the estimate settles</h2>\n<table class=\"campaign\">\n<tr><th>runs</th>\
         <th class=\"n\">failing</th><th>probability of failure</th></tr>\n",
    );
    let last = (tally.runs, tally.failing);
    let more = tally.course.last() != Some(&last);
    for (runs, failing) in tally.course.iter().copied().chain(more.then_some(last)) {
        let it = clopper_pearson(failing, runs, confidence);
        let _ = writeln!(
            page,
            "<tr><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
            grouped(runs.into()),
            grouped(failing.into()),
            between(it)
        );
    }
    page.push_str("</table></section>\n");
}

fn assumptions(page: &mut String, header: &Header, campaign: &Campaign<'_>) {
    let rates = if header.rates == "fmeca" {
        "Rows of the FMECA are as likely as their mean times between failures say, most of which \
         are assumed; that one fails at all is given."
    } else {
        "All kinds of faults are equally likely, which no robot's are: a share of failures is one \
         of plans drawn so, and no rate of failures in use."
    };
    let drawn = if campaign.estimates() {
        "Plans are drawn independently of each other, so the intervals are exact (Clopper and \
         Pearson)."
    } else {
        "Plans are not drawn independently, so shares estimate nothing: they say what was found."
    };
    let _ = write!(
        page,
        "<section><h2>What this rests on</h2>\n<p>{rates} {drawn} What faults do to the robot is \
         the simulator's model of them. Version {}, policy {}.</p></section>\n",
        escape(&header.version),
        escape(&header.policy)
    );
}

//! Growth of the thesis's methods with the number of robots, and its benchmark, as one page.

use crate::chart::{Chart, Scale, Series};
use crate::frame;
use cotama_models::team::curves::{Benchmark, Growth};
use std::fmt::Write;

/// Messages of a round with a task for all robots (Table 3.1), counted in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Messages {
    /// As many tasks of one robot as robots.
    pub singles: u64,
    /// One task of all robots; the auctioneer looks for the coalition (`MuRoCo`).
    pub central: u64,
    /// The same; brokers look for it (`MuRoCo`-D).
    pub distributed: u64,
}

impl Messages {
    /// Returns the steps that a message may take before `MuRoCo` is quicker than `MuRoCo`-D,
    /// rounded down (Fig. 3.5b); `None` where that sends no more.
    pub fn steps_a_message(&self, work: &Growth) -> Option<u64> {
        let more = self.distributed.checked_sub(self.central).filter(|it| *it > 0)?;
        Some(work.central.saturating_sub(work.distributed) / more)
    }
}

/// All curves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Curves {
    /// Work and messages, by the number of robots.
    pub growth: Vec<(Growth, Messages)>,
    /// The benchmark, by the number of robots, within these by the number of capable ones.
    pub benchmark: Vec<Benchmark>,
}

impl Curves {
    /// Returns the largest teams of the benchmark that have an even number of robots, with all
    /// their rows: few enough to tell their curves apart.
    pub fn teams(&self) -> impl Iterator<Item = &[Benchmark]> {
        let chunks = self.benchmark.chunk_by(|a, b| a.robots == b.robots);
        let even = chunks.filter(|it| it.first().is_some_and(|it| it.robots % 2 == 0));
        let even: Vec<_> = even.collect();
        let skipped = even.len().saturating_sub(8);
        even.into_iter().skip(skipped)
    }
}

/// Writes the curves as an HTML page, which needs nothing else and suits wide and narrow screens,
/// light and dark ones, and paper.
///
/// ```
/// use cotama_models::team::curves::{benchmark, growth};
/// use cotama_pages::curves::{Curves, Messages, html};
/// let messages = Messages { singles: 16, central: 28, distributed: 60 };
/// let benchmark = (0..=4).map(|it| benchmark(4, it)).collect();
/// let page = html(&Curves { growth: vec![(growth(4), messages)], benchmark });
/// assert!(page.contains("Fig. 3.8"));
/// ```
pub fn html(curves: &Curves) -> String {
    let most = curves.growth.last().map_or(0, |it| it.0.robots);
    let mut page = format!(
        "<header><p class=\"kicker\">Coalitions of robots</p>\n<h1>Growth of the work</h1>\n\
         <p>One task with a plan for each number of robots, teams of up to {most} robots. All is \
         counted in steps, not timed: to assign z roles to z robots takes z³ steps. Figures are \
         those of F. Rohrmueller, <i>Cooperative Action Selection</i> (TU München, 2011, ch. 3); \
         dashed lines are its bounds.</p>\n</header>\n"
    );
    section(
        &mut page,
        "Computation and messages",
        "All coalitions are looked at by the auctioneer (MuRoCo), or shared out among the robots \
         (MuRoCo-D), of which the busiest counts; an exhaustive search takes each ordering of \
         robots. One assignment a plan finds the same optimum where the mean of costs counts.",
        &[computation(curves), messages(curves)],
    );
    section(
        &mut page,
        "Relations",
        "A search that takes coalitions of k robots at most, in nᵏ steps, is as slow as MuRoCo \
         from this share k/n on. A message may cost so many steps before it is better that one \
         robot does it all.",
        &[share(curves), steps_a_message(curves)],
    );
    section(
        &mut page,
        "Benchmark",
        "All roles need the same two capabilities. Capable robots have both; the others have one \
         of them, in turns.",
        &[benchmark(curves), pay_off(curves), passed(curves)],
    );
    frame::page("Coalitions of robots: growth of the work", &[include_str!("curves.css")], &page)
}

fn section(page: &mut String, title: &str, words: &str, charts: &[Chart<'_>]) {
    let _ = write!(page, "<section><h2>{title}</h2>\n<p>{words}</p>\n");
    charts.iter().for_each(|it| *page += &it.figure());
    *page += "</section>\n";
}

/// A line of growth.
fn line(
    curves: &Curves,
    name: &str,
    style: usize,
    value: impl Fn(&(Growth, Messages)) -> Option<u64>,
) -> Series {
    let points = curves.growth.iter().filter_map(|it| Some((it.0.robots, value(it)?)));
    Series { name: name.to_owned(), style, points: points.collect() }
}

fn computation(curves: &Curves) -> Chart<'static> {
    let series = vec![
        line(curves, "all coalitions (MuRoCo)", 0, |it| Some(it.0.central)),
        line(curves, "busiest robot (MuRoCo-D)", 2, |it| Some(it.0.distributed)),
        line(curves, "orderings", 1, |it| it.0.orderings),
        line(curves, "one assignment a plan", 3, |it| Some(it.0.assignment)),
        line(curves, "bound 2ⁿn³", 4, |it| Some(it.0.bounds.central)),
        line(curves, "bound 2ⁿn²", 6, |it| Some(it.0.bounds.distributed)),
        line(curves, "bound n!", 5, |it| Some(it.0.bounds.orderings)),
    ];
    let title = "Fig. 3.4a: computation";
    Chart { title, unit: "steps", along: "robots", scale: Scale::Log, series }
}

fn messages(curves: &Curves) -> Chart<'static> {
    let series = vec![
        line(curves, "MuRoCo", 0, |it| Some(it.1.central * 1_000)),
        line(curves, "MuRoCo-D", 2, |it| Some(it.1.distributed * 1_000)),
        line(curves, "tasks of one robot each", 3, |it| Some(it.1.singles * 1_000)),
    ];
    let title = "Fig. 3.4b: messages of a round";
    Chart { title, unit: "counted in a run", along: "robots", scale: Scale::Linear, series }
}

fn share(curves: &Curves) -> Chart<'static> {
    let share = |it: &(Growth, Messages)| Some(it.0.bounds.share_permille).filter(|it| *it > 0);
    let series = vec![line(curves, "least k/n", 0, share)];
    let title = "Fig. 3.5a: size limit of coalitions";
    Chart { title, unit: "share of the robots", along: "robots", scale: Scale::Linear, series }
}

fn steps_a_message(curves: &Curves) -> Chart<'static> {
    let series = vec![
        line(curves, "counted", 0, |it| it.1.steps_a_message(&it.0)),
        line(curves, "bound 2ⁿ⁻¹(n-1)", 4, |it| Some(it.0.bounds.steps_a_message)),
    ];
    let title = "Fig. 3.5b: cost of a message";
    Chart { title, unit: "steps", along: "robots", scale: Scale::Log, series }
}

fn benchmark(curves: &Curves) -> Chart<'static> {
    let team = |(style, rows): (usize, &[Benchmark])| Series {
        name: format!("{} robots", rows.first().map_or(0, |it| it.robots)),
        style,
        points: rows.iter().map(|it| (it.capable, it.busiest)).collect(),
    };
    let series = curves.teams().enumerate().map(team).collect();
    let title = "Fig. 3.8: work by the number of capable robots";
    let unit = "steps of the busiest robot, for capable coalitions";
    Chart { title, unit, along: "capable robots", scale: Scale::Log, series }
}

/// A line for each condition, of the largest team.
fn conditions(curves: &Curves, value: impl Fn(&Benchmark, usize) -> u64) -> Vec<Series> {
    let rows = curves.benchmark.chunk_by(|a, b| a.robots == b.robots).last().unwrap_or_default();
    let condition = |(number, (name, style)): (usize, (&str, usize))| Series {
        name: name.to_owned(),
        style,
        points: rows.iter().map(|it| (it.capable, value(it, number))).collect(),
    };
    let names = [
        ("cap1: together they can", 0),
        ("cap2: each role has one who can", 2),
        ("cap3: each role has one of its own", 1),
    ];
    names.into_iter().enumerate().map(condition).collect()
}

fn pay_off(curves: &Curves) -> Chart<'static> {
    let value =
        |it: &Benchmark, number: usize| it.pay_offs()[number].steps * 1_000 / it.all.steps.max(1);
    let series = conditions(curves, value);
    let title = "(3.16): steps with a condition first, over those without";
    let unit = "of the largest team; below 1 it pays";
    Chart { title, unit, along: "capable robots", scale: Scale::Linear, series }
}

fn passed(curves: &Curves) -> Chart<'static> {
    let value = |it: &Benchmark, number: usize| it.share_permille(it.pay_offs()[number].passed);
    let series = conditions(curves, value);
    let title = "(3.17): share of coalitions that meet a condition";
    let unit = "of the largest team";
    Chart { title, unit, along: "capable robots", scale: Scale::Linear, series }
}

//! The run of a team as one page: who did what when, what went wrong, what was said.

use crate::axis::{Layout, NARROW, WIDE, draw_tick_labels, tick_label, ticks};
use crate::format::{clock, count, grouped, percent, seconds};
use crate::frame;
use crate::svg::{Svg, fitted, fixed, text_width};
use cotama_core::text::markup;
use cotama_models::team::ErrorClass;
use cotama_sim::fleet::Kind;
use cotama_sim::fleet::record::{Fate, Record};
use cotama_sim::fleet::trace::Trace;
use std::fmt::Write;

mod bars;
mod floor;
mod items;
mod tracks;

use bars::{Bar, bars};

/// The most rows of a list.
const MOST_ROWS: usize = 400;
/// The most bars that are listed.
const MOST_BARS: usize = 2_000;
/// More robots than these have thinner lanes.
const FEW: usize = 12;

/// The legend of the colours, in the order of the key: a class, and words.
const COLOURS: [(&str, &str); 5] = [
    ("f6", "drives to where something is taken"),
    ("f5", "takes or gives"),
    ("f2", "waits for its partner"),
    ("f0", "drives to where it is given"),
    ("gone", "out of work"),
];

/// Writes the report of a run as an HTML page, which needs nothing else and suits wide and narrow
/// screens, light and dark ones, and paper.
///
/// ```
/// use cotama_sim::fleet::{scenarios::{ServiceOptions, service}, trace::Trace};
/// use cotama_pages::team;
/// let options = ServiceOptions { disturbances: true, ..ServiceOptions::default() };
/// let page = team::html(&Trace::of(&service(&options)));
/// assert!(page.contains("All 2 tasks are done"));
/// ```
pub fn html(trace: &Trace) -> String {
    let mut page = String::new();
    head(&mut page, trace);
    let end_ms = trace.run().end_ms.max(1);
    let all: Vec<Vec<Bar>> =
        (0..trace.header.robots.len()).map(|robot| bars(trace, robot, end_ms)).collect();
    let on_floor = floor::section(trace, &all);
    page.push_str(&on_floor);
    gantt(&mut page, trace, &all, !on_floor.is_empty());
    wrong(&mut page, trace);
    skills(&mut page, trace);
    auctions(&mut page, trace);
    messages(&mut page, trace);
    footer(&mut page, trace);
    frame::page(&format!("{}: team report", trace.header.scenario), &[], &page)
}

fn head(page: &mut String, trace: &Trace) {
    let run = trace.run();
    let [done, reported] = [Fate::Done, Fate::Reported].map(|it| run.count(it));
    let all = run.fates.len();
    let (class, shape, sentence) = if done == all {
        let sentence = match all {
            1 => "The task is done".to_owned(),
            all => format!("All {all} tasks are done"),
        };
        ("completed", "M9 17l5 5 9-12", sentence)
    } else {
        let sentence = format!("{done} of {all} tasks are done, {reported} reported");
        ("safe", "M16 8v10M16 22.5v.5", sentence)
    };
    let title = match trace.header.scenario.as_str() {
        "service" => "The drink service",
        "fleet" => "The fleet",
        other => other,
    };
    let _ = write!(
        page,
        "<header><p class=\"kicker\">Report of a simulated team</p>\n<h1>{}</h1>\n\
         <div class=\"outcome {class}\"><svg viewBox=\"0 0 32 32\" aria-hidden=\"true\">\
         <circle cx=\"16\" cy=\"16\" r=\"15\"/><path d=\"{shape}\"/></svg>\
         <p><strong>{sentence}</strong><span>{}, put up again {} times; {} of {} robots are out of \
         work at the end.</span></p></div>\n<dl class=\"facts\">\n",
        markup(title),
        count(u64::from(run.awards.iter().sum::<u32>()), "award"),
        run.reopened,
        run.out,
        trace.header.robots.len()
    );
    let sent = run.messages.iter().sum::<u64>() + run.copies;
    let mean = run.waited_ms / (done as u64).max(1);
    let facts = [
        ("Time", clock(run.end_ms)),
        ("A task takes, on average", clock(mean)),
        ("Robots worked", clock(run.busy_ms)),
        ("Energy", format!("{}.{} kJ", run.energy_mj / 1_000_000, run.energy_mj / 100_000 % 10)),
        ("Auctions", grouped(u128::from(run.rounds))),
        ("Messages", grouped(u128::from(sent))),
        ("Of these lost", format!("{} %", percent(run.lost, sent))),
    ];
    for (name, value) in facts {
        let _ = writeln!(page, "<div><dt>{name}</dt><dd>{value}</dd></div>");
    }
    page.push_str("</dl>\n</header>\n");
}

/// The lanes of all robots over time, with their key.
fn gantt(page: &mut String, trace: &Trace, all: &[Vec<Bar>], has_cursor: bool) {
    page.push_str(
        "<section><h2>Who did what, when</h2>\n<p class=\"note\">A lane is a robot; where it rests \
         there is no bar. The table below the drawing lists all bars.</p>\n<figure>\n",
    );
    page.push_str(&lanes(trace, all, WIDE, has_cursor));
    page.push_str(&lanes(trace, all, NARROW, has_cursor));
    page.push_str("<figcaption class=\"keys\">");
    let own = [("f1", "drives home"), ("f3", "is charged")];
    let own = own.into_iter().filter(|it| all.iter().flatten().any(|bar| bar.class == it.0));
    for (class, words) in COLOURS.into_iter().chain(own) {
        let _ =
            write!(page, "<span class=\"key\"><i class=\"swatch tint {class}\"></i>{words}</span>");
    }
    page.push_str(
        "<span class=\"key\"><svg class=\"glyph\" viewBox=\"-7 -7 14 14\">\
         <path class=\"mark fault\" d=\"M-4-4l8 8M4-4l-8 8\"/></svg>a failure</span>\
         <span class=\"key\"><svg class=\"glyph\" viewBox=\"-7 -7 14 14\">\
         <circle class=\"open\" r=\"4\"/></svg>a task given back</span>\
         <span class=\"key\"><svg class=\"glyph\" viewBox=\"-7 -7 14 14\">\
         <circle class=\"after\" r=\"4\"/></svg>an error that is dealt with</span>\
         </figcaption></figure>\n",
    );
    list(page, trace, all);
    page.push_str("</section>\n");
}

/// All bars as a table, which fingers and keys reach as well.
fn list(page: &mut String, trace: &Trace, all: &[Vec<Bar>]) {
    let bars = all.iter().flatten().count();
    let _ = write!(
        page,
        "<details><summary>{} as a table</summary>\n<div class=\"scroll\"><table><thead><tr>\
         <th>Robot</th><th class=\"n\">From</th><th class=\"n\">To</th><th>Does</th>\
         <th>Task</th></tr></thead>\n<tbody>\n",
        count(bars as u64, "bar")
    );
    let rows =
        all.iter().enumerate().flat_map(|(robot, bars)| bars.iter().map(move |it| (robot, it)));
    for (robot, it) in rows.take(MOST_BARS) {
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td>\
             <td>{}</td></tr>",
            markup(trace.robot(robot)),
            seconds(it.from),
            seconds(it.to),
            it.does,
            markup(if it.label.is_empty() { "–" } else { &it.label })
        );
    }
    page.push_str("</tbody></table></div>\n");
    if bars > MOST_BARS {
        let more = bars - MOST_BARS;
        let _ = writeln!(page, "<p class=\"note\">and {more} more; the trace has them all</p>");
    }
    page.push_str("</details>\n");
}

fn lanes(trace: &Trace, all: &[Vec<Bar>], layout: Layout, has_cursor: bool) -> String {
    let robots = trace.header.robots.len();
    let (height, bar) = if robots > FEW { (14.0, 10.0) } else { (28.0, 20.0) };
    let names: Vec<String> = trace.header.robots.iter().map(|it| fitted(it, 11.0, 110.0)).collect();
    let layout = Layout { left: if layout.names_beside { 58.0 } else { layout.left }, ..layout };
    let layout = layout.with_room(&names, false);
    let left = layout.left;
    let end_ms = trace.run().end_ms.max(1);
    let at = |t_ms: u64| {
        let share = t_ms.min(end_ms) as f64 / end_ms as f64;
        left + share * (layout.end() - left)
    };
    let mut svg = Svg::new();
    let bottom = 8.0 + robots as f64 * height;
    let (numbers, step) = ticks(0, i128::from(end_ms), layout.x_ticks);
    let mut labels = Vec::new();
    for number in numbers {
        let x = at(u64::try_from(number).unwrap_or(0));
        svg.line("grid", [x, 4.0], [x, bottom]);
        labels.push((x, tick_label(number, step)));
    }
    draw_tick_labels(&mut svg, layout, labels, " s", bottom + 16.0);
    svg.line("axis", [left, bottom], [layout.end(), bottom]);
    for (robot, name) in names.iter().enumerate() {
        let y = 8.0 + robot as f64 * height;
        svg.text("small muted", [0.0, y + bar / 2.0 + 4.0], name);
        for it in &all[robot] {
            let (from, to) = (at(it.from), at(it.to));
            svg.titled(&it.title, |svg| {
                svg.rect(&format!("tint {}", it.class), [from, y], [to - from, bar]);
            });
            if robots <= FEW && text_width(&it.label, 11.0) < to - from - 6.0 {
                svg.text("small", [from + 3.0, y + bar / 2.0 + 4.0], &it.label);
            }
        }
        marks(&mut svg, trace, robot, &at, y + bar / 2.0);
    }
    if has_cursor {
        svg.cursor([left, layout.end()], [4.0, bottom]);
    }
    let label = "What each robot did over time";
    svg.finish(layout.class, [layout.width, bottom + 22.0], label)
}

/// Failures and errors of a robot.
fn marks(svg: &mut Svg, trace: &Trace, robot: usize, at: &dyn Fn(u64) -> f64, y: f64) {
    for record in &trace.records {
        match record {
            Record::Fails { t_ms, robot: of, mode } if *of == robot => {
                let x = at(*t_ms);
                let who = trace.robot(robot);
                let title = format!("{who}: {mode} at {}", seconds(*t_ms));
                let (left, top) = (fixed(x - 4.0), fixed(y - 4.0));
                svg.titled(&title, |svg| {
                    svg.path("mark fault", &format!("M{left} {top}l8 8m0-8l-8 8"));
                });
            }
            Record::Error { t_ms, robot: of, task, class, why } if *of == robot => {
                let dealt = *class == ErrorClass::Recoverable;
                let title = format!("{}, {}: {why}", trace.task(*task), class.name());
                let place = [at(*t_ms), y];
                let class = if dealt { "after" } else { "open" };
                svg.titled(&title, |svg| svg.circle(class, place, 3.5));
            }
            _ => {}
        }
    }
}

/// Failures, errors, silence, and what became of the tasks.
fn wrong(page: &mut String, trace: &Trace) {
    let (words, mut rows) = (trace.words(), Vec::new());
    for record in &trace.records {
        let row = match record {
            Record::Fails { t_ms, robot, mode } => {
                let what = format!("fails: {}", words(*robot, mode));
                (*t_ms, trace.robot(*robot), String::new(), what)
            }
            Record::Shifted { t_ms, task } => {
                (*t_ms, "", trace.task(*task).to_owned(), "its object is shifted".to_owned())
            }
            Record::Turned { t_ms, task } => {
                (*t_ms, "", trace.task(*task).to_owned(), "its object is turned".to_owned())
            }
            Record::Found { t_ms, robot, mode } => {
                (*t_ms, trace.robot(*robot), String::new(), format!("finds {mode}"))
            }
            Record::Error { t_ms, robot, task, class, why } => {
                let what = format!("{}: {why}", class.name());
                (*t_ms, trace.robot(*robot), trace.task(*task).to_owned(), what)
            }
            Record::Failed { t_ms, robot, task, skill, number, reliability } => {
                let what = format!(
                    "{skill} fails at use {number}; it is taken to work {} of the time from now on",
                    share(*reliability)
                );
                (*t_ms, trace.robot(*robot), trace.task(*task).to_owned(), what)
            }
            Record::Silent { t_ms, robot, task } => {
                let what = "is silent; the award has run out".to_owned();
                (*t_ms, trace.robot(*robot), trace.task(*task).to_owned(), what)
            }
            Record::Reopened { t_ms, task } => {
                (*t_ms, "", trace.task(*task).to_owned(), "is put up again".to_owned())
            }
            Record::Empty { t_ms, robot } => {
                (*t_ms, trace.robot(*robot), String::new(), "its battery is empty".to_owned())
            }
            Record::TakesOver { t_ms, robot, copied } => {
                let what = if *copied {
                    "gives tasks out from now on, with what was copied to it"
                } else {
                    "gives tasks out from now on, without a copy"
                };
                (*t_ms, trace.robot(*robot), String::new(), what.to_owned())
            }
            Record::Reported { t_ms, task, why } => {
                (*t_ms, "", trace.task(*task).to_owned(), format!("is reported: {why}"))
            }
            _ => continue,
        };
        rows.push(row);
    }
    page.push_str("<section><h2>What went wrong</h2>\n");
    if rows.is_empty() {
        page.push_str("<p>Nothing.</p></section>\n");
        return;
    }
    page.push_str(
        "<div class=\"scroll\"><table><thead><tr><th class=\"n\">Time</th><th>Robot</th>\
         <th>Task</th><th>What</th></tr></thead>\n<tbody>\n",
    );
    for (t_ms, robot, task, what) in rows.iter().take(MOST_ROWS) {
        let _ = writeln!(
            page,
            "<tr><td class=\"n\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            seconds(*t_ms),
            markup(robot),
            markup(task),
            markup(what)
        );
    }
    page.push_str("</tbody></table></div>\n");
    cut(page, rows.len());
    page.push_str("</section>\n");
}

/// Skills that may fail or are counted, as their robots have come to know them.
fn skills(page: &mut String, trace: &Trace) {
    let skills = &trace.run().skills;
    if skills.is_empty() {
        return;
    }
    page.push_str(
        "<section><h2>Skills</h2>\n<p class=\"note\">A use counts for the skill that decided it. \
         What the robot has seen of it is what its bids count with.</p>\n\
         <div class=\"scroll\"><table><thead><tr><th>Robot</th><th>Skill</th>\
         <th class=\"n\">Uses</th><th class=\"n\">Failed</th>\
         <th class=\"n\">Taken to work</th></tr></thead>\n<tbody>\n",
    );
    for it in skills.iter().take(MOST_ROWS) {
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{}</td></tr>",
            markup(trace.robot(it.robot)),
            markup(&it.skill),
            it.uses,
            it.failed,
            share(it.reliability)
        );
    }
    page.push_str("</tbody></table></div>\n");
    cut(page, skills.len());
    page.push_str("</section>\n");
}

/// Parts per 10⁹ in percent, rounded down.
fn share(parts: u32) -> String {
    let permille = parts / 1_000_000;
    format!("{}.{} %", permille / 10, permille % 10)
}

fn cut(page: &mut String, rows: usize) {
    if rows > MOST_ROWS {
        let more = rows - MOST_ROWS;
        let _ = writeln!(page, "<p class=\"note\">and {more} more; the trace has them all</p>");
    }
}

/// Writes the awards.
fn auctions(page: &mut String, trace: &Trace) {
    let mut rows = 0;
    let mut table = String::new();
    for record in &trace.records {
        let Record::Awarded { t_ms, task, round, plan, robots, costs_ms, pledges_ms, success } =
            record
        else {
            continue;
        };
        rows += 1;
        if rows > MOST_ROWS {
            continue;
        }
        let robots: Vec<&str> = robots.iter().map(|it| trace.robot(*it)).collect();
        let cost = |(at, it): (usize, &u32)| match success.get(at) {
            Some(works) => format!("{}, works {}", seconds(u64::from(*it)), share(*works)),
            None => seconds(u64::from(*it)),
        };
        let costs: Vec<String> = costs_ms.iter().enumerate().map(cost).collect();
        let _ = writeln!(
            table,
            "<tr><td class=\"n\">{}</td><td class=\"n\">{round}</td><td>{}</td><td>{}</td>\
             <td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
            seconds(*t_ms),
            markup(trace.task(*task)),
            markup(plan),
            markup(&robots.join(", ")),
            costs.join(" + "),
            pledges_ms.first().map_or(String::new(), |it| seconds(*it))
        );
    }
    let open = if rows <= 20 { " open" } else { "" };
    let _ = write!(
        page,
        "<section><h2>Awards</h2>\n<p class=\"note\">What a robot asks is the time it would take. \
         Who would come to need more than was pledged gives the task back.</p>\n\
         <details{open}><summary>{}</summary>\n<div class=\"scroll\"><table><thead><tr>\
         <th class=\"n\">Time</th><th class=\"n\">Round</th><th>Task</th><th>Plan</th>\
         <th>Robots</th><th class=\"n\">Asked</th><th class=\"n\">Pledged</th></tr></thead>\n\
         <tbody>\n{table}</tbody></table></div>\n",
        count(rows as u64, "award")
    );
    cut(page, rows);
    page.push_str("</details></section>\n");
}

/// How much was said.
fn messages(page: &mut String, trace: &Trace) {
    page.push_str(
        "<section><h2>Messages</h2>\n<div class=\"scroll\"><table><thead><tr><th>Kind</th>\
         <th class=\"n\">Sent</th></tr></thead>\n<tbody>\n",
    );
    let copies = &[Kind::Copy][..usize::from(trace.run().copies > 0)];
    for &kind in Kind::ALL.iter().chain(copies) {
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td class=\"n\">{}</td></tr>",
            kind.name(),
            grouped(u128::from(trace.run().sent(kind)))
        );
    }
    page.push_str("</tbody></table></div></section>\n");
}

fn footer(page: &mut String, trace: &Trace) {
    let header = &trace.header;
    let loss = format!("{}.{} %", header.loss_permille / 10, header.loss_permille % 10);
    let rows = [
        ("Program", format!("cotama {}", header.version)),
        ("Scenario", header.scenario.clone()),
        ("Seed", header.seed.to_string()),
        ("Robots", header.robots.len().to_string()),
        ("Tasks", header.tasks.len().to_string()),
        ("Messages lost", loss),
        ("Allocation", header.allocation.clone()),
    ];
    page.push_str("<footer><h2>How it was run</h2>\n<dl>\n");
    for (name, value) in rows {
        let _ = writeln!(page, "<div><dt>{name}</dt><dd>{}</dd></div>", markup(&value));
    }
    page.push_str("</dl>\n</footer>\n");
}

//! Decisions with their reasons, and how far up each reaction went.

use super::MAX_POINTS;
use super::events::capital;
use super::view::View;
use crate::format::{metres, moment, seconds};
use cotama_core::text::markup;
use cotama_sim::story::{Chain, Point, Rung, What};
use cotama_sim::trace::supervised::Fired;
use std::fmt::Write;

/// The table of decisions and the ladder.
pub(super) fn section(view: &View<'_>) -> String {
    let mut html =
        String::from("<section class=\"decisions\"><h2>What was decided, and why</h2>\n");
    html.push_str(
        "<p class=\"note\">From flags to a diagnosis, from its report to a class by severity and \
         one by what is still available; the worse class wins, and its event goes to a supervisor. \
         Times are since the failure.</p>\n\
         <div class=\"scroll\"><table><thead><tr><th></th><th>Flags</th><th>Diagnosis</th>\
         <th>Report</th>\
         <th>By severity</th><th>By availability</th><th>Event</th><th>Reaction</th>\
         <th class=\"n\">Exposed</th></tr></thead>\n",
    );
    let points = &view.points[..view.points.len().min(MAX_POINTS)];
    for point in points {
        row(&mut html, point);
    }
    html.push_str("</table></div>\n");
    cut(&mut html, view);
    ladder(&mut html, points);
    html.push_str("</section>\n");
    html
}

fn cut(html: &mut String, view: &View<'_>) {
    let hidden = view.points.len().saturating_sub(MAX_POINTS);
    if hidden > 0 {
        let _ = writeln!(html, "<p class=\"note\">{hidden} further points are in the trace.</p>");
    }
}

/// A point: what happened in a line of its own, and below it the chain.
fn row(html: &mut String, point: &Point<'_>) {
    let _ = write!(
        html,
        "<tbody><tr class=\"point\"><th><b class=\"pin point\">{}</b></th><td colspan=\"8\"><b>{}\
         </b> <span class=\"where\">at {}, {}",
        point.number,
        markup(&capital(&point.title())),
        metres(point.x_mm),
        moment(point.t_us)
    );
    let Some(chain) = point.chain() else {
        let done = point.done().map_or_else(String::new, |it| format!(": {it}"));
        let _ = writeln!(html, "{}</span></td></tr></tbody>", markup(&done));
        return;
    };
    html.push_str("</span></td></tr>\n<tr><td></td>");
    let since = |t_us: u64| seconds(t_us.saturating_sub(point.t_us) / 1000);
    match chain.diagnosis {
        None => html.push_str("<td colspan=\"5\" class=\"muted\">no flag: nobody noticed it</td>"),
        Some(it) => {
            let candidates = match &it.candidates[..] {
                [] => "unexplained".into(),
                several => several.join(" or "),
            };
            let _ = write!(
                html,
                "<td>{} <small>{}</small></td><td>{}</td><td>{}</td><td>{} → {}</td><td>{}</td>",
                markup(&it.flags.join(", ")),
                since(it.t_us),
                markup(&candidates),
                markup(it.report.as_deref().unwrap_or("–")),
                it.severity.name(),
                it.by_severity.name(),
                it.by_availability.name()
            );
        }
    }
    event(html, chain, &since);
    let exposed = if chain.exposed_ms == 0 { "–".into() } else { seconds(chain.exposed_ms) };
    let _ = writeln!(html, "<td class=\"n\">{exposed}</td></tr></tbody>");
}

/// The decision's event, and the reaction to it.
fn event(html: &mut String, chain: &Chain<'_>, since: &impl Fn(u64) -> String) {
    match chain.decision {
        None => html.push_str("<td class=\"muted\">none</td>"),
        Some(it) => {
            let by = it.transition.as_ref().map_or_else(String::new, |by| format!(", {by}"));
            let event = it.event.as_deref().unwrap_or(it.decision.name());
            let (event, by, since) = (markup(event), markup(&by), since(it.t_us));
            let _ = write!(html, "<td><b>{event}</b> <small>{since}{by}</small></td>");
        }
    }
    // A setting is made by the observation module, which no reaction lists.
    let set = chain.set.filter(|_| chain.reaction.is_empty());
    let Some(first) = chain.reaction.first().copied().or(set) else {
        html.push_str("<td class=\"muted\">none</td>");
        return;
    };
    let line = |it: &'_ Fired| {
        let sets = it.sets.as_ref().filter(|_| set.is_some());
        sets.map_or_else(|| format!("{} {}", it.net, it.line()), Clone::clone)
    };
    let fired: Vec<_> = chain.reaction.iter().copied().chain(set).map(line).collect();
    let _ =
        write!(html, "<td>{} <small>{}</small></td>", markup(&fired.join(", ")), since(first.t_us));
}

/// How far up each reaction went, the mission above and a parameter below.
fn ladder(html: &mut String, points: &[Point<'_>]) {
    html.push_str(
        "<h2>The ladder</h2>\n<p class=\"note\">A reaction starts as low as it can. Parameters, \
         sets of modules, activities and the mission: Durand et al. 2010; planning the rest of the \
         objectives again: Lambert et al. 2024.</p>\n\
         <div class=\"scroll\"><table class=\"ladder\"><thead><tr><th></th>",
    );
    for point in points {
        let _ = write!(html, "<th><b class=\"pin point\">{}</b></th>", point.number);
    }
    html.push_str("</tr></thead><tbody>\n");
    for rung in Rung::ALL.into_iter().rev() {
        let _ = write!(html, "<tr><th>{}</th>", capital(rung.name()));
        for point in points {
            if point.rungs().contains(&rung) {
                let _ = write!(
                    html,
                    "<td class=\"step {}\">{}</td>",
                    rung.name(),
                    markup(&step(point, rung))
                );
            } else {
                html.push_str("<td></td>");
            }
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>\n");
}

/// A step of the ladder in few words.
fn step(point: &Point<'_>, rung: Rung) -> String {
    let runs = point.configured.and_then(|it| it.configuration.clone()).unwrap_or_default();
    let set = point.chain().and_then(|it| it.set).and_then(|it| it.sets.clone());
    match (rung, &point.what) {
        (Rung::Parameter, _) => set.unwrap_or_else(|| "a setting".to_owned()),
        (Rung::Set, _) => runs,
        (Rung::Activity, What::Operator(_)) => format!("operator: {runs}"),
        (Rung::Activity, _) => "operator asked".into(),
        (Rung::Objective, _) => "planned again".into(),
        (Rung::Mission, _) => "ended safely".into(),
    }
}

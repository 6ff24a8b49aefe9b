//! The abbreviations on the page, with their meanings.

use cotama_core::text::markup;
use cotama_models::robots::Robot;
use std::collections::HashSet;
use std::fmt::Write;

/// Abbreviations that are no module's name; failure modes stand in the table.
const WORDS: [(&str, &str); 13] = [
    ("FMECA", "failure modes, effects and criticality analysis"),
    ("MTBF", "mean time between failures"),
    ("RPN", "risk priority number: severity × occurrence × detection"),
    ("AP", "Action Priority: high, medium or low, after the AIAG & VDA FMEA Handbook of 2019"),
    ("COTAMA", "contextual task management: the control architecture of Durand et al., TAROS 2010"),
    ("TAROS", "the conference Towards Autonomous Robotic Systems"),
    ("VI", "a section of the paper on COTAMA"),
    ("CS", "the contextual supervisor: who must react"),
    ("CPU", "the processor of the laptop"),
    ("NaN", "a value that is not a number"),
    ("PRM", "probabilistic roadmap, a method of path planning"),
    ("USB", "universal serial bus, the cable to a device"),
    ("WiFi", "the wireless network"),
];

/// How many of them a file of rows may use; the others are of robots.
const COMMON: usize = 4;

/// The section of the page; `page` is what stands before it.
pub(super) fn section(page: &str, robot: Option<&Robot>) -> String {
    let texts = page.split('<').filter_map(|it| it.split_once('>')).map(|it| it.1);
    let words: HashSet<&str> =
        texts.flat_map(|it| it.split(|it: char| !(it.is_alphanumeric() || it == '-'))).collect();
    let modules = robot.into_iter().flat_map(|it| &it.modules);
    let modules = modules.map(|it| (it.name.as_str(), it.title.as_str()));
    let observers = robot.into_iter().flat_map(|it| &it.observers);
    let observers = observers.map(|it| (it.name.as_str(), it.title.as_str()));
    let mut html = String::from(
        "<section id=\"abbreviations\">\n<h2>Abbreviations on this page</h2>\n<p class=\"note\">\
         Ids of failure modes lead to their rows.</p>\n<dl>\n",
    );
    let own = robot.map_or(COMMON, |_| WORDS.len());
    let known = WORDS.into_iter().take(own).chain(modules).chain(observers);
    for (name, meaning) in known.filter(|it| words.contains(it.0)) {
        let meaning = markup(meaning.trim().trim_end_matches('.'));
        let _ = writeln!(html, "<div><dt>{name}</dt><dd>{meaning}</dd></div>");
    }
    html.push_str("</dl>\n</section>\n");
    html
}

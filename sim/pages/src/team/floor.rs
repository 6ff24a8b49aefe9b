//! The team on its floor: robots as discs with letters, tasks as squares at their places, and a
//! slider that moves all of it through time.

use super::bars::Bar;
use super::items::{self, Change, State};
use super::tracks::{self, Moment};
use crate::player::Player;
use crate::svg::fixed;
use cotama_core::text::markup;
use cotama_floor::picture::{self, Pixels};
use cotama_floor::{Floor, Grid, metres};
use cotama_models::team::scenario::{Place, Scenario, Spot};
use cotama_sim::fleet::trace::Trace;
use std::fmt::Write;

/// The least radius of a disc with a letter, and that of the robots of the teams, in metres.
const LEAST: f64 = 9.0;
const RADIUS_M: f64 = 0.26;
/// The side of the square of a task, in pixels, and of one with a number.
const SIDES: [f64; 2] = [8.0, 13.0];
/// So many tasks have numbers and a list.
const FEW: usize = 26;
/// A run plays within so many seconds, but no slower than it was.
const SECONDS: u64 = 90;

/// Returns short names of robots, each another one: first letters, or what comes after letters that
/// all begin with, or numbers.
pub(super) fn letters(names: &[String]) -> Vec<String> {
    let differ = |all: &[String]| {
        let mut sorted = all.to_vec();
        sorted.sort();
        sorted.dedup();
        sorted.len() == all.len() && all.iter().all(|it| (1..=3).contains(&it.chars().count()))
    };
    let first =
        |it: &String| it.chars().next().map_or(String::new(), |it| it.to_uppercase().collect());
    let initials: Vec<String> = names.iter().map(first).collect();
    if differ(&initials) {
        return initials;
    }
    let head: String = names.first().cloned().unwrap_or_default();
    let head = head.trim_end_matches(|it: char| it.is_ascii_digit());
    let rest =
        |it: &String| it.strip_prefix(head).unwrap_or_default().trim_start_matches('0').to_owned();
    let rests: Vec<String> = names.iter().map(rest).collect();
    if differ(&rests) {
        return rests;
    }
    (1..=names.len()).map(|it| it.to_string()).collect()
}

/// The section; nothing for a team without a floor.
pub(super) fn section(trace: &Trace, bars: &[Vec<Bar>]) -> String {
    let (Some(text), Ok(scenario)) = (&trace.header.floor, trace.scenario()) else {
        return String::new();
    };
    let letters = letters(&trace.header.robots);
    let mut data = String::new();
    let over = |pixels: &Pixels| {
        let all = Drawn::new(trace, &scenario, pixels);
        data = all.data(trace, bars);
        all.over(trace, &scenario, &letters)
    };
    let (floor, grid) = (Floor::parse(&text.source, &text.text).ok(), Grid::parse(&text.text));
    let (title, drawn) = match (&floor, &grid) {
        (Some(it), _) => (it.title.as_str(), picture::floor_under(it, None, over)),
        (None, Some(it)) => {
            let name = text.source.rsplit('/').next().unwrap_or_default();
            (name, picture::grid_under(name, it, None, over))
        }
        (None, None) => return String::new(),
    };
    let title = if title.is_empty() { "The floor of the team" } else { title };
    let note = format!(
        "{title}. The slider moves the team through the run, and the cursor of the lanes below; \
         arrow keys move it by a second, with Shift by ten, the space bar plays. Robots that stand \
         at the same spot are drawn beside each other."
    );
    let end_ms = trace.run().end_ms;
    let player = Player {
        class: "onfloor team",
        note: &note,
        drawn: &drawn,
        below: &lists(trace, &letters),
        end_ms,
        speed: (end_ms / 1_000 / SECONDS).max(1),
        data: &data,
        script: include_str!("floor.js"),
    };
    player.section()
}

/// All that moves, in pixels.
struct Drawn {
    robots: Vec<Vec<Moment>>,
    tasks: Vec<Vec<Change>>,
    ways: Vec<Vec<[f64; 2]>>,
    side: f64,
    radius: f64,
}

impl Drawn {
    fn new(trace: &Trace, scenario: &Scenario, pixels: &Pixels) -> Self {
        let (floor, records) = (&scenario.floor, &trace.records);
        let robots = 0..scenario.robots.len();
        let robots: Vec<_> =
            robots.map(|it| tracks::track(scenario, records, it, pixels)).collect();
        let at = |place: Place| tracks::pixels_of(floor, Spot::at(place), pixels);
        let side = SIDES[usize::from(scenario.tasks.len() <= FEW)];
        let tasks = items::changes(scenario, records, side, &at, &robots);
        let way = |(a, b, _): (usize, usize, u64)| {
            let [from, to] = [a, b].map(|it| Spot::at(Place(it)));
            floor.course(from, to).into_iter().map(|it| pixels.at(metres(it.1))).collect()
        };
        let ways = floor.ways().map(way).collect();
        Self { robots, tasks, ways, side, radius: LEAST.max(RADIUS_M * pixels.scale) }
    }

    /// Draws all that lies over the floor: ways, robots at their start, tasks where they are at
    /// first.
    fn over(&self, trace: &Trace, scenario: &Scenario, letters: &[String]) -> String {
        let mut over = String::from("<g class=\"ways\">");
        for way in &self.ways {
            let points: Vec<_> = way.iter().map(|it| it.map(fixed).join(",")).collect();
            let _ = write!(over, "<polyline points=\"{}\"/>", points.join(" "));
        }
        over.push_str("</g><g class=\"bots\">");
        for ((track, name), letter) in self.robots.iter().zip(&trace.header.robots).zip(letters) {
            let [x, y] = track.first().map_or([0.0; 2], |it| it.1).map(fixed);
            let _ = write!(
                over,
                "<g class=\"bot\" transform=\"translate({x} {y})\"><title>{}</title><circle \
                 r=\"{}\"/><text dy=\"3.9\">{}</text></g>",
                markup(name),
                fixed(self.radius),
                markup(letter)
            );
        }
        over.push_str("</g><g class=\"items\">");
        let few = self.tasks.len() <= FEW;
        let [corner, side] = [-self.side / 2.0, self.side].map(fixed);
        for (number, (task, changes)) in scenario.tasks.iter().zip(&self.tasks).enumerate() {
            let [x, y] = changes.first().map_or([0.0; 2], |it| it.at).map(fixed);
            let _ = write!(
                over,
                "<g class=\"item\" transform=\"translate({x} {y})\"><title>{}</title><rect \
                 x=\"{corner}\" y=\"{corner}\" width=\"{side}\" height=\"{side}\" rx=\"1.5\"/>",
                markup(&task.name)
            );
            if few {
                let _ = write!(over, "<text dy=\"3.6\">{}</text>", number + 1);
            }
            over.push_str("</g>");
        }
        over + "</g>"
    }

    /// The run as JSON: robots by time and pixels, what they do, and changes of tasks.
    fn data(&self, trace: &Trace, bars: &[Vec<Bar>]) -> String {
        let tracks: Vec<_> = self.robots.iter().map(|it| tracks::json(it)).collect();
        let does: Vec<_> = bars.iter().map(|it| doings(it)).collect();
        let change = |it: &Change| {
            let robot = match it.state {
                State::Carried(robot) => robot.to_string(),
                _ => "-1".to_owned(),
            };
            let ([x, y], team) = (it.at.map(fixed), it.robots.iter());
            let team: Vec<_> = team.map(|it| quoted(trace.robot(*it))).collect();
            let (class, t_ms) = (it.state.class(), it.t_ms);
            format!("[{t_ms},\"{class}\",{robot},{x},{y},[{}]]", team.join(","))
        };
        let task =
            |it: &Vec<Change>| format!("[{}]", it.iter().map(change).collect::<Vec<_>>().join(","));
        let tasks: Vec<_> = self.tasks.iter().map(task).collect();
        let names: Vec<_> = trace.header.tasks.iter().map(|it| quoted(it)).collect();
        format!(
            "\"robots\":[{}],\"does\":[{}],\"tasks\":[{}],\"names\":[{}],\"radius\":{}",
            tracks.join(","),
            does.join(","),
            tasks.join(","),
            names.join(","),
            fixed(self.radius)
        )
    }
}

/// Returns the doings of a robot as JSON: from when, the class of its colour, and words; nothing
/// between bars.
fn doings(bars: &[Bar]) -> String {
    let (mut rows, mut end) = (vec!["[0,\"\",\"\"]".to_owned()], 0);
    for it in bars {
        if it.from > end {
            rows.push(format!("[{end},\"\",\"\"]"));
        }
        let task = if it.label.is_empty() { String::new() } else { format!(": {}", it.label) };
        let words = quoted(&format!("{}{task}", it.does));
        rows.push(format!("[{},\"{}\",{words}]", it.from, it.class));
        end = it.to;
    }
    rows.push(format!("[{end},\"\",\"\"]"));
    format!("[{}]", rows.join(","))
}

/// A text of a script; none can end it.
fn quoted(text: &str) -> String {
    let plain = |it: char| if matches!(it, '"' | '\\' | '<') || it.is_control() { '?' } else { it };
    format!("\"{}\"", text.trim().chars().map(plain).collect::<String>())
}

/// The key, and the lists of robots and of tasks, which the script keeps up to date.
fn lists(trace: &Trace, letters: &[String]) -> String {
    let mut lists = String::from("<p class=\"keys\">");
    for (class, words) in super::COLOURS {
        let _ = write!(
            lists,
            "<span class=\"key\"><i class=\"swatch tint {class}\"></i>{words}</span>"
        );
    }
    for (class, words) in [
        ("waits", "a task that waits"),
        ("awarded", "that robots have"),
        ("done", "that is done"),
        ("reported", "that is reported"),
    ] {
        let _ = write!(
            lists,
            "<span class=\"key\"><svg class=\"glyph floor\" viewBox=\"-7 -7 14 14\"><g \
             class=\"item {class}\"><rect x=\"-5\" y=\"-5\" width=\"10\" height=\"10\" \
             rx=\"1.5\"/></g></svg>{words}</span>"
        );
    }
    lists.push_str("</p>\n<ul class=\"now robots\">");
    for (name, letter) in trace.header.robots.iter().zip(letters) {
        let _ = write!(
            lists,
            "<li><b class=\"disc\">{}</b> {} <span></span></li>",
            markup(letter),
            markup(name)
        );
    }
    lists.push_str("</ul>\n");
    if trace.header.tasks.len() <= FEW {
        lists.push_str("<ul class=\"now tasks\">");
        for (number, name) in trace.header.tasks.iter().enumerate() {
            let _ = write!(
                lists,
                "<li><b class=\"square\">{}</b> {} <span></span></li>",
                number + 1,
                markup(name)
            );
        }
        lists.push_str("</ul>\n");
    }
    lists
}

#[cfg(test)]
mod tests {
    use super::letters;

    #[test]
    fn robots_have_short_names_each_another_one() {
        let short = |names: &[&str]| {
            letters(&names.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>()).join(" ")
        };
        assert_eq!(short(&["Eddie", "Jimmy", "Poppy"]), "E J P");
        assert_eq!(short(&["r01", "r02", "r40"]), "1 2 40");
        assert_eq!(short(&["left cart", "long cart"]), "1 2");
    }
}

//! Drawings and tables of random missions: texts stand within their drawing and clear of each
//! other, whatever the mission; a column is empty in no table, and none is without a name.

use super::{delivery_under, failures, html, patrol};
use crate::format::count;
use crate::svg::text_box;
use crate::{campaign, team};
use cotama_campaign::findings::Findings;
use cotama_campaign::results::{Header, Tally};
use cotama_campaign::run::{Campaign, Settings, Shard};
use cotama_campaign::strategy::StrategyName;
use cotama_campaign::subject::{Policy, Subject};
use cotama_models::missions::{Mission, embedded};
use cotama_sim::fleet::scenarios::{FleetOptions, ServiceOptions, fleet, service};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::streams::{Stream, Streams};
use cotama_sim::trace::RecordError;
use cotama_sim::trace::Trace;
use std::fmt::Write;

/// A text of a drawing and about where it stands.
struct Text {
    words: String,
    place: [f64; 4],
}

/// The size of a drawing and its texts.
fn texts(drawing: &str) -> ([f64; 2], Vec<Text>) {
    let number = |it: &str| it.parse::<f64>().unwrap();
    let attribute = |tag: &str, name: &str| {
        let rest = tag.split_once(&format!("{name}=\"")).unwrap().1;
        rest.split_once('"').unwrap().0.to_owned()
    };
    let size: Vec<f64> = attribute(drawing, "viewBox").split(' ').skip(2).map(number).collect();
    let texts = drawing.split("<text ").skip(1).map(|it| {
        let (tag, rest) = it.split_once('>').unwrap();
        let words = rest.split_once("</text>").unwrap().0;
        let words = words.replace("&gt;", ">").replace("&lt;", "<").replace("&amp;", "&");
        let place = [number(&attribute(tag, "x")), number(&attribute(tag, "y"))];
        Text { place: text_box(&attribute(tag, "class"), place, &words), words }
    });
    ([size[0], size[1]], texts.collect())
}

/// Holds all drawings of a page against the two rules; how many texts there were.
pub(super) fn check_drawings(page: &str, of: &str) -> usize {
    let mut count = 0;
    for class in ["wide", "narrow"] {
        for drawing in page.split(&format!("<svg class=\"{class}\"")).skip(1) {
            let drawing = drawing.split_once("</svg>").unwrap().0;
            let ([width, height], texts) = texts(drawing);
            for (at, text) in texts.iter().enumerate() {
                let [left, top, right, bottom] = text.place;
                let inside = left >= -0.1 && right <= width + 0.1 && top >= -0.1;
                let inside = inside && bottom <= height + 0.1;
                assert!(inside, "{class}: {:?} at {:?}\n{of}", text.words, text.place);
                for other in &texts[..at] {
                    let [l, t, r, b] = other.place;
                    // Boxes are those of the widest font, with room for letters that hang down.
                    let apart = right <= l + 0.6 || r <= left + 0.6 || bottom <= t + 2.1;
                    let apart = apart || b <= top + 2.1;
                    assert!(
                        apart,
                        "{class}: {:?} at {:?} on {:?} at {:?}\n{of}",
                        text.words, text.place, other.words, other.place
                    );
                }
            }
            count += texts.len();
        }
    }
    count
}

/// Holds all tables of a page with a head against the rule of columns; how many cells there were.
fn check_tables(page: &str, of: &str) -> usize {
    let mut count = 0;
    for table in page.split("<table").skip(1) {
        let table = table.split_once("</table>").unwrap().0;
        let (head, body) = table.split_once("</thead>").unwrap();
        if is_grid(table) || table.contains("colspan") {
            continue;
        }
        let names: Vec<&str> = head.split("<th").skip(2).collect();
        let mut full = vec![false; names.len()];
        for row in body.split("<tr").skip(1) {
            let cells: Vec<&str> = row
                .split("<t")
                .skip(1)
                .filter(|it| it.starts_with(['d', 'h']))
                .map(|it| it.split_once('>').unwrap().1)
                .collect();
            assert_eq!(cells.len(), names.len(), "{of}: {row}");
            for (at, cell) in cells.iter().enumerate() {
                full[at] |=
                    !cell.starts_with('<') || cell.starts_with("<b") || cell.starts_with("<s");
            }
            count += cells.len();
        }
        for (at, name) in names.iter().enumerate() {
            let named = name.contains("aria-label") || !name.contains("></th>");
            // The names of rows need no heading.
            assert!(at == 0 || named, "a column without a name: {head}\n{of}");
            assert!(full[at] || count == 0, "column {at} is empty: {head}\n{of}");
        }
    }
    count
}

/// A grid of plans or of decisions: its cells are drawn, and empty ones mean something.
fn is_grid(table: &str) -> bool {
    ["matrix", "ladder", "margins"].iter().any(|it| table.starts_with(&format!(" class=\"{it}")))
}

/// A mission with objectives at both ends of its path, and what goes wrong in it.
fn mission(draw: &mut Stream) -> String {
    let mut upto = |most: u64| draw.below(most);
    let names = ["way", "unload", "inspect-the-tank", "W", "wait-for-somebody-at-the-door"];
    let length = [9_000, 40_000, 80_000, 100_000, 187_000, 2_000_000][upto(6) as usize];
    let energy = [400_000, 9_000_000, 90_000_000_000_u64][upto(3) as usize];
    let mut text = format!(
        "format = \"panorama-mission/1\"\nname = \"drawn\"\npath_length_mm = {length}\n\
         [limits]\norder = [\"duration\", \"energy\"]\nduration_ms = {}\nenergy_mj = {energy}\n\
         [robot]\nmass_g = 9000\nspeed_max_mm_s = 1200\nimpact_energy_max_mj = 4000\n\
         [motion_power]\nc0 = 4890\nc1 = 7400\nc2 = 0\n\
         [hardware.sonar]\nunits = 1\npower_mw = 610\n\
         [hardware.laser_of_the_front]\nunits = 2\npower_mw = 2200\n\
         [[tio]]\nid = \"slow\"\ntask = \"MOV\"\nneeds = {{ sonar = 1 }}\nspeed_max_mm_s = 500\n\
         quality_per_dm = 1\n\
         [[tio]]\nid = \"with-both-lasers\"\ntask = \"MOV\"\n\
         needs = {{ laser_of_the_front = 2 }}\nquality_per_dm = 3\n\
         [[tio]]\nid = \"hand-over\"\ntask = \"DLV\"\nneeds = {{}}\nduration_ms = {}\n\
         power_mw = 3000\nquality = 10\n",
        length * 3 + 60_000 + upto(900_000),
        500 + upto(40_000),
    );
    let zones = upto(6);
    for zone in 0..zones {
        let from = upto(length - 1_000);
        let to = (from + 500 + upto(length)).min(length);
        let demand = ["require_hardware = \"sonar\"", "speed_max_mm_s = 330"][upto(2) as usize];
        let name = names[upto(5) as usize];
        let _ = write!(
            text,
            "[[zone]]\nid = \"{name}-{zone}\"\nx_start_mm = {from}\nx_end_mm = {to}\n{demand}\n"
        );
    }
    let mut objective = |id: String, from: u64, to: u64, task: &str| {
        let _ = write!(
            text,
            "[[objective]]\nid = \"{id}\"\nx_start_mm = {from}\nx_end_mm = {to}\n\
             tasks = [\"{task}\"]\n"
        );
    };
    let middle = 1_000 + upto(length - 2_000);
    for number in 0..=upto(2) {
        objective(format!("{}-a{number}", names[upto(5) as usize]), 0, 0, "DLV");
    }
    objective("there".into(), 0, middle, "MOV");
    for number in 0..upto(4) {
        objective(format!("{}-b{number}", names[upto(5) as usize]), middle, middle, "DLV");
    }
    objective("on".into(), middle, length, "MOV");
    for number in 0..=upto(2) {
        objective(format!("{}-c{number}", names[upto(5) as usize]), length, length, "DLV");
    }
    text.push_str("[run]\n");
    if zones > 0 && upto(2) == 0 {
        let start = text.find("id = \"").unwrap();
        let zone = text[text.find("[[zone]]").unwrap_or(start)..].split('"').nth(1).unwrap();
        let zone = zone.to_owned();
        let _ =
            writeln!(text, "power_error_permille = {{ \"{zone}\" = {} }}", upto(200) as i64 - 101);
    }
    for _ in 0..upto(14) {
        let x = upto(length + 1);
        let event = match upto(5) {
            0 => "kind = \"fault\"\nhardware = \"laser_of_the_front\"\nunits_lost = 1".into(),
            1 => format!("kind = \"odometry\"\nextra_mm = {}", 1 + upto(3_000)),
            _ => format!("kind = \"obstacle\"\ndelay_ms = {}", 1 + upto(60_000)),
        };
        let _ = write!(text, "[[run.event]]\nx_mm = {x}\n{event}\n");
    }
    text
}

#[test]
fn texts_of_a_drawing_stand_within_it_and_clear_of_each_other_and_no_column_is_empty() {
    let mut draw = Streams::new(7).stream("pages");
    let (mut runs, mut texts, mut cells, mut skipped) = (0, 0, 0, 0);
    while runs < 300 {
        let text = mission(&mut draw);
        let mission = Mission::parse("drawn", &text).map_err(RecordError::Text);
        let recorded = mission.and_then(|it| Trace::record(&it, &Options::default()));
        let trace = match recorded {
            Ok((trace, _)) => trace,
            Err(why) => {
                skipped += 1;
                assert!(skipped < 600, "{why:?}: {text}");
                continue;
            }
        };
        runs += 1;
        let page = html(&trace);
        texts += check_drawings(&page, &text);
        cells += check_tables(&page, &text);
    }
    assert!(texts > 50_000 && cells > 30_000, "{texts} {cells} {skipped}");
}

#[test]
fn texts_of_the_shipped_runs_stand_within_their_drawings_and_no_column_is_empty() {
    let mut pages = vec![html(&patrol()), html(&delivery_under(FaultChoice::Script))];
    pages.extend(["BAT2", "SW3", "COL1"].map(|it| html(&delivery_under(failures(&[it])))));
    let disturbed = ServiceOptions { disturbances: true, ..ServiceOptions::default() };
    pages.push(team::html(&cotama_sim::fleet::trace::Trace::of(&service(&disturbed))));
    let few = FleetOptions { robots: 6, tasks: 8, failures: 2, ..FleetOptions::default() };
    for options in [few, FleetOptions::default()] {
        pages.push(team::html(&cotama_sim::fleet::trace::Trace::of(&fleet(&options))));
    }
    for (at, page) in pages.iter().enumerate() {
        assert!(check_drawings(page, &format!("page {at}")) > 20);
        assert!(check_tables(page, &format!("page {at}")) > 20);
    }
}

/// The page of a campaign of so many runs, and what failed.
fn campaign_page(
    subject: Subject<'_>,
    strategy: StrategyName,
    (runs, requirements): (u64, &[&str]),
) -> (String, Findings) {
    let requirements = requirements.iter().map(|it| it.parse().unwrap()).collect();
    let settings = Settings { runs, strategy, requirements, ..Settings::new(false) };
    let header = Header::new(("it.toml", ""), &settings, "usual", Shard::ALL);
    let campaign = Campaign::new(subject, settings).unwrap();
    let mut tally = Tally::default();
    for line in campaign.block(0) {
        tally.add(&line, &serde_json::to_string(&line).unwrap());
    }
    let found = Findings::of(&campaign.subject, &campaign.settings.requirements, &tally, 3);
    let sampling = campaign.sampling(tally.runs, false);
    let shown = campaign::Shown { planner: "a search", sampling, confidence: 0.95 };
    (campaign::html(&header, &campaign, &tally, &found, &shown), found)
}

#[test]
fn texts_of_a_campaign_stand_within_their_drawings_and_a_count_says_of_what() {
    let parsed = |name| Mission::parse(name, embedded::mission(name).unwrap().text).unwrap();
    let (patrol, delivery) = (parsed("patrol"), parsed("delivery"));
    let mut draw = Streams::new(3).stream("pages");
    let drawn = std::iter::from_fn(|| Some(mission(&mut draw)));
    let drawn: Vec<_> = drawn.filter_map(|it| Mission::parse("drawn", &it).ok()).take(12).collect();
    let of = |it| Subject::new(it, Policy::default());
    let options = FleetOptions { robots: 5, tasks: 6, failures: 0, ..FleetOptions::default() };
    let small = Subject::of_team(fleet(&options), None);
    let shipped = [
        (of(&patrol).unwrap(), StrategyName::Uniform, 400, &["completed", "energy<=8500000"][..]),
        (of(&patrol).unwrap(), StrategyName::Pairwise, 90, &["time<=0"]),
        (of(&patrol).unwrap(), StrategyName::Guided, 1, &["completed"]),
        (of(&patrol).unwrap(), StrategyName::Swarm, 100, &["completed"]),
        (of(&patrol).unwrap(), StrategyName::Uniform, 1_000, &["completed"]),
        (of(&delivery).unwrap(), StrategyName::Swarm, 60, &["requests<=0", "AG !gs.Security"]),
        (small, StrategyName::Uniform, 30, &["time<=200000", "completed"]),
    ];
    let random = drawn.iter().filter_map(|it| of(it).ok()).zip(1..).map(|(it, at)| {
        (it, StrategyName::Uniform, 7 * at * at, &["completed", "time<=100000"][..])
    });
    let (mut texts, mut causes, mut pages) = (0, 0, 0);
    for (subject, strategy, runs, requirements) in shipped.into_iter().chain(random) {
        let of = format!("{} {strategy:?} {runs}", subject.name());
        let (page, found) = campaign_page(subject, strategy, (runs, requirements));
        assert_eq!(super::ill_formed(&page), None, "{of}");
        texts += check_drawings(&page, &of);
        for it in &found.clusters {
            let runs = count(it.runs.len() as u64, "run");
            let said = format!("<span class=\"many\">{runs}</span>");
            let broken =
                format!("breaks <code>{}", it.requirement.to_string().split('<').next().unwrap());
            assert!(page.contains(&said) && page.contains(&broken), "{of}");
            causes += 1;
        }
        pages += 1;
    }
    assert!(texts > 200 && causes > 12 && pages > 10, "{texts} {causes} {pages}");
}

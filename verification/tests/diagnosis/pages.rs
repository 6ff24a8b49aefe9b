//! Pages, as far as a program can look at them.

use crate::diagnosis::{diagnosis, golden, nets, timed_diagnosis, words};
use crate::drawings::xml;
use cotama_verification::diagnosis::Diagnosis;

/// The elements of each picture, and of the page without what only HTML knows.
fn check(diagnosis: &Diagnosis) -> String {
    let page = diagnosis.html();
    let mut rest = page.as_str();
    let mut pictures = 0;
    while let Some(at) = rest.find("<svg") {
        let end = rest.find("</svg>").unwrap() + "</svg>".len();
        let elements = xml::parse(&rest[at..end]).unwrap();
        assert!(elements.iter().all(|it| it.name != "script"));
        assert!(elements[0].number("width") > 0 && elements[0].number("height") > 0);
        assert_eq!(elements[0].get("role"), Some("img"));
        (rest, pictures) = (&rest[end..], pictures + 1);
    }
    assert!(pictures > 0);
    let document = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    let elements = xml::parse(document).unwrap();
    assert_eq!(elements.iter().filter(|it| it.name == "tr").count(), diagnosis.trace.len() + 3);
    // One script of its own, which goes through the run, and nothing from elsewhere.
    assert_eq!((page.matches("<script").count(), page.matches("<script>").count()), (1, 1));
    assert!(!page.contains("http-equiv") && !page.contains("src=") && !page.contains("fetch"));
    player(diagnosis, &elements);
    page
}

/// The firing transition, its name, and the tokens of the places that it changes.
type Move = (Option<u32>, String, Vec<(u32, u32)>);

/// The slider knows the start and each step, and colours elements that are there.
fn player(diagnosis: &Diagnosis, elements: &[xml::Element]) {
    let player = elements.iter().find(|it| it.get("class") == Some("player")).unwrap();
    let plain = |name: &str| {
        let signs =
            [("&quot;", "\""), ("&#39;", "'"), ("&lt;", "<"), ("&gt;", ">"), ("&amp;", "&")];
        let text = player.get(name).unwrap().to_owned();
        signs.iter().fold(text, |text, (from, to)| text.replace(from, to))
    };
    let run: Vec<Move> = serde_json::from_str(&plain("data-run")).unwrap();
    assert_eq!(run.len(), diagnosis.trace.len() + 1);
    let slider = elements.iter().find(|it| it.get("type") == Some("range")).unwrap();
    assert_eq!(slider.number("max"), i64::try_from(diagnosis.trace.len()).unwrap());
    let tokens = |changes: &[(u32, u32)]| changes.iter().map(|it| it.1).collect::<Vec<_>>();
    let initial: Vec<u32> = diagnosis.initial.iter().map(|it| it.tokens).collect();
    assert_eq!((run[0].0, tokens(&run[0].2)), (None, initial));
    for (it, step) in run[1..].iter().zip(&diagnosis.trace) {
        assert_eq!(tokens(&it.2), step.changes.iter().map(|it| it.after).collect::<Vec<_>>());
    }
    let parts: Vec<(String, Vec<u32>)> = serde_json::from_str(&plain("data-parts")).unwrap();
    let is_there = |id: &str| elements.iter().any(|it| it.get("id") == Some(id));
    assert!(!parts.is_empty() && parts.iter().all(|it| is_there(&it.0)), "{parts:?}");
    for fired in run.iter().filter_map(|it| it.0) {
        assert!(parts.iter().any(|it| it.1.contains(&fired)), "{fired} colours nothing");
    }
}

/// The names of the places that a page shows strong.
fn strong(page: &str) -> Vec<&str> {
    let places = page.split("class=\"place hot\"><title>").skip(1);
    places.map(|it| it.split(['\n', ':', '&']).next().unwrap()).collect()
}

#[test]
fn only_the_places_that_the_step_changes_are_drawn_strong() {
    let it = diagnosis(&nets::philosophers(), "AG !deadlock");
    let page = check(&it);
    let mut changed: Vec<&str> =
        it.trace.last().unwrap().changes.iter().map(|it| it.place.as_str()).collect();
    let mut strong = strong(&page);
    changed.sort_unstable();
    strong.sort_unstable();
    assert_eq!(strong, changed);
    assert!(it.last.len() > 1 && page.contains("class=\"token\""));
}

#[test]
fn two_trains_on_a_page() {
    let it = diagnosis(&nets::trains(), "AG !(west_in_section & east_in_section)");
    golden("trains_page.txt", &words(&check(&it)));
}

#[test]
fn a_short_run_of_a_small_net_is_drawn_step_by_step() {
    for (file, it) in [
        ("trains.svg", diagnosis(&nets::trains(), "AG !(west_in_section & east_in_section)")),
        ("watchdog.svg", timed_diagnosis(&nets::watchdog(), "AG !overdue")),
        ("server.svg", diagnosis(&nets::server(), "AG (request -> AF served)")),
    ] {
        let drawing = it.svg();
        let elements = xml::parse(&drawing).unwrap();
        let frames =
            elements.iter().filter(|it| it.get("class").is_some_and(|it| it.starts_with("frame")));
        assert_eq!(frames.count(), it.trace.len() + 1, "{file}");
        let mut ids: Vec<_> = elements.iter().filter_map(|it| it.get("id")).collect();
        let count = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), count, "{file}: an identifier occurs twice");
        for step in &it.trace {
            assert!(drawing.contains(&step.transition), "{file}: {} is not named", step.transition);
        }
        if file == "watchdog.svg" {
            golden(file, &drawing);
        }
    }
}

#[test]
fn of_a_long_run_the_last_step_is_drawn_and_the_others_are_lines() {
    let it = diagnosis(&nets::philosophers(), "AG !deadlock");
    assert!(it.svg().contains("class=\"frame last\""));
    let places: Vec<(String, u32)> =
        (0..20).map(|at| (format!("stage_{at}"), u32::from(at == 0))).collect();
    let places: Vec<_> = places.iter().map(|it| (it.0.as_str(), it.1, "")).collect();
    let mut net = nets::Sketch::new("pipeline", "", &places);
    for at in 1..20 {
        net =
            net.line(&format!("advance_{at}"), &format!("stage_{} -> stage_{at}", at - 1), "", "");
    }
    let drawing = diagnosis(&net.0, "AG !stage_19").svg();
    let elements = xml::parse(&drawing).unwrap();
    let of = |class: &str| elements.iter().filter(|it| it.get("class") == Some(class)).count();
    assert_eq!((of("frame"), of("frame last"), of("mono")), (0, 1, 22));
    for at in 1..20 {
        let line = format!(" {at}  advance_{at} ").replace(' ', "\u{a0}");
        assert!(drawing.contains(&line), "{line}: {drawing}");
    }
}

#[test]
fn a_lost_timeout_on_a_page() {
    let page = check(&timed_diagnosis(&nets::watchdog(), "AG !overdue"));
    golden("watchdog_page.txt", &words(&page));
}

#[test]
fn markup_in_names_is_text() {
    let places = [("<b>&\"'`", 1, "<script>alert(1)</script>"), ("]]>\u{1}", 0, "\u{7}")];
    let net = nets::Sketch::new("<i>", "</style>", &places)
        .line("</td>", "<b>&\"'` -> ]]>\u{1}", "<e>", "<o>")
        .0;
    let it = diagnosis(&net, "AF (\"<b>&\\\"'`\" & \"]]>\\u{1}\")");
    let page = check(&it);
    assert!(xml::parse(&it.svg()).is_ok());
    assert!(!page.contains("<b>") && !page.contains("<i>") && page.contains("&lt;script&gt;"));
}

#[test]
fn json_has_the_whole_run() {
    let it = timed_diagnosis(&nets::watchdog(), "AG !overdue");
    let read: serde_json::Value = serde_json::from_str(&it.json()).unwrap();
    golden("watchdog.json", &cotama_golden::json_lines(&read));
    assert_eq!(read["holds"], false);
    assert_eq!(read["trace"][1]["transition"], "rotate");
    assert_eq!(read["trace"][1]["at_ms"], 50);
    assert_eq!(read["trace"][2]["changes"][1]["after"], 1);
    let lasso = diagnosis(&nets::server(), "AG (request -> AF served)");
    let read: serde_json::Value = serde_json::from_str(&lasso.json()).unwrap();
    assert_eq!((&read["cycle_starts_at"], &read["deadlock"]), (&1.into(), &false.into()));
}

#[test]
fn a_page_says_what_fill_colour_and_rim_mean_and_breaks_no_name_of_its_table() {
    let trains = "AG !(west_in_section & east_in_section)";
    let mut rimmed = 0;
    for it in [
        diagnosis(&nets::philosophers(), "AG !deadlock"),
        diagnosis(&nets::trains(), trains),
        timed_diagnosis(&nets::watchdog(), "AG !overdue"),
        diagnosis(&nets::server(), "AG (request -> AF served)"),
        diagnosis(&nets::server(), "EF served"),
    ] {
        let page = it.html();
        assert!(page.contains(".diagnosis table code,.diagnosis table span{white-space:nowrap}"));
        let (before, _) = page.split_once("<figure").unwrap();
        let legend = before.rsplit_once("<p class=\"net\">").unwrap().1;
        assert!(legend.starts_with("Filled, or with dots: marked."), "{legend}");
        assert_eq!(legend.contains("In colour: "), !it.trace.is_empty());
        let rims = page.contains("stroke-width:4}</style>");
        assert_eq!(legend.contains("Thick rim, "), rims, "{legend}");
        rimmed += usize::from(rims);
    }
    assert!(rimmed >= 3, "{rimmed}");
}

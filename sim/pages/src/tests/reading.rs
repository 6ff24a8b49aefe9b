//! The page for a reader: the story, the glossary, the legend, lines and texts, the narrow page.

use super::{delivery_under, failures, html, patrol};
use cotama_sim::options::FaultChoice;

/// The text of a page's body: what stands between its tags.
fn text(page: &str) -> String {
    let body = page.split_once("<body>").unwrap().1;
    body.split('<').filter_map(|it| it.split_once('>')).map(|it| it.1).collect::<Vec<_>>().join(" ")
}

/// Whether a word looks like an abbreviation: capitals and digits, as `RT1`, `PF.DEG`, `O-SEN`.
fn is_abbreviation(word: &str) -> bool {
    let capitals = word.chars().filter(char::is_ascii_uppercase).count();
    let digits = word.chars().filter(char::is_ascii_digit).count();
    let others = word
        .chars()
        .all(|it| it.is_ascii_uppercase() || it.is_ascii_digit() || matches!(it, '.' | '-'));
    let first = word.starts_with(|it: char| it.is_ascii_uppercase());
    first && others && capitals >= 1 && capitals + digits >= 2
}

#[test]
fn every_abbreviation_on_a_page_is_in_its_glossary_and_no_other() {
    for trace in [patrol(), delivery_under(FaultChoice::Script), delivery_under(failures(&["SW3"]))]
    {
        let page = html(&trace);
        let (before, rest) = page.split_once("<section class=\"glossary\">").unwrap();
        let glossary = rest.split_once("</section>").unwrap().0;
        let entries: Vec<&str> =
            glossary.split("<dt>").skip(1).map(|it| it.split_once("</dt>").unwrap().0).collect();
        let explained = |word: &str| {
            let number = |it: &str| it.trim_start_matches(|it: char| !it.is_ascii_digit()).parse();
            entries.iter().any(|it| match it.split_once(" to ") {
                Some((first, last)) => {
                    let kind = first.trim_end_matches(|it: char| it.is_ascii_digit());
                    let (first, last, it) = (number(first), number(last), number(word));
                    let among = it.is_ok_and(|it: u32| {
                        first.is_ok_and(|first| first <= it) && last.is_ok_and(|last| it <= last)
                    });
                    word.starts_with(kind) && among
                }
                None => *it == word,
            })
        };
        let text = text(&format!("<body>{}", before.split_once("<body>").unwrap().1));
        let words = text.split(|it: char| !(it.is_alphanumeric() || matches!(it, '.' | '-' | '_')));
        let mut found = 0;
        for word in words.map(|it| it.trim_matches(['.', '-'])).filter(|it| is_abbreviation(it)) {
            assert!(explained(word), "{word}");
            found += 1;
        }
        assert!(found > 20, "{found}");
        for entry in &entries {
            assert!(entry.split(" to ").all(|it| text.contains(it)), "{entry} is not on the page");
        }
    }
}

/// The story on top of a page, as text.
fn story(page: &str) -> Vec<String> {
    let story = page.split_once("<dl class=\"story\">").unwrap().1.split_once("</dl>").unwrap().0;
    let sentence =
        |it: &str| it.split_once("</dd>").unwrap().0.replace(['\u{a0}', '\u{202f}'], " ");
    story.split("<dd>").skip(1).map(sentence).collect()
}

#[test]
fn three_sentences_tell_the_story_of_the_patrol() {
    let expected = [
        "On the way, 6 obstacles took 10.5 s, 4 odometry errors took 9.9 s and 1 laser failed at \
         118.0 m.",
        "The robot planned again 3 times: at 63.4 m, as the energy margin had come below zero; at \
         118.0 m, as one laser was lost; at 170.0 m, as the energy margin had come below zero.",
        "All 17 activities are done after 548.3 s and 187.0 m; 51.7 s (8.6 %) and 26.7 J (0.3 %) \
         of the limits are left.",
    ];
    assert_eq!(story(&html(&patrol())), expected);
}

#[test]
fn three_sentences_tell_the_story_of_the_delivery() {
    let expected = [
        "4 failures on the way: at 43.0 m, RT1: MCL, deadline missed again and again; at 52.0 m, \
         LOC2: map, map wrong at this place (uncharted obstacle); at 66.0 m, SON1: sonar array, \
         one transducer stuck at maximum range; at 74.0 m, LOC3: odometry only (degraded mode), \
         drift beyond the corridor width.",
        "A setting was changed after RT1 and LOC3; the operator was asked after LOC2 and LOC3; \
         the adapter took another set of modules after SON1; the rest was planned again after \
         SON1.",
        "All 4 activities are done after 415.2 s and 80.0 m; 484.8 s (53.9 %) and 4438.7 J \
         (61.6 %) of the limits are left.",
    ];
    assert_eq!(story(&html(&delivery_under(FaultChoice::Script))), expected);
    let quiet = story(&html(&delivery_under(FaultChoice::None)));
    assert_eq!(
        quiet[..2],
        ["Nothing failed on the way.", "The supervisors had nothing to decide."]
    );
}

/// The numbers of an attribute's text.
fn numbers(text: &str) -> Vec<f64> {
    text.split(|it: char| !(it.is_ascii_digit() || matches!(it, '.' | '-')))
        .filter_map(|it| it.parse().ok())
        .collect()
}

#[test]
fn no_line_of_a_replan_or_of_a_point_crosses_a_text() {
    for trace in [patrol(), delivery_under(FaultChoice::Script)] {
        let page = html(&trace);
        let mut lines = 0;
        for drawing in page.split("<svg class=\"").skip(1) {
            let drawing = drawing.split_once("</svg>").unwrap().0;
            let texts: Vec<[f64; 4]> = drawing
                .split("<text class=\"")
                .skip(1)
                .map(|it| {
                    let (class, rest) = it.split_once('"').unwrap();
                    let (place, rest) = rest.split_once('>').unwrap();
                    let text = rest.split_once("</text>").unwrap().0.replace("&gt;", ">");
                    let place = numbers(place);
                    crate::svg::text_box(class, [place[0], place[1]], &text)
                })
                .collect();
            for line in drawing.split("<path class=\"replan").skip(1) {
                let pieces = line.split_once("d=\"").unwrap().1.split_once('"').unwrap().0;
                for piece in pieces.split('M').skip(1) {
                    let [x, top, bottom] = numbers(piece)[..] else { panic!("{piece}") };
                    lines += 1;
                    for [left, upper, right, lower] in &texts {
                        let apart = x < *left || *right < x || bottom < *upper || *lower < top;
                        assert!(apart, "{piece} crosses {left} {upper} {right} {lower}");
                    }
                }
            }
        }
        assert!(lines > 30, "{lines}");
    }
}

#[test]
fn the_legend_of_the_timeline_says_each_colour_that_is_drawn_and_degraded_is_not_granted() {
    let page = html(&delivery_under(FaultChoice::Script));
    let (drawing, legend) = page.split_once("<figcaption class=\"keys\">").unwrap();
    for class in ["f0", "f2", "f3", "f4", "f5", "f6", "gone"] {
        let drawn = drawing.contains(&format!("class=\"tint {class}\""));
        assert_eq!(legend.contains(&format!("swatch tint {class}\"")), drawn, "{class}");
    }
    assert!(legend.contains("f2\"></i>degraded") && legend.contains("f5\"></i>motion is granted"));
    let mut bars = 0;
    for bar in drawing.split("<g><title>").skip(1) {
        let colour = match bar.split(':').next().unwrap() {
            "PF.DEG" | "PF_DEG" | "TO.DEG" | "TO_DEG" => "class=\"tint f2\"",
            "Granted" => "class=\"tint f5\"",
            _ => continue,
        };
        assert!(bar.split("</g>").next().unwrap().contains(colour), "{bar}");
        bars += 1;
    }
    assert_eq!(bars, 20);
}

#[test]
fn on_a_phone_an_event_without_a_mark_keeps_its_place_in_the_grid() {
    let page = html(&delivery_under(FaultChoice::Script));
    let style = page.split_once("</style>").unwrap().0;
    // Only cells with a line of their own may vanish; the mark is the first of three in a line.
    assert!(style.contains(".events td:nth-child(n+4):empty { display: none; }"));
    assert!(!style.contains(".events td:empty"));
    let events = page.split_once("<section class=\"events\">").unwrap().1;
    let rows = events.split_once("</section>").unwrap().0.split("<tr>").skip(2);
    assert!(rows.clone().count() > 20);
    for row in rows {
        assert_eq!(row.matches("<td").count(), 4, "{row}");
    }
}

use crate::mission::{html, html_beside};
use cotama_core::units::Millis;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::Outcome;
use cotama_sim::trace::{Record, Trace};

mod curves;
mod data;
mod layout;
mod on_floor;
mod reading;

fn recorded(text: &str, options: &Options) -> Trace {
    Trace::record(&Mission::parse("patrol", text).unwrap(), options).unwrap().0
}

fn patrol() -> Trace {
    recorded(embedded::mission("patrol").unwrap().text, &Options::default())
}

fn patrol_under(body: &str) -> Trace {
    let text = embedded::mission("patrol").unwrap().text;
    let mission = Mission::parse("patrol", text).unwrap();
    let body = format!("format = \"panorama-faults/1\"\n{body}");
    let faults = Faults::parse("hall.toml", &body, &mission).unwrap();
    let faults = FaultChoice::Given { source: "hall.toml".into(), faults };
    recorded(text, &Options { faults, ..Options::default() })
}

/// Returns the first error in the tags of a page: every element closed in its turn, every attribute
/// quoted.
fn ill_formed(page: &str) -> Option<String> {
    const VOID: [&str; 2] = ["meta", "!DOCTYPE"];
    let mut open: Vec<&str> = Vec::new();
    // Style sheets are not markup.
    let (head, rest) = page.split_once("<style>")?;
    let (_, body) = rest.split_once("</style>")?;
    let whole = format!("{head}{body}");
    let mut rest = whole.as_str();
    while let Some(start) = rest.find(['<', '>']) {
        if rest[start..].starts_with('>') {
            return Some(format!(
                "a bare > before {:?}",
                &rest[start..].chars().take(40).collect::<String>()
            ));
        }
        let end = start + rest[start..].find('>')?;
        let tag = &rest[start + 1..end];
        if tag.contains('<') || tag.matches('"').count() % 2 == 1 {
            return Some(format!("a broken tag {tag:?}"));
        }
        let name = tag.trim_start_matches('/').trim_end_matches('/').split(' ').next()?;
        if tag.starts_with('/') {
            let last = open.pop();
            if last != Some(name) {
                return Some(format!("{last:?} is closed by {name}"));
            }
        } else if !tag.ends_with('/') && !VOID.contains(&name) {
            open.push(name);
        }
        rest = &rest[end + 1..];
    }
    open.pop().map(|name| format!("{name} is never closed"))
}

fn assert_sound(page: &str) {
    if let Some(problem) = ill_formed(page) {
        panic!("{problem}");
    }
    for foreign in ["http://", "https://", "url(", "@import", "<script", "NaN"] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    assert!(page.len() < 400_000, "{} bytes", page.len());
}

#[test]
fn the_checker_of_these_tests_can_fail() {
    let page = |body: &str| format!("<html><style></style>{body}</html>");
    assert_eq!(ill_formed(&page("<p>a</p>")), None);
    assert!(ill_formed(&page("<p>a")).is_some());
    assert!(ill_formed(&page("<p><b>a</p></b>")).is_some());
    assert!(ill_formed(&page("a > b")).is_some());
    assert!(ill_formed(&page("<p class=\"a>b</p>")).is_some());
}

#[test]
fn the_patrol_shows_its_outcome_all_plans_and_all_events() {
    let page = html(&patrol());
    assert_sound(&page);
    assert!(page.contains("<strong>Completed</strong>"));
    assert!(page.contains("All 17 activities are done, within both limits, after 3 replans."));
    for number in 0..4 {
        assert!(page.contains(&format!("<b class=\"pin\">{number}</b>")), "plan {number}");
    }
    for cause in ["Energy margin below zero", "One laser lost"] {
        assert!(page.contains(cause), "{cause}");
    }
    // Three replans in the strip and four charts, each wide and narrow.
    assert_eq!(page.matches("class=\"replan\"").count(), 3 * 5 * 2);
    // RAS1 changes A16 and A17, RAS2 A14, A15 and A17, RAS3 A17.
    assert_eq!(page.matches(" changed\"").count(), 2 + 3 + 1);
    assert!(page.contains("<span class=\"id\">A14–A15</span><s>M5 L2</s>"));
    assert!(page.contains(
        "At that time, at 63.4\u{a0}m: odometry wrong: 2 m of extra path, 4.9\u{a0}s lost."
    ));
    assert!(
        page.contains("9 dropped: zone glass-out requires the moving option to use 1 of sonar")
    );
    assert!(page.contains("768\u{202f}288\u{202f}795\u{202f}144\u{202f}192 plans"));
    assert_eq!(page.matches("<path class=\"mark obstacle\"").count(), 6 * 3 + 1);
    assert!(page.contains("No trace of this run was written."));
    let beside = html_beside(&patrol(), Some("'a & b.jsonl'"));
    assert!(beside.contains("<code>cotama replay &#39;a &amp; b.jsonl&#39;</code>"));
    assert!(!beside.contains("No trace"));
}

#[test]
fn equal_traces_give_equal_pages() {
    let trace = patrol();
    let again = Trace::parse("patrol.jsonl", &trace.to_json_lines()).unwrap();
    assert_eq!(html(&trace), html(&again));
}

#[test]
fn a_run_with_thousands_of_samples_stays_small() {
    let text = embedded::mission("patrol").unwrap().text;
    let trace = recorded(text, &Options { monitor_period: Some(Millis(90)), ..Options::default() });
    assert!(trace.records.len() > 5900, "{}", trace.records.len());
    assert_sound(&html(&trace));
}

#[test]
fn a_hostile_name_is_only_text() {
    let hostile = "</title><script>alert(1)</script><b onload='x' \u{202e}";
    let mut trace = patrol();
    trace.header.mission = trace.header.mission.replacen(
        "name = \"patrol\"",
        &format!("name = {:?}", hostile.replace('\u{202e}', "")),
        1,
    );
    trace.header.mission_source = hostile.into();
    trace.header.version = hostile.into();
    for record in &mut trace.records {
        match record {
            Record::Plan(plan) => {
                plan.cause = hostile.into();
                plan.plan[0].choice = hostile.into();
                plan.plan[0].activity = hostile.into();
            }
            Record::Activity(activity) => activity.choice = hostile.into(),
            Record::End(end) => end.reason = Some(hostile.into()),
            _ => {}
        }
    }
    let page = html(&trace);
    assert_sound(&page);
    assert!(page.contains("&lt;script&gt;"));
}

#[test]
fn the_other_outcomes_are_told_with_their_reasons() {
    let safe = patrol_under(
        "event = [{ x_mm = 60000, kind = \"fault\", hardware = \"kinect\", units_lost = 1 }]",
    );
    let page = html(&safe);
    assert_sound(&page);
    assert!(page.contains("<strong>Stopped safely</strong>"));
    assert!(page.contains("no alternative left for A10"));
    assert!(page.contains("Mission aborted"));
    assert!(page.contains("run ended") && page.contains("class=\"bar todo\""));

    let failed = patrol_under("event = [{ x_mm = 187000, kind = \"obstacle\", delay_ms = 94000 }]");
    assert!(
        matches!(failed.records.last(), Some(Record::End(end)) if end.outcome == Outcome::Failed)
    );
    let page = html(&failed);
    assert_sound(&page);
    assert!(page.contains("<strong>Failed</strong>") && page.contains("over the limit"));
    assert!(page.contains("duration limit exceeded by"));
}

#[test]
fn a_trace_without_samples_or_without_records_is_still_a_page() {
    let mut trace = patrol();
    trace.records.retain(|record| !matches!(record, Record::Sample(_)));
    let page = html(&trace);
    assert_sound(&page);
    assert!(page.contains("no samples in this trace"));
    trace.records.clear();
    let page = html(&trace);
    assert_sound(&page);
    assert!(page.contains("<strong>Unfinished</strong>"));
}

#[test]
fn a_mission_that_cannot_be_read_leaves_out_its_figures() {
    let mut trace = patrol();
    trace.header.mission = "no mission".into();
    let page = html(&trace);
    assert_sound(&page);
    assert!(page.contains("cannot be read"));
    assert!(page.contains("<span class=\"id\">A14–A15</span>"));
    assert!(page.contains(">A17</text>"));
}

#[test]
fn a_trace_without_a_path_is_all_stops() {
    let mut trace = patrol();
    trace.header.path_length_mm = 0;
    trace.header.mission = String::new();
    trace.records.retain(|record| record.x_mm() == 37_000);
    for record in &mut trace.records {
        match record {
            Record::Activity(it) => it.x_mm = 0,
            Record::Sample(it) => it.x_mm = 0,
            _ => {}
        }
    }
    let page = html(&trace);
    assert_sound(&page);
    assert!(page.contains(">A5</text>"));
}

#[test]
fn numbers_at_their_ends_do_not_break_the_page() {
    let mut trace = patrol();
    trace.header.limits.duration_ms = u64::MAX;
    trace.header.limits.energy_mj = 0;
    trace.header.path_length_mm = u64::MAX;
    trace.header.options.seed = u64::MAX;
    for record in &mut trace.records {
        match record {
            Record::Plan(plan) => {
                plan.after.energy_mj = i64::MIN;
                plan.t_us = u64::MAX;
            }
            Record::Sample(sample) => {
                sample.margins.duration_ms = i64::MAX;
                sample.margins.energy_mj = i64::MIN;
                sample.real_power_mw = u64::MAX;
                sample.x_mm = u64::MAX;
            }
            Record::Event(event) => event.lost_us = u64::MAX,
            Record::Activity(activity) => activity.t_us = u64::MAX,
            Record::End(end) => (end.margins.energy_mj, end.replans) = (i64::MIN, u64::MAX),
            _ => {}
        }
    }
    assert_sound(&html(&trace));
}

#[test]
fn thousands_of_replans_are_cut_and_said_to_be() {
    let mut trace = patrol();
    let plan =
        trace.records.iter().find(|record| matches!(record, Record::Plan(_))).unwrap().clone();
    let end = trace.records.pop().unwrap();
    trace.records.extend(std::iter::repeat_n(plan, 10_000));
    trace.records.push(end);
    let page = html(&trace);
    assert!(ill_formed(&page).is_none());
    assert!(page.contains("further replans are in the trace"));
    assert!(page.len() < 2_000_000, "{}", page.len());
}

fn delivery_under(faults: FaultChoice) -> Trace {
    let text = embedded::mission("delivery").unwrap().text;
    let options = Options { faults, ..Options::default() };
    Trace::record(&Mission::parse("delivery", text).unwrap(), &options).unwrap().0
}

fn failures(modes: &[&str]) -> FaultChoice {
    let text = embedded::mission("delivery").unwrap().text;
    let mission = Mission::parse("delivery", text).unwrap();
    let event =
        |mode: &&str| format!("[[event]]\nx_mm = 5000\nkind = \"failure\"\nmode = \"{mode}\"\n");
    let body: String = modes.iter().map(event).collect();
    let body = format!("format = \"panorama-faults/1\"\n{body}");
    FaultChoice::Given {
        source: "f.toml".into(),
        faults: Faults::parse("f.toml", &body, &mission).unwrap(),
    }
}

#[test]
fn the_delivery_shows_seven_points_with_their_decisions_and_how_far_up_they_went() {
    let page = html(&delivery_under(FaultChoice::Script));
    assert_sound(&page);
    // Marked in both figures, wide and narrow.
    assert_eq!(page.matches("<circle class=\"pin point\"").count(), 7 * 4);
    for lane in
        ["Failures", "Mode", "Runs", "Global", "Local", "Following", "Teleoperat…", "Permit"]
    {
        assert!(page.contains(&format!(">{lane}</text>")), "{lane}");
    }
    let decisions = page.split_once("class=\"decisions\"").unwrap().1;
    let [table, ladder] = decisions.split("<h2>The ladder</h2>").collect::<Vec<_>>()[..] else {
        panic!()
    };
    assert_eq!(table.matches("<tr class=\"point\">").count(), 7);
    assert!(table.contains(
        "<td>sonar far <small>4.9\u{a0}s</small></td><td>SON1</td><td>SON1</td>\
        <td>medium → adapter</td><td>adapter</td><td><b>adapt_Following</b> <small>5.0\u{a0}s, \
        SON1_PF_OPT1</small></td><td>following PF_OPT_adapts8 <small>5.1\u{a0}s</small></td>\
        <td class=\"n\">5.2\u{a0}s</td>"
    ));
    let steps = |rung: &str| ladder.matches(&format!("<td class=\"step {rung}\">")).count();
    assert_eq!(
        ["parameter", "set", "activity", "objective", "mission"].map(steps),
        [2, 1, 4, 1, 0]
    );
    assert!(page.contains("Point 6, SON1: sonar array, one transducer stuck at maximum range."));
    assert!(page.contains("<dt>Failures</dt><dd>4, 4 found</dd>"));
}

#[test]
fn a_supervised_mission_that_is_given_up_says_why() {
    let page = html(&delivery_under(failures(&["BAT2"])));
    assert_sound(&page);
    assert!(
        page.contains(
            "The robot stands at 5.0\u{a0}m: the global supervisor ended the mission: critical"
        ),
        "{page}"
    );
    assert!(page.contains("<td class=\"step mission\">ended safely</td>"));
    let page = html(&delivery_under(failures(&["SW3"])));
    assert_sound(&page);
    assert!(page.contains("the laptop is down") && page.contains("nobody noticed it"));
    assert_sound(&html(&delivery_under(FaultChoice::None)));
}

#[test]
fn hostile_names_and_numbers_of_supervisors_are_only_text() {
    let mut trace = delivery_under(FaultChoice::Script);
    let hostile = || String::from("<script>alert(1)</script>");
    for record in &mut trace.records {
        match record {
            Record::Fired(it) => (it.place, it.t_us) = (hostile(), u64::MAX),
            Record::Failure(it) => (it.mode, it.failure) = (hostile(), 1),
            Record::Diagnosis(it) => (it.flags, it.candidates) = (vec![hostile()], vec![hostile()]),
            Record::Decision(it) => (it.event, it.transition) = (Some(hostile()), Some(hostile())),
            Record::Configuration(it) => it.configuration = Some(hostile()),
            Record::Exposure(it) => it.exposed_ms = u64::MAX,
            _ => {}
        }
    }
    assert_sound(&html(&trace));
}

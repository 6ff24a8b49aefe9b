//! `cotama conform` on the logs that robots write: what the program says of them.

use crate::common::Folder;
use serde_json::json;

/// A net of `ProM` or `pm4py`: `weld`, an invisible step, and two steps called `check`.
fn process(invisible: &str) -> String {
    let transition = |id: &str, name: &str, more: &str| {
        format!("<transition id=\"{id}\"><name><text>{name}</text></name>{more}</transition>")
    };
    let places = (0..5).map(|at| {
        let tokens = "<initialMarking><text>1</text></initialMarking>";
        format!("<place id=\"p{at}\">{}</place>", if at == 0 { tokens } else { "" })
    });
    let steps =
        [("a", "weld", ""), ("b", "tau", invisible), ("c", "check", ""), ("d", "check", "")];
    let arcs = (0..).zip(&steps).map(|(at, (id, ..))| {
        let after = at + 1;
        format!(
            "<arc id=\"i{id}\" source=\"p{at}\" target=\"{id}\"/>\
             <arc id=\"o{id}\" source=\"{id}\" target=\"p{after}\"/>"
        )
    });
    let all = places.chain(steps.iter().map(|it| transition(it.0, it.1, it.2))).chain(arcs);
    format!(
        "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\"><net id=\"n\" \
         type=\"http://www.pnml.org/version-2009/grammar/ptnet\"><page id=\"g\">{}</page></net>\
         </pnml>",
        all.collect::<String>()
    )
}

fn code(folder: &Folder, model: &str, told: &str, more: &[&str]) -> Option<i32> {
    let lines = told.split(", ").map(|line| {
        let words: Vec<_> = line.split(' ').collect();
        json!({ "t_ms": words[0].parse::<u64>().unwrap(), words[1]: words[2] }).to_string()
    });
    folder.write("log.jsonl", lines.collect::<Vec<_>>().join("\n"));
    folder.cotama(&[&["conform", model, "log.jsonl"], more].concat()).code
}

#[test]
fn a_step_invisible_in_prom_need_not_be_recorded_and_a_shared_name_means_any_of_its_steps() {
    let folder = Folder::new("logs_invisible");
    let mark = "<toolspecific tool=\"ProM\" version=\"6.4\" activity=\"$invisible$\"/>";
    folder.write("marked.pnml", process(mark));
    folder.write("plain.pnml", process(""));
    let of_model = |model: &str, told: &str| code(&folder, model, told, &[]);
    let whole = "1 fired weld, 2 fired check, 3 fired check";
    assert_eq!(of_model("marked.pnml", whole), Some(0));
    assert_eq!(of_model("plain.pnml", whole), Some(1));
    assert_eq!(of_model("marked.pnml", "1 fired weld, 2 fired tau, 3 fired check"), Some(0));
    assert_eq!(of_model("marked.pnml", "1 fired check, 2 fired check"), Some(1));
    assert_eq!(of_model("marked.pnml", "1 fired weld, 2 fired weld"), Some(1));
    assert_eq!(of_model("marked.pnml", &format!("{whole}, 4 fired check")), Some(1));
}

/// A net of transitions `[name, from, to]`, of which those called `tau` are invisible.
fn silent(steps: &[[&str; 3]]) -> String {
    let places = ["p", "q", "r", "s"].map(|it| {
        let tokens = "<initialMarking><text>1</text></initialMarking>";
        format!("<place id='{it}'>{}</place>", if it == "p" { tokens } else { "" })
    });
    let step = |(at, [name, from, to]): (usize, &[&str; 3])| {
        let mark = "<toolspecific tool='ProM' version='6.4' activity='$invisible$'/>";
        format!(
            "<transition id='t{at}'><name><text>{name}</text></name>{}</transition>\
             <arc id='i{at}' source='{from}' target='t{at}'/>\
             <arc id='o{at}' source='t{at}' target='{to}'/>",
            if *name == "tau" { mark } else { "" }
        )
    };
    format!(
        "<pnml><net id='n' type='http://www.pnml.org/version-2009/grammar/ptnet'><page id='g'>\
         {}{}</page></net></pnml>",
        places.concat(),
        steps.iter().enumerate().map(step).collect::<String>()
    )
}

#[test]
fn invisible_steps_of_any_net_are_taken_where_a_log_needs_them() {
    let folder = Folder::new("logs_silent");
    let fired = |names: &[&str]| {
        let lines = names.iter().zip(1..).map(|(name, at)| format!("{at} fired {name}"));
        lines.collect::<Vec<_>>().join(", ")
    };
    let two = silent(&[["tau", "p", "q"], ["tau", "q", "r"], ["weld", "r", "s"]]);
    let skipped = silent(&[["tau", "p", "q"], ["weld", "p", "q"], ["check", "q", "r"]]);
    let again = silent(&[["weld", "p", "q"], ["tau", "q", "p"], ["check", "q", "r"]]);
    let choice =
        silent(&[["tau", "p", "q"], ["tau", "p", "r"], ["weld", "q", "s"], ["check", "r", "s"]]);
    let last = silent(&[["weld", "p", "q"], ["tau", "q", "r"]]);
    let turns = silent(&[["tau", "p", "p"], ["weld", "p", "s"]]);
    for (net, log, expected) in [
        (&two, &["weld"][..], 0),
        (&two, &["tau", "weld"], 0),
        (&two, &["tau", "tau", "weld"], 0),
        (&two, &["weld", "weld"], 1),
        (&skipped, &["check"], 0),
        (&skipped, &["weld", "check"], 0),
        (&skipped, &["weld", "weld"], 1),
        (&again, &["weld", "weld", "check"], 0),
        (&again, &["weld", "weld", "weld", "check"], 0),
        (&again, &["check"], 1),
        (&choice, &["weld"], 0),
        (&choice, &["check"], 0),
        (&choice, &["weld", "check"], 1),
        (&last, &["weld"], 0),
        (&last, &["weld", "tau"], 0),
        (&last, &["tau"], 1),
        (&turns, &["weld"], 0),
        (&turns, &["tau", "tau", "weld"], 0),
        (&turns, &["weld", "tau"], 1),
    ] {
        folder.write("it.pnml", net);
        assert_eq!(code(&folder, "it.pnml", &fired(log), &[]), Some(expected), "{log:?} {net}");
    }
}

#[test]
fn a_file_that_marks_where_runs_end_has_a_note_beside_its_deadlock() {
    let folder = Folder::new("logs_final");
    let finals =
        "<finalmarkings><marking><place idref='q'><text>1</text></place></marking></finalmarkings>";
    let plain = silent(&[["weld", "p", "q"]]);
    let at = |before: &str, part: &str| plain.replacen(before, &format!("{part}{before}"), 1);
    let note = "the file says in which markings runs are to end; here a marking in which nothing \
        can fire is a deadlock wherever it is";
    let place = "<finalMarking><text>1</text></finalMarking></place>";
    for (net, notes) in [
        (plain.clone(), &[][..]),
        (at("</net>", finals), &[note]),
        (at("</page>", finals), &[note]),
        (at("<page", finals), &[note]),
        (at("</net>", "<finalmarkings/>"), &[note]),
        (at("</net>", &finals.repeat(3)), &[note]),
        (plain.replacen("<place id='q'></place>", &format!("<place id='q'>{place}"), 1), &[note]),
    ] {
        folder.write("it.pnml", &net);
        let asked = ["check", "it.pnml", "--property", "deadlock_free", "--json"];
        let answer = folder.cotama(&asked).json(1);
        assert_eq!(answer["results"][0]["verdict"], "false", "{net}");
        assert_eq!(answer["notes"], json!(notes), "{net}");
    }
}

#[test]
fn a_log_of_events_and_outputs_says_conforms_departs_or_unknown() {
    let folder = Folder::new("logs_outputs");
    let watchdog = |told: &str, more: &[&str]| code(&folder, "watchdog", told, more);
    // Three jobs that are never done: the third extra time ends in a fault.
    let misses = "0 event Release, 120 output SkipJob, 200 event Release, 320 output SkipJob, \
                  400 event Release, 520 output SkipJob, 520 output RtFault";
    assert_eq!(watchdog(misses, &[]), Some(0));
    assert_eq!(watchdog(&misses.replace(", 520 output RtFault", ", 900 event Done"), &[]), Some(1));
    assert_eq!(watchdog(&misses.replace("320", "321"), &[]), Some(1));
    assert_eq!(watchdog(&misses.replace("320", "321"), &["--tolerance", "2"]), Some(0));
    let wide = misses.replace("320", "350");
    assert_eq!(watchdog(&wide, &["--tolerance", "20", "--max-states", "2"]), Some(3));
    let ended = folder.cotama(&[
        "conform",
        "watchdog",
        "log.jsonl",
        "--tolerance",
        "20",
        "--max-states",
        "2",
        "--json",
    ]);
    let answer = ended.json(3);
    assert_eq!((&answer["conforms"], &answer["departs"]), (&json!(null), &json!(null)));
    assert!(answer["unknown_from"].as_u64().is_some(), "{answer}");
    let name = folder.cotama(&["conform", "watchdog", "log.jsonl", "--max-states", "0"]);
    assert_eq!(name.code, Some(2));
    assert_eq!(watchdog("0 output Skip", &[]), Some(2));
}

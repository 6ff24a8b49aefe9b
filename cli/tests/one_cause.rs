//! Many errors of one cause are one message, which says where the others are.

use crate::common::Folder;
use serde_json::{Value, json};

#[test]
fn many_errors_of_one_cause_are_one_message_with_a_count() {
    let folder = Folder::new("texts_fold");
    let row = vec!["0.5"; 100].join(", ");
    let task =
        |at: usize| format!("{{\"name\": \"t{at}\", \"skip_cost\": null, \"cost\": [{row}]}}");
    let robots: Vec<_> = (0..100).map(|at| format!("\"r{at}\"")).collect();
    let tasks: Vec<_> = (0..100).map(task).collect();
    folder.write(
        "floats.json",
        format!(
            "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"t\", \"kind\": \"single\",\n\
             \"cost_denominator\": 1, \"robots\": [{}],\n\"tasks\": [\n{}]}}",
            robots.join(", "),
            tasks.join(",\n")
        ),
    );
    let error = folder.cotama(&["assign", "floats.json", "--json"]).json(2);
    assert_eq!((&error["times"], &error["line"]), (&10_000.into(), &4.into()), "{error}");
    assert!(error["help"].as_str().unwrap().contains("multiply all by the same factor"));
    assert!(error["more"].is_null(), "{error}");
    // A net of which nothing is right, a list of properties, a table, faults.
    let forty = |one: &dyn Fn(usize) -> String| (0..40).map(one).collect::<Vec<_>>().concat();
    let arcs = forty(&|at| format!("<arc id=\"a{at}\" source=\"x{at}\" target=\"y\"/>\n"));
    let kind = "http://www.pnml.org/version-2009/grammar/ptnet";
    let page = format!("<page id=\"g\">{arcs}</page>");
    folder.write("arcs.pnml", format!("<pnml><net id=\"n\" type=\"{kind}\">{page}</net></pnml>"));
    folder.write("p.txt", forty(&|at| format!("AG (x{at} & y)\n")));
    let rows = forty(&|at| format!("A{at},f,c,x,w,e,hrad,0\n"));
    let head = "id,function,component,failure,cause,effect,severity,mtbf_h\n";
    folder.write("a.csv", format!("{head}{rows}"));
    let events = forty(&|at| format!("[[event]]\nx_mm = {at}\nkind = 'obstcle'\n"));
    folder.write("f.toml", format!("format = 'panorama-faults/1'\n{events}"));
    for line in [
        "assign floats.json",
        "check arcs.pnml",
        "check door --properties p.txt",
        "fmeca a.csv",
        "run patrol --faults f.toml",
    ] {
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!(ended.code, Some(2), "{line}: {ended:?}");
        assert!(ended.stderr.contains("the same at "), "{line}: {}", ended.stderr);
        assert!(ended.stderr.lines().count() <= 30, "{line}: {}", ended.stderr);
    }
}

/// A page of a P/T net with so many parts.
fn page(part: &dyn Fn(usize) -> String) -> String {
    let parts: String = (0..60).map(part).collect();
    format!(
        "<pnml><net id=\"n\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\">\
         <page id=\"g\">\n{parts}</page></net></pnml>"
    )
}

#[test]
fn sixty_errors_of_one_cause_are_counted_behind_the_first() {
    let folder = Folder::new("one_cause_sixty");
    let lines = |head: &str, one: &dyn Fn(usize) -> String| {
        let all: String = (0..60).map(|at| one(at) + "\n").collect();
        format!("{head}{all}")
    };
    let columns = "id,function,component,failure,cause,effect,severity,mtbf_h\n";
    let faults = "format = 'panorama-faults/1'\n";
    let event = |x: &str, kind: &str| format!("[[event]]\n{x}\nkind = '{kind}'\ndelay_ms = 1");
    for (file, text, line, times, first) in [
        (
            "marking.pnml",
            page(&|at| {
                let marking = "<initialMarking><text>-1</text></initialMarking>";
                format!("<place id='p{at}'>{marking}</place>\n")
            }),
            "check marking.pnml",
            60,
            "`-1` is negative",
        ),
        (
            "kind.pnml",
            page(&|at| {
                let arc = format!("<arc source='p{at}' target='t{at}' type='flush'/>");
                format!("<place id='p{at}'/><transition id='t{at}'/>{arc}\n")
            }),
            "statespace kind.pnml",
            60,
            "an arc of the kind `flush`",
        ),
        (
            "ids.pnml",
            page(&|_| "<place id='p'/>\n".to_owned()),
            "simulate ids.pnml",
            59,
            "the id `p` is that of a place already",
        ),
        (
            "random.xml",
            page(&|at| {
                let timed = "<timed><value>true</value></timed>";
                format!("<transition id='t{at}'>{timed}</transition>\n")
            }),
            "check random.xml",
            1,
            "a transition with a random delay, which is not read",
        ),
        (
            "net.tapn",
            page(&|at| format!("<place id='p{at}' initialMarking='0' invariant='&lt; inf'/>\n")),
            "check net.tapn",
            1,
            "this is TAPAAL's own format (`.tapn`), not PNML",
        ),
        (
            "p.txt",
            lines("", &|_| "AG (Closed & Opn)".to_owned()),
            "check door --properties p.txt",
            60,
            "there is no place `Opn`",
        ),
        (
            "q.txt",
            lines("", &|at| format!("EF Door{at}")),
            "check door --properties q.txt",
            60,
            "there is no place `Door0`",
        ),
        (
            "title.csv",
            lines(&format!("FMEA of the arm,,,,,,,\n{columns}"), &|at| {
                format!("A{at},f,c,x,w,e,hard,9")
            }),
            "fmeca title.csv",
            1,
            "the first row holds the names of the columns, and this one does not",
        ),
        (
            "severity.csv",
            lines(columns, &|at| format!("A{at},f,c,x,w,e,hrad,9")),
            "fmeca severity.csv",
            60,
            "unknown severity `hrad`; did you mean `hard`?",
        ),
        (
            "unit.toml",
            lines(faults, &|at| event(&format!("x_m = {at}"), "obstacle")),
            "run patrol --faults unit.toml",
            60,
            "unknown key `x_m` in this `event`; did you mean `x_mm`?",
        ),
        (
            "float.toml",
            lines(faults, &|at| event(&format!("x_mm = {at}.5"), "obstacle")),
            "run patrol --faults float.toml",
            60,
            "`x_mm` must be an integer, not the float `0.5`",
        ),
        (
            "kind.toml",
            lines(faults, &|at| event(&format!("x_mm = {at}"), &format!("obst{at}"))),
            "run patrol --faults kind.toml",
            60,
            "unknown event `obst0`",
        ),
        (
            "r.jsonl",
            lines("", &|at| json!({ "t_ms": at, "event": "Cal" }).to_string()),
            "conform door r.jsonl",
            1,
            "`door` has no event `Cal`; did you mean `Call`?",
        ),
    ] {
        folder.write(file, text);
        let error = folder.shell(&format!("cotama {line} --json")).json(2);
        assert_eq!((&error["message"], &error["more"]), (&json!(first), &Value::Null), "{error}");
        let found = error["times"].as_u64().unwrap_or(1);
        assert_eq!(found, times, "{error}");
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!(ended.code, Some(2), "{line}: {ended:?}");
        assert!(ended.stderr.lines().count() <= 12, "{}", ended.stderr);
        let said = format!("the same at {} further places: lines ", times - 1);
        assert_eq!(ended.stderr.contains(&said), times > 1, "{}", ended.stderr);
    }
}

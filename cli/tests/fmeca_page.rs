//! The page of an analysis: all that the answer in JSON says, read back from the page.

use crate::common::Folder;
use serde_json::Value;

/// Returns the text of a piece of HTML: without tags, with its characters as they are meant.
fn text(html: &str) -> String {
    let parts = html.split('<').map(|it| it.split_once('>').map_or(it, |it| it.1));
    let text: String = parts.collect::<Vec<_>>().join("");
    let named = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    named.into_iter().fold(text, |text, (name, meant)| text.replace(name, meant))
}

fn between<'a>(page: &'a str, from: &str, to: &str) -> &'a str {
    let rest = page.split_once(from).unwrap_or_else(|| panic!("{from} is not there")).1;
    rest.split_once(to).unwrap_or_else(|| panic!("no {to} behind {from}")).0
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn word(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// Holds a row of the table, and the field of the criticality matrix, to the answer.
fn shows_row(page: &str, row: &Value) {
    let id = word(&row["id"]);
    let html = between(page, &format!("<tr id=\"{id}\""), "</tr>");
    let shown = text(html);
    let it = &row["criticality"];
    let ranks = format!("{} · {} · {}", it["severity"], it["occurrence"], it["detection"]);
    let failure = format!("{}: {}", word(&row["component"]), word(&row["failure"]));
    let mut said = vec![failure, ranks, it["rpn"].to_string()];
    for key in ["function", "persistence", "cause", "effect", "loss", "reaction"] {
        said.push(word(&row[key]).to_owned());
    }
    for key in ["severity_autonomous", "severity_operator"] {
        said.push(word(&row[key]).to_owned());
    }
    // Instead of an observer, the reason why there is none.
    let seen = if row["undetectable_reason"].is_null() {
        ["observer", "detection"].as_slice()
    } else {
        &["undetectable_reason"]
    };
    said.extend(seen.iter().map(|key| word(&row[*key]).to_owned()));
    said.extend(
        ["class", "severity_class", "occurrence_class"].map(|key| word(&it[key]).to_owned()),
    );
    for said in said {
        assert!(shown.contains(&said), "{id}: `{said}` is not in {shown}");
    }
    assert!(html.contains(&format!("<b class=\"pill {0}\">{0}</b>", word(&it["class"]))), "{id}");
    let matrix = between(page, "<table class=\"matrix\">", "</table>");
    let link = format!("<a href=\"#{id}\">");
    assert_eq!(matrix.matches(&link).count(), 1, "{id}");
    let occurrence = format!("<th scope=\"row\">{} ", word(&it["occurrence_class"]));
    let column = format!("data-column=\"{}\"", word(&it["severity_class"]));
    let field = between(between(matrix, &occurrence, "</tr>"), &column, "</span>");
    assert!(field.contains(&link), "{id}");
}

/// Holds what cannot be told apart in a status to the answer.
fn shows_status(html: &str, status: &Value) {
    let name = &status["status"];
    let told = text(html);
    let count = |it: &Value| it.as_u64().unwrap();
    assert!(told.contains(&format!("{} failure modes are detected", count(&status["detectable"]))));
    for pair in list(&status["pairs"]) {
        let heads: Vec<_> = list(&pair["modes"])
            .iter()
            .map(|it| format!("<a href=\"#{0}\">{0}</a>", word(it)))
            .collect();
        let row =
            text(between(html, &format!("<tr><th scope=\"row\">{}", heads.join(" ")), "</tr>"));
        for said in ["flags", "flags_optional", "probes"].iter().flat_map(|it| list(&pair[*it])) {
            assert!(row.contains(word(said)), "{name}: {said} is not in {row}");
        }
    }
    for probe in list(&status["least_probes"]) {
        assert!(between(html, "<p>Least set:", "</p>").contains(word(probe)), "{name}: {probe}");
    }
    for unseen in list(&status["undetectable"]) {
        let row = between(html, &format!("{}</a> is not seen", word(&unseen["id"])), "</div>");
        assert!(text(row).contains(&word(&unseen["reason"]).replace('`', "")), "{name}: {unseen}");
    }
    for id in list(&status["impossible"]) {
        let row = between(html, "Cannot happen then:", "</p>");
        assert!(row.contains(&format!("<a href=\"#{0}\">{0}</a>", word(id))), "{name}: {id}");
    }
}

/// Holds a page to the answer of the same analysis.
pub(crate) fn shows(page: &str, answer: &Value) {
    let ids = ["table", "matrix", "diagrams", "diagnosability", "abbreviations"];
    let places = ids.map(|it| page.find(&format!("<section id=\"{it}\">")).expect(it));
    assert!(places.is_sorted());
    list(&answer["rows"]).iter().for_each(|row| shows_row(page, row));
    for diagram in list(&answer["diagrams"]) {
        let effect = format!("Cause-effect diagram: cannot {}\">", word(&diagram["function"]));
        let drawn = between(page, &effect, "</svg>");
        for rib in list(&diagram["ribs"]) {
            for id in list(&rib["modes"]) {
                let branch = format!("<title>{}: ", word(id));
                assert_eq!(drawn.matches(&branch).count(), 1, "{branch}");
            }
        }
    }
    let all = between(page, "<section id=\"diagnosability\">", "</section>");
    let statuses = list(&answer["diagnosability"]["statuses"]);
    let parts: Vec<_> = all.split("<h3>").collect();
    for status in statuses {
        let head = format!("Status: {}</h3>", word(&status["status"]));
        // One alone needs no heading.
        let part = if statuses.len() > 1 { None } else { parts.first().copied() };
        let part = part.or_else(|| parts.iter().copied().find(|it| it.starts_with(&head)));
        shows_status(part.unwrap_or_else(|| panic!("no {head}")), status);
    }
    for probe in list(&answer["diagnosability"]["probes"]) {
        let name = word(&probe["name"]);
        assert!(between(all, "<h3>Probes</h3>", "</table>").contains(name), "{name}");
    }
}

#[test]
fn the_page_says_all_that_the_answer_says() {
    let folder = Folder::new("fmeca_page_says");
    let answer = folder.cotama(&["fmeca", "--json"]).json(0);
    let page = folder.cotama(&["fmeca", "--format", "html"]).stdout;
    shows(&page, &answer);
    assert_eq!(list(&answer["diagnosability"]["statuses"]).len(), 1);
}

#[test]
#[should_panic(expected = "SON2: `sonar array: whole array silent`")]
fn a_page_with_another_failure_is_noticed() {
    let folder = Folder::new("fmeca_page_wrong");
    let answer = folder.cotama(&["fmeca", "--json"]).json(0);
    let page = folder.cotama(&["fmeca", "--format", "html"]).stdout;
    shows(&page.replace("whole array silent", "half an array silent"), &answer);
}

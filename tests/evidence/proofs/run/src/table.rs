//! The list of all harnesses, in Markdown: what each says, how it is known, what was covered.

use crate::harnesses::Listed;
use crate::short;
use kani::Report;

/// Harnesses that were explored on machine code, one a line: written by `symbolic/check.sh`.
const SYMBOLIC: &str = include_str!("../../symbolic/holds.txt");

/// The first sentence of a documentation, on one line.
fn says(doc: &str) -> String {
    let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
    doc.split_once(". ").map_or(doc.clone(), |it| it.0.to_string()).trim_end_matches('.').into()
}

/// A number with commas.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Adds a paragraph, its lines no longer than the project's, those after the first indented.
fn wrap(text: &mut String, paragraph: &str, indent: &str) {
    let mut length = 0;
    for word in paragraph.split_whitespace() {
        let own = word.chars().count();
        if length > 0 && length + 1 + own > 100 {
            *text += "\n";
            *text += indent;
            length = indent.len();
        } else if length > 0 {
            *text += " ";
            length += 1;
        }
        *text += word;
        length += own;
    }
    *text += "\n";
}

/// All harnesses by room and name.
pub(crate) fn of(done: &[(&Listed, Report)]) -> String {
    let (mut exhaustive, mut sampled, mut symbolic) = (0, 0, 0);
    let (mut list, mut last) = (String::new(), String::new());
    for (listed, report) in done.iter().filter(|it| !it.0.harness.must_fail) {
        let path = short(listed.harness.name);
        let (room, name) = path.rsplit_once("::").unwrap_or(("", &path));
        if room != last {
            list += &format!("\n### {room}\n\n");
            last = room.into();
        }
        let cases = grouped(report.cases);
        let mut word = if report.exhaustive {
            exhaustive += 1;
            format!("exhaustive ({cases} cases)")
        } else {
            sampled += 1;
            format!("sampled ({cases} runs)")
        };
        if SYMBOLIC.lines().any(|it| it == path) {
            symbolic += 1;
            word += "; machine code, all inputs (angr, x86-64)";
        }
        let covers: Vec<_> =
            report.covers.iter().map(|it| format!("{} ({})", it.0, grouped(it.1))).collect();
        let (says, covers) = (says(listed.harness.says), covers.join(", "));
        wrap(&mut list, &format!("- `{name}`: {says}. *{word}*; covered: {covers}"), "  ");
    }
    let all = exhaustive + sampled;
    let mut text = String::new();
    let summary = format!(
        "{all} harnesses: {exhaustive} exhaustive in their bound, {sampled} sampled; {symbolic} of \
         them are explored on machine code for all inputs. Every one is a Kani harness, not yet \
         run by Kani."
    );
    wrap(&mut text, &summary, "");
    text + &list
}

//! The screens of `cotama models`.

use super::numbers::{count, grouped};
use super::style::{FAINT, GOOD, HEADING, NAME, NOTICE};
use super::table::{Cell, Table};
use super::{described, visible, wrapped};
use crate::answers::model::{LawRow, ModelKind, ModelRow, ModelsAnswer, Shown, SignalRow};
use crate::catalogue::Entry;
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Place, Role};
use std::fmt::Write;

/// The most places, events, outputs and laws that are shown of one net.
const SHOWN: usize = 60;
/// The least of a description that is worth a column.
const LEAST: usize = 24;

/// All models, one line each. The entries are those of the rows.
pub(crate) fn table(answer: &ModelsAnswer, entries: &[Entry], width: usize) -> String {
    let heads = ["", "places", "transitions", "states", "laws", ""];
    let number = |number: Option<u64>| {
        number.map_or_else(|| "\u{2013}".to_owned(), |it| grouped(&it.to_string()))
    };
    let cells = |(row, entry): (&ModelRow, &Entry)| {
        let laws = (row.kind == ModelKind::Net).then_some(row.laws.len() as u64);
        let [places, transitions, states, laws] =
            [row.places, row.transitions, row.states, laws].map(number);
        [entry.shown_name(), places, transitions, states, laws, entry.sentence().to_owned()]
    };
    let rows: Vec<_> = answer.models.iter().zip(entries).map(cells).collect();
    let columns = (0..5).map(|column| {
        let widths = rows.iter().map(|row| row[column].chars().count());
        widths.chain([heads[column].len()]).max().unwrap_or(0) + 2
    });
    let room = width.saturating_sub(2 + columns.sum::<usize>()).max(LEAST);
    let mut table = Table::new(vec![heads.iter().map(|&it| Cell::faint(it)).collect()]).left(5);
    for [name, places, transitions, states, laws, description] in rows {
        let numbers = [places, transitions, states, laws].map(Cell::plain);
        let mut cells = vec![Cell::new(name, NAME)];
        cells.extend(numbers);
        cells.push(Cell::faint(cut(&description, room)));
        table.row(cells);
    }
    let mut text = format!("{HEADING}models{HEADING:#}\n{}\n", table.render(width));
    let states =
        "states are those explored while compiling; a family needs a number, as philosophers:5";
    text += &wrapped(states, width, "  ");
    let _ = writeln!(
        text,
        "\nnext: {NAME}cotama models door{NAME:#}, {NAME}cotama models philosophers:5{NAME:#}"
    );
    text
}

/// The beginning of a text, up to the end of a word.
fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    let kept: String = text.chars().take(width).collect();
    let kept = kept.rsplit_once(' ').map_or("", |(kept, _)| kept);
    format!("{}\u{2026}", kept.trim_end_matches([',', ':', ';']))
}

/// All that is known of one model; `net` is it, unless it is a family or a system.
pub(crate) fn one(row: &ModelRow, net: Option<&OwnedNet>, width: usize) -> String {
    let mut text = format!("{NAME}{}{NAME:#}\n", visible(&row.name));
    if !row.description.is_empty() {
        text += &wrapped(&visible(&row.description), width, "  ");
    }
    text.push('\n');
    text += &size(row, width);
    if let Some(net) = net {
        text += &places(net, width);
    }
    text += &signals("events", &row.events, width);
    text += &signals("outputs", &row.outputs, width);
    text += &laws(&row.laws, width);
    text + &next(row)
}

fn size(row: &ModelRow, width: usize) -> String {
    let mut text = String::new();
    if let (Some(places), Some(transitions)) = (row.places, row.transitions) {
        let timed = match row.timed {
            Some(timed @ 1..) => format!(", {timed} with an interval of time"),
            _ => String::new(),
        };
        let _ = writeln!(
            text,
            "  {}, {}{timed}",
            count(places, "place"),
            count(transitions, "transition")
        );
    }
    if let Some(numbers) = row.numbers {
        let (least, most) = (numbers.least, numbers.most);
        let _ = writeln!(
            text,
            "  a net for each number from {least} to {}",
            grouped(&most.to_string())
        );
    }
    match (row.states, row.firings, row.settle) {
        (Some(states), Some(firings), Some(settle)) => {
            let _ = writeln!(
                text,
                "  {} and {} between them, explored while compiling",
                count(states, "state"),
                count(firings, "firing")
            );
            let _ = match settle {
                0 => writeln!(text, "  no transition fires at once by itself"),
                1 => writeln!(text, "  at most 1 transition fires at once by itself"),
                _ => writeln!(
                    text,
                    "  at most {settle} transitions fire at once by themselves, in a row"
                ),
            };
        }
        _ if row.kind != ModelKind::Family => text += "  states: not explored while compiling\n",
        _ => {}
    }
    if !row.components.is_empty() {
        let column = row.components.iter().map(|it| it.name.len()).max().unwrap_or(0);
        let _ = writeln!(
            text,
            "\n{HEADING}nets{HEADING:#}  {FAINT}in the order of their turns{FAINT:#}"
        );
        for component in &row.components {
            text += &described(&component.name, column, NAME, &component.net, width);
        }
    }
    text
}

fn places(net: &OwnedNet, width: usize) -> String {
    let own: Vec<_> =
        net.places.iter().filter(|it| !matches!(it.role, Role::Complement(_))).collect();
    let hidden = net.places.len() - own.len();
    let told = own.iter().take(SHOWN).map(|place| {
        let kind = match place.role {
            Role::Data => ", data",
            Role::Shared => ", of another net",
            Role::Mailbox => ", mailbox",
            Role::State | Role::Complement(_) => "",
        };
        let bound = match place.bound {
            Place::UNBOUNDED => String::new(),
            bound => format!(" of {bound}"),
        };
        (visible(&place.name), format!("{}{bound}{kind}", place.initial), visible(&place.doc))
    });
    let told: Vec<_> = told.collect();
    let widest = |of: fn(&(String, String, String)) -> &String| {
        told.iter().map(|it| of(it).chars().count()).max().unwrap_or(0)
    };
    let (names, tokens) = (widest(|it| &it.0), widest(|it| &it.1));
    let mut text =
        format!("\n{HEADING}places{HEADING:#}  {FAINT}with the tokens at the start{FAINT:#}\n");
    for (name, held, doc) in &told {
        text += &described(name, names, NAME, &format!("{held:<tokens$}  {doc}"), width);
    }
    text += &more(own.len());
    if hidden > 0 {
        let complements = count(hidden as u64, "complement");
        let _ =
            writeln!(text, "  {FAINT}and {complements}: what a place lacks to its bound{FAINT:#}");
    }
    text
}

fn signals(title: &str, signals: &[SignalRow], width: usize) -> String {
    if signals.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{HEADING}{title}{HEADING:#}\n");
    let shown = &signals[..signals.len().min(SHOWN)];
    if shown.iter().all(|it| it.doc.is_empty()) {
        let names: Vec<_> = shown.iter().map(|it| visible(&it.name)).collect();
        text += &wrapped(&names.join(", "), width, "  ");
    } else {
        let column = shown.iter().map(|it| visible(&it.name).chars().count()).max().unwrap_or(0);
        for signal in shown {
            text += &described(&visible(&signal.name), column, NAME, &visible(&signal.doc), width);
        }
    }
    text + &more(signals.len())
}

fn laws(laws: &[LawRow], width: usize) -> String {
    let Some(first) = laws.first() else { return String::new() };
    let (style, shown) = match first.shown {
        Shown::WhileCompiling => (GOOD, "hold in all states, checked while compiling"),
        Shown::LeftToChecker => (NOTICE, "left to the checker"),
        Shown::Claimed => (NOTICE, "claimed, not checked here"),
    };
    let mut text = format!("\n{HEADING}laws{HEADING:#}  {style}{shown}{style:#}\n");
    for law in laws.iter().take(SHOWN) {
        text += &wrapped(&visible(&law.law), width, "  ");
    }
    text + &more(laws.len())
}

fn more(all: usize) -> String {
    if all > SHOWN { format!("  and {} more: see --json\n", all - SHOWN) } else { String::new() }
}

fn next(row: &ModelRow) -> String {
    // Text from standard input is gone.
    let name = crate::names::quoted(&row.name);
    if row.name == "-" || visible(&name) != name {
        return String::new();
    }
    let commands = match row.kind {
        ModelKind::Net | ModelKind::System => {
            vec![format!("simulate {name}"), format!("export {name} --format svg")]
        }
        ModelKind::Family => {
            row.numbers.iter().map(|it| format!("models {name}:{}", it.least)).collect()
        }
    };
    let commands: Vec<_> = commands.iter().map(|it| format!("{NAME}cotama {it}{NAME:#}")).collect();
    format!("\nnext: {}\n", commands.join(", "))
}

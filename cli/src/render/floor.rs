//! The screen of `cotama floor`.

use super::numbers::{count, metres, milli};
use super::style::{BAD, FAINT, HEADING, NAME};
use super::table::{Cell, Table};
use super::{visible, wrapped};
use crate::answers::floor::{Drawn, FloorAnswer, Mapped, PathRow};
use std::fmt::Write;

/// The floor, and the path over it if one was asked for.
pub(crate) fn screen(answer: &FloorAnswer, width: usize) -> String {
    let mut said = format!("{HEADING}{}{HEADING:#}", visible(&answer.name));
    if !answer.title.is_empty() {
        let _ = write!(said, "  {}", visible(&answer.title));
    }
    let _ = writeln!(said, "\n  {} x {}", metres(answer.width_mm), metres(answer.height_mm));
    match (&answer.path, &answer.no_path) {
        (Some(it), _) => path(&mut said, it, width),
        (None, Some(why)) => {
            let _ = writeln!(said, "\n{BAD}no path{BAD:#}");
            said += &wrapped(&visible(why), width, "  ");
        }
        (None, None) => {
            answer.drawing.iter().for_each(|it| drawing(&mut said, it, width));
            answer.map.iter().for_each(|it| map(&mut said, it));
        }
    }
    said
}

fn drawing(said: &mut String, it: &Drawn, width: usize) {
    let parts = [
        count(it.walls as u64, "wall"),
        count(it.glass as u64, "pane") + " of glass",
        count(it.furniture as u64, "piece") + " of furniture",
        format!("{} of them not on the map of a robot", it.uncharted),
        count(it.marks as u64, "QR mark"),
    ];
    *said += &wrapped(&parts.join(", "), width, "  ");
    let _ = writeln!(said, "\n{HEADING}places{HEADING:#} {FAINT}in mm{FAINT:#}");
    let mut table = Table::new(vec![["", "x", "y", ""].map(Cell::faint).to_vec()]);
    for it in &it.places {
        let dock = if it.dock { "docking station" } else { "" };
        table.row(vec![
            Cell::new(visible(&it.name), NAME),
            Cell::plain(it.x_mm.to_string()),
            Cell::plain(it.y_mm.to_string()),
            Cell::faint(dock),
        ]);
    }
    *said += &table.render(width);
    let doors: Vec<_> = it
        .doors
        .iter()
        .map(|it| format!("{} ({})", visible(&it.name), if it.open { "open" } else { "closed" }))
        .collect();
    for (title, names) in
        [("doors", doors), ("zones", it.zones.iter().map(|it| visible(it)).collect())]
    {
        if !names.is_empty() {
            let _ = writeln!(said, "\n{HEADING}{title}{HEADING:#}");
            *said += &wrapped(&names.join(", "), width, "  ");
        }
    }
}

fn map(said: &mut String, it: &Mapped) {
    let cell = format!("{} x {} cells of {} mm", it.columns, it.rows, it.cell_mm);
    let _ = writeln!(said, "  {cell}");
    let _ = writeln!(said, "  {} free, {} occupied, {} unknown", it.free, it.occupied, it.unknown);
}

fn path(said: &mut String, it: &PathRow, width: usize) {
    let _ = writeln!(said, "\n{HEADING}path{HEADING:#}");
    let whole = format!(
        "from {} to {}, for a robot that turns in a disc of {} mm radius: {}",
        visible(&it.from),
        visible(&it.to),
        it.radius_mm,
        milli(it.length_mm.into(), 3, " m")
    );
    *said += &wrapped(&whole, width, "  ");
    if it.zones.is_empty() {
        return;
    }
    let _ = writeln!(said, "\n{HEADING}zones{HEADING:#} {FAINT}on the path, in mm{FAINT:#}");
    let head = ["", "x_start_mm", "x_end_mm"];
    let mut table = Table::new(vec![head.map(Cell::faint).to_vec()]);
    for it in &it.zones {
        table.row(vec![
            Cell::new(visible(&it.zone), NAME),
            Cell::plain(it.x_start_mm.to_string()),
            Cell::plain(it.x_end_mm.to_string()),
        ]);
    }
    *said += &table.render(width);
}

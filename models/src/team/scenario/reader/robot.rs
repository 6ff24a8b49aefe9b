//! Reading a robot of a team: its file, its skills, when it is there, and how it fails.

use super::super::worker::unfit;
use super::{AMOUNTS, FORMAT, Names, new_name, skills};
use crate::missions::reader::fields::{Fields, Reported, Sink, document_of_either};
use crate::missions::{Diagnostic, Spanned};
use crate::names::quoted;
use crate::robots::{EMBEDDED, RobotFile};
use crate::team::scenario::{MAX_ROBOTS, RobotSpec, Row, Scenario, Stay, Supply, usual};
use cotama_core::units::MillimetresPerSecond;

/// The files that robots of a team can name, each looked at once.
pub(super) struct Files<'f> {
    given: &'f [RobotFile],
    known: Vec<(String, Result<RobotFile, &'static str>)>,
}

impl<'f> Files<'f> {
    pub(super) const fn new(given: &'f [RobotFile]) -> Self {
        Self { given, known: Vec::new() }
    }

    /// The robot of a name; `None` where there is no such file.
    fn named(&mut self, name: &str) -> Option<Result<RobotFile, &'static str>> {
        if let Some(it) = self.known.iter().find(|it| it.0 == name) {
            return Some(it.1.clone());
        }
        let given = self.given.iter().find(|it| it.source() == name).cloned();
        let file = given.or_else(|| RobotFile::shipped(name))?;
        let read = unfit(file.robot()).map_or(Ok(file), Err);
        self.known.push((name.to_owned(), read.clone()));
        Some(read)
    }
}

impl Scenario {
    /// Returns the names of the robot files that a team's file names, each once; names that cannot
    /// be read are left out, as the reader reports them.
    ///
    /// ```
    /// use cotama_models::team::scenario::Scenario;
    /// let text = "format = 'cotama-team/1'\nrobot = [{ name = 'a', file = 'lift.toml' }]\n";
    /// assert_eq!(Scenario::files_of(text), ["lift.toml"]);
    /// ```
    pub fn files_of(text: &str) -> Vec<String> {
        let read = document_of_either(text, &Sink::default(), FORMAT, |mut fields| {
            let mut names: Vec<String> = Vec::new();
            for mut robot in fields.tables_up_to("robot", false, MAX_ROBOTS)? {
                let file = robot.optional_text("file").ok().flatten().map(|it| it.value);
                names.extend(file.filter(|it| !names.contains(it)));
            }
            Some(names)
        });
        read.unwrap_or_default()
    }
}

pub(super) fn robot(
    mut fields: Fields<'_>,
    names: &mut Names,
    files: &mut Files<'_>,
) -> Option<RobotSpec> {
    let name = new_name(&mut fields, "robot", &mut names.robots);
    let file = file(&mut fields, files);
    names.files.push(file.clone());
    let at = fields.text("at");
    let start = names.places.place(&fields, at.as_ref());
    let skills = skills(&mut fields, names);
    let stay = stay(&mut fields);
    let supply = supply(&mut fields, names, file.as_ref());
    fields.finish();
    let (skills, fails) = skills?;
    let (file, start, stay, supply) = (file?, start?, stay?, supply.ok()?);
    Some(RobotSpec { name: name?, file, skills, fails, start, stay, supply })
}

/// The file of a robot: the usual one where it names none.
fn file(fields: &mut Fields<'_>, files: &mut Files<'_>) -> Option<RobotFile> {
    let Some(name) = fields.optional_text("file").ok()? else { return Some(usual()) };
    match files.named(&name.value) {
        Some(Ok(file)) => Some(file),
        Some(Err(why)) => {
            let message = format!("{} cannot be part of a team: {why}", quoted(&name.value));
            let help = "name a robot that has a `[body]`, and drives by itself";
            fields.report(Diagnostic::new(name.span, message, "not for a team").help(help));
            None
        }
        None => {
            fields.index_of(&name, "robot", EMBEDDED.iter().map(|it| it.name));
            None
        }
    }
}

/// The battery of a robot, which its file must have.
fn supply(
    fields: &mut Fields<'_>,
    names: &Names,
    file: Option<&RobotFile>,
) -> Result<Option<Supply>, Reported> {
    let span = fields.span_of("battery");
    let Some(mut own) = fields.optional_table("battery")? else { return Ok(None) };
    let charge = own.optional_integer("charge_permille", 1..=1_000);
    let reserve = own.optional_integer("reserve_permille", 0..=500);
    let home = own.text("home");
    let home = names.places.place(&own, home.as_ref());
    let charger = own.integer("charger_w", 1..=100_000);
    own.finish();
    let body = file.and_then(|it| it.robot().body.as_ref()).ok_or(Reported)?;
    let refuse = |message: String, label: &str, help: &str| {
        fields.report(Diagnostic::new(span.clone(), message, label).help(help));
    };
    if body.battery.is_none() {
        let help = "add `[body.battery]` to its file, or leave `battery` out here";
        refuse("the file of this robot has no battery".to_owned(), "no battery", help);
        return Err(Reported);
    }
    let charger_w: u32 = charger.ok_or(Reported)?;
    let stands = body.motion_power.at(MillimetresPerSecond(0)).0;
    if u64::from(charger_w) * 1_000 <= stands {
        let message = format!("the robot draws {stands} mW while it stands, so it is never full");
        refuse(message, "too weak", "give `charger_w` of a stronger charger");
        return Err(Reported);
    }
    Ok(Some(Supply {
        charge_permille: charge?.unwrap_or(1_000),
        reserve_permille: reserve?.unwrap_or(10),
        home: home.ok_or(Reported)?,
        charger_w,
    }))
}

/// When a robot joins the team, and when it leaves.
fn stay(fields: &mut Fields<'_>) -> Option<Stay> {
    let joins = fields.optional_integer("joins_ms", AMOUNTS);
    let leaves = fields.optional_integer("leaves_ms", AMOUNTS);
    let stay = Stay { joins_ms: joins.ok()?.unwrap_or(0), leaves_ms: leaves.ok()? };
    if stay.leaves_ms.is_some_and(|it| it <= stay.joins_ms) {
        let message = "the robot leaves before it joins";
        let help = "let `leaves_ms` be more than `joins_ms`, which is 0 if left out";
        let span = fields.span_of("leaves_ms");
        fields.report(Diagnostic::new(span, message, "too early").help(help));
        return None;
    }
    Some(stay)
}

/// The failure mode of a fault of this robot. Of a robot that is not known, or whose file is not,
/// nothing more is said.
pub(super) fn row(fields: &mut Fields<'_>, names: &Names, robot: Option<usize>) -> Option<Row> {
    let mode = fields.text("mode")?;
    let file = names.files.get(robot?)?.as_ref()?;
    mode_of(fields, &mode, file)
}

/// The failure mode of a fault of the auctioneer: whichever robot that is, its file has it.
pub(super) fn shared_row(fields: &mut Fields<'_>, names: &Names) -> Option<Row> {
    let mode = fields.text("mode")?;
    let files: Vec<_> = names.files.iter().flatten().collect();
    let rows: Option<Vec<_>> = files.iter().map(|it| mode_of(fields, &mode, it)).collect();
    rows?.first().copied()
}

fn mode_of(fields: &Fields<'_>, mode: &Spanned<String>, file: &RobotFile) -> Option<Row> {
    let robot = file.robot();
    let known = Row::all(robot).map(|it| it.name(robot));
    fields.index_of(mode, "failure mode", known).map(Row::new)
}

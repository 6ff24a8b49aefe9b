//! The roots of what the decisional level consists of: the supervisors of a robot, its tables, the
//! diagnosis, and reactions that change no configuration.
//!
//! Tables come as their caller can make them at worst: of any length, with numbers of nothing.

use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::{RestoreError, Snapshot};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::level::{
    Act, Adapted, Cause, Failure, Global, Mode, Rows, Tables, Told, Where, diagnose,
};
use cotama_printed::{Careful, Level, TABLES, at_rest, system};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_level_new() -> Level<Careful> {
    at_rest(Careful::default())
}

#[unsafe(no_mangle)]
fn root_level_trusting_new() -> Level<system::Program> {
    at_rest(system::Program)
}

#[unsafe(no_mangle)]
fn root_level_snapshot(level: &Level<Careful>, bytes: &mut [u8]) -> Option<usize> {
    level.snapshot().write(bytes).map(<[u8]>::len)
}

#[unsafe(no_mangle)]
fn root_level_restore(bytes: &[u8], now: Millis) -> Option<Result<Level<Careful>, RestoreError>> {
    Some(Level::restore(&TABLES, Careful::default(), now, &Snapshot::read(bytes)?))
}

#[unsafe(no_mangle)]
fn root_level_round(level: &mut Level<Careful>, now: Millis) {
    level.round(now, &mut ());
}

#[unsafe(no_mangle)]
fn root_level_tell(level: &mut Level<Careful>, now: Millis, told: Told, cause: Cause) -> bool {
    level.tell(now, told, cause, &mut ())
}

#[unsafe(no_mangle)]
fn root_level_read(level: &Level<Careful>) -> (Where, Global, u32, [bool; 2], Millis) {
    let asked = [level.permits(), level.is_halted()];
    (level.place(), level.global(), level.lost(), asked, level.player().now())
}

#[unsafe(no_mangle)]
fn root_level_tables(level: &Level<Careful>) -> &'static Tables<'static> {
    level.tables()
}

#[unsafe(no_mangle)]
fn root_tables_seen(of: &Tables<'_>, works: u64, up: u64) -> (u32, u64) {
    (of.broken(works), of.shown(up))
}

#[unsafe(no_mangle)]
fn root_tables_event(of: &Tables<'_>, told: Told) -> Option<Of<EventId>> {
    of.event(told)
}

#[unsafe(no_mangle)]
fn root_told_numbers(told: Told, kind: u8, number: usize) -> ((u8, usize), Option<Told>) {
    (told.to_numbers(), Told::from_numbers(kind, number))
}

#[unsafe(no_mangle)]
fn root_tables_acts(of: &Tables<'_>, on: Of<TransitionId>) -> (usize, Option<Act>) {
    (of.acts(on).count(), of.acts(on).next())
}

#[unsafe(no_mangle)]
fn root_tables_mode(of: &Tables<'_>, at: Where, next: Where) -> (Option<Mode>, bool) {
    (of.mode(at), at.is_left_for(next))
}

#[unsafe(no_mangle)]
fn root_diagnose(failures: &[Failure], up: u64, raised: u64) -> Rows {
    diagnose(failures, up, raised)
}

#[unsafe(no_mangle)]
fn root_rows_read(of: &Rows, row: usize) -> (bool, u32, bool) {
    (of.is_empty(), of.count(), of.has(row))
}

#[unsafe(no_mangle)]
fn root_rows_worst_first(of: &Rows, failures: &[Failure]) -> Option<usize> {
    of.worst_first(failures).last()
}

#[unsafe(no_mangle)]
fn root_adapted_new() -> Adapted {
    Adapted::default()
}

#[unsafe(no_mangle)]
fn root_adapted_set(adapted: &mut Adapted, report: usize, now: Millis) {
    adapted.set(report, now);
}

#[unsafe(no_mangle)]
fn root_adapted_see(adapted: &mut Adapted, shown: u64, broken: u32, now: Millis) {
    adapted.see(shown, broken, now);
}

#[unsafe(no_mangle)]
fn root_adapted_speed(of: &Adapted, tables: &Tables<'_>, now: Millis, mode: Mode) -> [u16; 2] {
    [of.speed(tables, now, Some(mode)), of.lasting_speed(tables)]
}

#[unsafe(no_mangle)]
fn root_adapted_holding(of: &Adapted, tables: &Tables<'_>, now: Millis) -> u64 {
    of.holding(tables, now)
}

#[unsafe(no_mangle)]
fn root_adapted_ends_at(of: &Adapted, tables: &Tables<'_>, shown: u64, now: Millis) -> Millis {
    of.ends_at(tables, shown, now).min(of.returns_at()).unwrap_or(now)
}

#[unsafe(no_mangle)]
fn root_adapted_back(of: &mut Adapted, tables: &Tables<'_>, known: u32, now: Millis) -> u32 {
    of.back(tables, known, now)
}

#[unsafe(no_mangle)]
fn root_adapted_is_back(of: &mut Adapted, loss: usize) {
    of.is_back(loss);
}

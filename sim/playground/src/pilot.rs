//! A robot at work: its decider beside its supervisors, period by period.

use super::answer;
use super::board::{Board, Refused};
use super::coded::decode;
use super::tables::decode_tables;
use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use cotama_core::net::{EventId, PlaceId};
use cotama_core::player::{Firing, Loaded, Names, Observer, Packed};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;
use cotama_models::level::{
    Cause, Decider, Drive, Global, Level, Mode, Perceived, Round, Rows, Tables, Told, Where,
};
use cotama_play::Numbered;

/// The size of the player, as a simulated robot has it at most.
const WORDS: usize = 64;
const SLOTS: usize = 256;
/// So many periods are played anew at most to go back.
const KEPT_EACH: usize = 64;

type Program = Loaded<'static, WORDS, 0, SLOTS>;
pub(super) type Played = Decider<'static, Program, WORDS, 0, SLOTS>;

/// All that there is for the robot to see in a period, and the word that is said to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// The flags that are up, a bit each.
    pub up: u64,
    /// The modules that say that they work, a bit each.
    pub works: u64,
    /// The word of the operator or of the mission.
    pub said: Option<Told>,
    /// A failure, by its number, that the planner tells: no flag shows it.
    pub planned: Option<usize>,
    /// State of the drive.
    pub drive: Drive,
}

/// The decisional level of a robot, in the periods of a [`Board`] in rounds: what it tells its
/// supervisors is told to the board, so a run of it is a run of the net that is checked.
pub struct Pilot {
    tables: &'static Tables<'static>,
    system: &'static System<'static>,
    decider: Played,
    periods: Vec<(Millis, Seen)>,
    at: usize,
    kept: Vec<Played>,
}

impl Pilot {
    /// The decider of these tables, with the supervisors of the same robot.
    ///
    /// The memory is never given back.
    ///
    /// # Errors
    /// Why it cannot work, in words.
    pub fn of(tables: &[u8], system: &[u8]) -> Result<Self, String> {
        let tables: &'static _ =
            Box::leak(Box::new(decode_tables(tables).map_err(|it| it.to_string())?));
        let system: &'static _ =
            Box::leak(Box::new(decode(system).map_err(|it| it.to_string())?.leak()));
        let packed = Packed::<WORDS, 0, SLOTS>::of(system);
        let packed: &'static _ = Box::leak(Box::new(packed.map_err(|it| it.to_string())?));
        let decider = Decider::new(Level::start(tables, packed.load(system)));
        let kept = Vec::from([decider]);
        Ok(Self { tables, system, decider, periods: Vec::new(), at: 0, kept })
    }

    /// A period at this time, which the board plays too. Answers with the failures that new flags
    /// are taken for; the event that the supervisors were told, after 1, 0 for none;
    /// kind and number of what they accepted, each after 1, or zeros; the modules that are started
    /// anew; and the records.
    ///
    /// # Errors
    /// Why nothing was done.
    pub fn period(
        &mut self,
        board: &mut Board,
        at: Millis,
        seen: Seen,
    ) -> Result<Vec<u32>, Refused> {
        let before = self.decider;
        let mut outside = Outside { numbered: board.session().numbered(), told: None };
        let (rows, round) = worked(&mut self.decider, at, seen, &mut outside);
        let event = outside.told;
        let records = board.tell(event, at).inspect_err(|_| self.decider = before)?;
        self.periods.truncate(self.at);
        self.kept.truncate(self.at / KEPT_EACH + 1);
        self.periods.push((at, seen));
        self.at += 1;
        if self.at.is_multiple_of(KEPT_EACH) {
            self.kept.push(self.decider);
        }
        let mut out = Vec::new();
        let rows = rows.worst_first(self.tables.failures).map(|it| [it as u32]);
        answer::list(&mut out, rows);
        out.push(event.map_or(0, |it| it.0 + 1));
        let (kind, number) = round.told.map_or((0, 0), |it| {
            let (kind, number) = it.to_numbers();
            (u32::from(kind) + 1, number as u32 + 1)
        });
        out.extend([kind, number]);
        halves(&mut out, round.restarts);
        out.extend(answer::records(&records));
        Ok(out)
    }

    /// The same by numbers: flags that are up, modules that work, the time; what is said, as its
    /// kind times 256, and its number, and 1, or 0; what the planner tells, after 1, or 0.
    ///
    /// # Errors
    /// Why nothing was done.
    pub fn period_number(
        &mut self,
        board: &mut Board,
        [up, works, at]: [u64; 3],
        [said, planned]: [u32; 2],
        stands: bool,
    ) -> Result<Vec<u32>, Refused> {
        let told = |it: u32| Told::from_numbers((it >> 8) as u8, (it & 0xff) as usize);
        let said = match said.checked_sub(1) {
            None => None,
            Some(it) => Some(told(it).ok_or(Refused::Unknown)?),
        };
        let planned = planned.checked_sub(1).map(|it| it as usize);
        let seen = Seen { up, works, said, planned, drive: Drive { at_goal: false, stands } };
        self.period(board, Millis(at), seen)
    }

    /// The decider before its first period.
    pub(super) fn begins(&self) -> Played {
        self.kept.first().copied().unwrap_or(self.decider)
    }

    /// The tables of its robot.
    pub(super) const fn tables(&self) -> &'static Tables<'static> {
        self.tables
    }

    /// Returns the decider of motion where the robot is; `None` where nothing runs.
    pub(super) fn mode(&self, at: Where) -> Option<Mode> {
        self.tables.mode(at)
    }

    /// True if the robot may move where it is in its drive.
    pub(super) fn moves(&self, at: Where) -> bool {
        let runs = at.configuration().and_then(|it| self.tables.configurations.get(it));
        runs.is_some_and(|it| it.speed.0 > 0)
    }

    /// Goes to after so many periods.
    pub fn go(&mut self, to: usize) {
        let to = to.min(self.periods.len());
        let kept = (to / KEPT_EACH).min(self.kept.len().saturating_sub(1));
        if let Some(saved) = self.kept.get(kept) {
            self.decider = *saved;
        }
        for (at, seen) in self.periods.get(kept * KEPT_EACH..to).unwrap_or_default() {
            worked(&mut self.decider, *at, *seen, &mut ());
        }
        self.at = to;
    }

    /// Returns where the robot is and what is requested: kind, sub-objective and configuration of
    /// its place; kind and number of the place of its global supervisor; known losses; flags that
    /// are up; configuration after 1; whether it may drive, and how fast; settings that hold;
    /// whether it halts, asks, alarms; whether it listens; whether the board is where it is.
    pub fn state(&self, board: &Board) -> Vec<u32> {
        let level = self.decider.level();
        let requests = self.decider.requests(board.session().now());
        let mut out = Vec::from(match level.place() {
            Where::Rests => [0, 0, 0],
            Where::Waits => [1, 0, 0],
            Where::Runs { sub_objective, configuration } => {
                [2, sub_objective as u32, configuration as u32]
            }
        });
        out.extend(match level.global() {
            Global::Waits => [0, 0],
            Global::Does(it) => [1, it as u32],
            Global::Done => [2, 0],
            Global::Secures => [3, 0],
            Global::Safe => [4, 0],
        });
        out.push(level.lost());
        halves(&mut out, self.decider.up());
        out.push(requests.configuration.map_or(0, |it| it as u32 + 1));
        out.extend([
            u32::from(requests.drive),
            u32::try_from(requests.speed.0).unwrap_or(u32::MAX),
        ]);
        halves(&mut out, requests.settings);
        out.extend([requests.halt, requests.ask, requests.alarm].map(u32::from));
        out.push(u32::from(self.decider.listens()));
        out.push(u32::from(self.agrees(board)));
        out
    }

    /// True if all places of the supervisors hold what those of the board hold.
    fn agrees(&self, board: &Board) -> bool {
        let (numbered, marking) = (board.session().numbered(), board.session().marking());
        let player = self.decider.level().player();
        let same = |of: Of<PlaceId>, numbered: &Numbered| {
            let board = numbered.place(of).and_then(|it| marking.get(it.0 as usize));
            board.is_none_or(|it| *it == player.tokens(of))
        };
        self.system.components.iter().zip(0_u16..).all(|(it, component)| {
            (0..it.net.places.len() as u32)
                .all(|id| same(Of { component, id: PlaceId(id) }, numbered))
        })
    }
}

/// A period: returns the failures that new flags are taken for, and the outcome of the round.
pub(super) fn worked(
    decider: &mut Played,
    at: Millis,
    seen: Seen,
    observer: &mut impl Observer<Program, Cause>,
) -> (Rows, Round) {
    let up = decider.up();
    let perceived = Perceived { raised: seen.up & !up, lowered: up & !seen.up, works: seen.works };
    let rows = decider.perceive(at, perceived);
    seen.planned.into_iter().for_each(|row| decider.report(row, Cause(0)));
    (rows, decider.period(at, seen.said, seen.drive, observer))
}

/// Hears what the supervisors are told from outside, whether they use it or not.
struct Outside<'n> {
    numbered: &'n Numbered,
    told: Option<EventId>,
}

impl Outside<'_> {
    fn hear(&mut self, event: Of<EventId>) {
        self.told = self.numbered.event(event).or(self.told);
    }
}

impl<P: Names> Observer<P, Cause> for Outside<'_> {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        firing.on.into_iter().for_each(|it| self.hear(it));
    }

    fn on_ignore(&mut self, event: Of<EventId>, _: Cause) {
        self.hear(event);
    }
}

/// A number of 64 bits, the lower half first.
fn halves(out: &mut Vec<u32>, it: u64) {
    out.extend([it as u32, (it >> 32) as u32]);
}

#[cfg(test)]
mod tests {
    use super::{Pilot, Seen};
    use crate::{Board, encode, encode_tables};
    use cotama_core::units::Millis;
    use cotama_models::level::{Drive, Told, Where};
    use cotama_models::robots::{EMBEDDED, OwnedTables, Robot, supervisors};
    use std::vec::Vec;

    fn robot(name: &str) -> (Robot, Board, Pilot) {
        let robot = Robot::shipped(name).unwrap();
        let system = supervisors::system(&robot);
        let tables = OwnedTables::of(&robot, &[], &system);
        let bytes = system.with(encode);
        let pilot = Pilot::of(&encode_tables(&tables.view()), &bytes).unwrap();
        (robot, Board::of(&bytes, true).unwrap(), pilot)
    }

    fn seen(up: u64, said: Option<Told>, stands: bool) -> Seen {
        let planned = None;
        Seen { up, works: u64::MAX, said, planned, drive: Drive { at_goal: false, stands } }
    }

    #[test]
    fn a_lost_sonar_is_diagnosed_told_and_answered_by_another_configuration() {
        let (robot, mut board, mut pilot) = robot("p3dx-delivery");
        let son1 = robot.failure("SON1").unwrap();
        let up = robot.failures[son1].flags.iter().fold(0, |all, it| all | 1 << it);
        let said = [Some(Told::Begins), None, Some(Told::Reached(0)), None, None, None];
        let mut found = Vec::new();
        for (said, at) in said.into_iter().zip(1_u64..) {
            let up = if at > 3 { up } else { 0 };
            let account = pilot.period(&mut board, Millis(100 * at), seen(up, said, at < 4));
            found.extend_from_slice(&account.unwrap()[..2]);
        }
        // Only the fourth period finds something: one failure, this one.
        assert_eq!(found[6..8], [1, son1 as u32]);
        let Where::Runs { configuration, .. } = pilot.decider.level().place() else { panic!() };
        assert_eq!(robot.configurations[configuration].name, "PF.DEG");
    }

    #[test]
    fn decider_and_board_stay_together_forth_and_back() {
        for it in EMBEDDED {
            let (robot, mut board, mut pilot) = robot(it.name);
            let mut states = Vec::from([pilot.state(&board)]);
            for step in 1..300_u64 {
                let up =
                    (step / 7 % 5 == 0).then_some(1 << (step / 35 % robot.flags().count() as u64));
                let said = match step % 11 {
                    1 => Some(Told::Begins),
                    4 => Some(Told::Reached(step as usize / 11 % robot.sub_objectives.len())),
                    7 => Some(Told::Chooses(step as usize / 11 % robot.sub_objectives.len())),
                    9 => Some(Told::Done(step as usize / 11 % robot.sub_objectives.len())),
                    _ => None,
                };
                let seen = seen(up.unwrap_or(0), said, step % 3 == 0);
                pilot.period(&mut board, Millis(100 * step), seen).unwrap();
                states.push(pilot.state(&board));
                assert_eq!(states.last().unwrap().last(), Some(&1), "{} {step}", it.name);
            }
            for to in (0..300_usize).map(|it| it * 131 % 300) {
                board.go(to);
                pilot.go(to);
                assert_eq!(pilot.state(&board), states[to], "{} after {to}", it.name);
            }
        }
    }
}

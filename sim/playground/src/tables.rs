//! The tables of a robot's decider as bytes.

use super::coded::{Coded, Damaged, closed, fields, opened};
use alloc::vec::Vec;
use cotama_core::units::{MillimetresPerSecond, Millis};
use cotama_models::level::{
    Act, Acting, Configuration, Failure, Loss, Mask, Mode, Report, Setting, Step, SubObjective,
    Tables,
};
use cotama_models::severity::{Persistence, Severity};

/// Writes the tables of a robot.
pub fn encode_tables(tables: &Tables<'_>) -> Vec<u8> {
    let mut to = Vec::new();
    let it = tables;
    (it.begins, it.stopped).write(&mut to);
    it.gives_up.write(&mut to);
    (it.before, it.done).write(&mut to);
    (it.secures, it.safe).write(&mut to);
    (it.waits, (it.granted, it.destroyed)).write(&mut to);
    (it.steps.to_vec(), it.sub_objectives.to_vec()).write(&mut to);
    (it.configurations.to_vec(), it.losses.to_vec()).write(&mut to);
    (it.reports.to_vec(), it.failures.to_vec()).write(&mut to);
    (it.masks.to_vec(), it.acting.to_vec()).write(&mut to);
    closed(to)
}

/// Reads tables, for as long as the program runs.
///
/// # Errors
/// [`Damaged`] when they are not what [`encode_tables`] wrote.
pub fn decode_tables(bytes: &[u8]) -> Result<Tables<'static>, Damaged> {
    let from = &mut opened(bytes)?;
    let (begins, stopped) = Coded::read(from)?;
    let gives_up = Coded::read(from)?;
    let (before, done) = Coded::read(from)?;
    let (secures, safe) = Coded::read(from)?;
    let (waits, (granted, destroyed)) = Coded::read(from)?;
    let (steps, sub_objectives): (Vec<Step>, Vec<SubObjective>) = Coded::read(from)?;
    let (configurations, losses): (Vec<Configuration>, Vec<Loss>) = Coded::read(from)?;
    let (reports, failures): (Vec<Report>, Vec<Failure>) = Coded::read(from)?;
    let (masks, acting): (Vec<Mask>, Vec<Acting>) = Coded::read(from)?;
    if !from.is_empty() {
        return Err(Damaged);
    }
    Ok(Tables {
        begins,
        stopped,
        gives_up,
        before,
        done,
        secures,
        safe,
        waits,
        granted,
        destroyed,
        steps: steps.leak(),
        sub_objectives: sub_objectives.leak(),
        configurations: configurations.leak(),
        losses: losses.leak(),
        reports: reports.leak(),
        failures: failures.leak(),
        masks: masks.leak(),
        acting: acting.leak(),
    })
}

fields!(Millis { 0 });
fields!(MillimetresPerSecond { 0 });
fields!(Step { place, over });
fields!(SubObjective { place, mode, moves, reached, operator });
fields!(Configuration { place, sub_objective, speed });
fields!(Loss { place, modules, back });
fields!(Report { event, sets });
fields!(Setting { speed, mode, holds, mends });
fields!(Failure { flags, sometimes, report, worst, persistence });
fields!(Mask { report, loss, flags, lasts, on_order });
fields!(Acting { transition, act });

/// A choice is the number of its case.
macro_rules! cases {
    ($type:ident { $($case:ident = $number:literal),* }) => {
        impl Coded for $type {
            fn write(&self, to: &mut Vec<u8>) {
                to.push(match self { $(Self::$case => $number),* });
            }

            fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
                match u8::read(from)? {
                    $($number => Ok(Self::$case),)*
                    _ => Err(Damaged),
                }
            }
        }
    };
}

cases!(Mode { Autonomous = 0, Operator = 1 });
cases!(Severity { Weak = 0, Medium = 1, Hard = 2, Fatal = 3 });
cases!(Persistence { Transient = 0, Intermittent = 1, Permanent = 2 });

impl Coded for Act {
    fn write(&self, to: &mut Vec<u8>) {
        let (kind, number) = match *self {
            Self::Restart(it) => (0, it),
            Self::Set(it) => (1, it),
            Self::Ask(it) => (2, it),
            Self::Hide(it) => (3, it),
        };
        to.extend([kind, number]);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let (kind, number): (u8, u8) = Coded::read(from)?;
        match kind {
            0 => Ok(Self::Restart(number)),
            1 => Ok(Self::Set(number)),
            2 => Ok(Self::Ask(number)),
            3 => Ok(Self::Hide(number)),
            _ => Err(Damaged),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{decode_tables, encode_tables};
    use cotama_models::robots::{EMBEDDED, OwnedTables, Robot, supervisors};

    #[test]
    fn tables_of_shipped_robots_are_read_as_they_were_written() {
        for it in EMBEDDED {
            let robot = Robot::shipped(it.name).unwrap();
            let tables = OwnedTables::of(&robot, &[], &supervisors::system(&robot));
            let bytes = encode_tables(&tables.view());
            assert_eq!(decode_tables(&bytes), Ok(tables.view()), "{}", it.name);
            assert!(decode_tables(&bytes[1..]).is_err());
        }
    }
}

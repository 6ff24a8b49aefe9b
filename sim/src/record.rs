//! The recorder of a run's events.

use crate::trace::Record;

/// Takes the records of a run, in the order of time.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::record::Recorder;
/// use cotama_sim::{options::Options, setup::Simulation, trace::Record};
/// #[derive(Default)]
/// struct Plans(Vec<String>);
/// impl Recorder for Plans {
///     const WANTED: bool = true;
///     fn record(&mut self, record: Record) {
///         if let Record::Plan(plan) = record {
///             self.0.push(plan.cause);
///         }
///     }
/// }
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let (simulation, mut plans) =
///     (Simulation::new(&mission, &Options::default()).unwrap(), Plans::default());
/// simulation.run_recorded(0, &mut plans).unwrap();
/// assert_eq!(plans.0[1..3], ["energy margin below zero", "one laser lost"]);
/// ```
pub trait Recorder {
    /// Whether records are wanted at all; if not, none is made.
    const WANTED: bool;

    /// Takes a record.
    fn record(&mut self, record: Record);
}

/// Takes nothing, and costs nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Recorder for Silent {
    const WANTED: bool = false;

    fn record(&mut self, _: Record) {}
}

/// Keeps all records.
impl Recorder for Vec<Record> {
    const WANTED: bool = true;

    fn record(&mut self, record: Record) {
        debug_assert!(self.last().is_none_or(|it| it.t_us() <= record.t_us()), "time goes back");
        self.push(record);
    }
}

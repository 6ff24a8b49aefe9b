//! Defects planted on purpose, so that it can be measured what finds them.

use cotama_core::units::Millis;
use cotama_models::cotama::FailureMode;

/// A defect of observers, of the use of the allocator, or of the simulated robot.
///
/// ```
/// use cotama_core::units::{Millimetres, Millis};
/// use cotama_models::cotama::FailureMode::Son2;
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::supervised::{Injection, Planted, Script, Supervised, When};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let injections = vec![Injection::new(When::Place(Millimetres(5_000)), Son2)];
/// let script = Script { injections, ..Script::default() };
/// let late = Planted::Late(Son2, Millis(20_000));
/// let blind = Supervised::new(&mission).unwrap().with_planted(vec![late]);
/// assert_eq!(blind.run(&script).unwrap().unseen, Millis(20_000));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planted {
    /// No observer sees this failure.
    Unseen(FailureMode),
    /// No observer sees the second failure while the first is under way.
    UnseenWhile(FailureMode, FailureMode),
    /// Observers see this failure so much later than its row of the FMECA says.
    Late(FailureMode, Millis),
    /// Plans are made with modules that are lost.
    PlansWithLost,
    /// The robot creeps on when it is to stand for good.
    Creeps,
}

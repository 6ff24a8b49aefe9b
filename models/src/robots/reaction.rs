//! The reaction of a row: what is tried in which order, and then what severity and availability
//! say.

use super::{Configuration, Failure, Mode, Robot};
use crate::severity::Severity;
use cotama_core::units::Millis;

/// A reaction that is tried before severity and availability decide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Try {
    /// A module is started anew ([`Failure::restarts`]).
    Restart,
    /// A setting alone is the answer ([`Failure::sets`]).
    Set,
    /// The operator is asked ([`Failure::asks`]).
    Ask,
}

/// Flags that are not diagnosed any more once a failure is known which holds them up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// The flags, by their position in the flags of all observers in order.
    pub flags: Vec<usize>,
    /// How long; `None` to the end of the mission.
    pub lasts: Option<Millis>,
    /// Whether it is made when the operator, who was asked, chooses to go on; else when the
    /// failure is told.
    pub on_order: bool,
}

impl Mask {
    /// Returns the mask in words, for example ``mask `bumper` on his order``.
    pub fn text(&self, robot: &Robot) -> String {
        let names = robot.flags().enumerate().filter(|it| self.flags.contains(&it.0));
        let names: Vec<_> = names.map(|it| format!("`{}`", it.1.1)).collect();
        let on_order = if self.on_order { " on his order" } else { "" };
        let lasts = self.lasts.map_or_else(String::new, |it| match (it.0 / 1_000, it.0 % 1_000) {
            (s, 0) => format!(" for {s} s"),
            _ => format!(" for {} ms", it.0),
        });
        format!("mask {}{on_order}{lasts}", names.join(", "))
    }
}

impl Failure {
    /// Returns the reaction in words where the robot drives itself, step after step.
    ///
    /// ```
    /// use cotama_models::robots::Robot;
    /// let robot = Robot::shipped("transport").unwrap();
    /// let lidar = &robot.failures[robot.failure("LID1").unwrap()];
    /// assert_eq!(lidar.reaction(&robot), "start scan anew once; then another configuration");
    /// ```
    pub fn reaction(&self, robot: &Robot) -> String {
        let mut steps: Vec<_> = self.tries.iter().filter_map(|it| self.step(*it, robot)).collect();
        steps.extend(self.sets.as_ref().filter(|it| it.times.is_none()).map(|it| {
            format!("set {}; ", it.text(robot)) // beside what is decided
        }));
        let mask = self.masks.as_ref().map(|it| format!("; {}", it.text(robot)));
        format!("{}{}{}", steps.concat(), self.decided(robot), mask.unwrap_or_default())
    }

    /// A step that is tried, in words.
    fn step(&self, it: Try, robot: &Robot) -> Option<String> {
        let often = |times: u8| match times {
            1 => "once".to_owned(),
            times => format!("{times} times"),
        };
        Some(match it {
            Try::Restart => {
                let it = self.restarts?;
                let module = robot.modules.get(it.module).map_or("", |it| it.name.as_str());
                format!("start {module} anew {}; then ", often(it.times))
            }
            Try::Set => {
                let it = self.sets.as_ref()?;
                format!("set {} {}; then ", it.text(robot), often(it.times?))
            }
            Try::Ask => format!("stop, ask the operator {}; then ", often(self.asks?)),
        })
    }

    /// The decision by severity and availability, in words.
    fn decided(&self, robot: &Robot) -> &'static str {
        let left = robot.usable(self.loses);
        let takes = |it: &Configuration| {
            let of = robot.sub_objectives.get(it.sub_objective);
            it.required & !left != 0 && of.is_some_and(|it| it.mode == Mode::Autonomous)
        };
        match self.autonomous {
            Severity::Weak | Severity::Medium if !robot.configurations.iter().any(takes) => {
                "record"
            }
            Severity::Weak | Severity::Medium => "another configuration",
            Severity::Hard => "stop, ask the operator",
            Severity::Fatal => "end the mission",
        }
    }
}

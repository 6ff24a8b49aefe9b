//! Parameters of modules, and the settings that answer failures.

use super::{Mode, Robot};
use cotama_core::units::{Micros, Millis};
use std::ops::RangeInclusive;

/// A parameter of a module: a number that can be set while it runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Name of the parameter.
    pub name: String,
    /// The parameter in a few words; may be empty.
    pub title: String,
    /// Value where nothing has failed.
    pub default: u64,
    /// The values that it can have.
    pub range: RangeInclusive<u64>,
    /// The execution time that each unit of it adds.
    pub cost: Micros,
}

/// A reaction that changes no configuration: a setting, as long as the failure shows itself and a
/// while after. With `times` it comes before any other reaction, so many times in a mission;
/// without it, beside what severity and availability say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// New values of parameters.
    pub values: Vec<Value>,
    /// How much it leaves of the speed, in thousandths.
    pub speed: u16,
    /// The mode in which it leaves less of the speed; `None` for both.
    pub mode: Option<Mode>,
    /// How long it outlasts the failure.
    pub holds: Millis,
    /// Whether the failure is over by it.
    pub mends: bool,
    /// How often the failure is answered by it alone.
    pub times: Option<u8>,
}

/// A new value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Value {
    /// The module.
    pub module: usize,
    /// The parameter, by its position in the module.
    pub parameter: usize,
    /// The value.
    pub value: u64,
}

impl Setting {
    /// Returns the setting in words, for example `MCL.particles 200, 60 % of the speed`.
    ///
    /// ```
    /// use cotama_models::robots::Robot;
    /// let robot = Robot::shipped("transport").unwrap();
    /// let slip = robot.failures.iter().find(|it| it.id == "SLP1").unwrap();
    /// assert_eq!(slip.sets.as_ref().unwrap().text(&robot), "60 % of the speed");
    /// ```
    pub fn text(&self, robot: &Robot) -> String {
        let value = |it: &Value| {
            let module = robot.modules.get(it.module)?;
            let parameter = module.parameters.get(it.parameter)?;
            Some(format!("{}.{} {}", module.name, parameter.name, it.value))
        };
        let left = (self.speed < 1_000).then(|| match (self.speed / 10, self.speed % 10) {
            (percent, 0) => format!("{percent} % of the speed"),
            (percent, tenth) => format!("{percent}.{tenth} % of the speed"),
        });
        self.values.iter().filter_map(value).chain(left).collect::<Vec<_>>().join(", ")
    }
}

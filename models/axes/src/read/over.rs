//! Reading the axes of a file whose ground, body and tasks another reader has read.

use super::keys::Keys;
use super::{Case, MAX_AXES, MAX_CONSTRAINTS, Reader, located};
use crate::course::Course;
use crate::fields::{Faults, Fields};
use crate::mission::{Attributes, DetectBy, Mission};
use crate::speeds::Speeds;
use crate::toml_text;
use crate::tree::Wrongs;

/// A mission but for its laptop, detection, axes and constraints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ground {
    /// All that was read; what axes say is empty.
    pub mission: Mission,
    /// Attributes of the file's own, by owner, with their places in bytes: one that no formula
    /// reads may be misspelt.
    pub seen: Vec<(Keys, Vec<(String, usize)>)>,
}

impl Mission {
    /// A mission without anything: what a reader of another format fills in.
    pub fn empty(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            robot: Attributes::default(),
            speeds: Speeds::Levels(Vec::new()),
            laptop: Attributes::default(),
            motion_power: [0; 3],
            detect_by: DetectBy::Option,
            hardware: Vec::new(),
            options: Vec::new(),
            objectives: Vec::new(),
            zones: Vec::new(),
            axes: Vec::new(),
            indicators: Vec::new(),
            constraints: Vec::new(),
        }
    }
}

impl Case {
    /// Reads what a file says of laptop, detection, axes, constraints and wishes; its other keys
    /// are those of the ground. Wishes, laptop and detection may be left out.
    ///
    /// # Errors
    /// All that is wrong, with places, in the order of the file.
    ///
    /// ```
    /// use cotama_axes::{Case, Ground, Mission};
    /// let ground = || Ground { mission: Mission::empty("mine"), seen: Vec::new() };
    /// let case = Case::over(&ground(), "[[axis]]\nid = \"time\"").unwrap();
    /// assert_eq!((case.mission.axes.len(), case.ask.len()), (1, 0));
    /// let wrong = Case::over(&ground(), "axis = 1").unwrap_err();
    /// assert_eq!(wrong.to_string(), "1:8: `axis` must be a list, not an integer");
    /// ```
    pub fn over(ground: &Ground, text: &str) -> Result<Self, Wrongs> {
        let faults = Faults::default();
        let case = over(ground, text, &faults);
        located(case, faults, text)
    }
}

fn over(ground: &Ground, text: &str, faults: &Faults) -> Option<Case> {
    let root = toml_text::parse(text, faults)?;
    let mut fields = Fields::of(&root, "the file", faults);
    let seen = ground.seen.iter();
    let seen = seen.map(|(of, keys)| (*of, keys.iter().map(|it| (it.0.as_str(), it.1)).collect()));
    let (mission, seen) = (ground.mission.clone(), seen.collect());
    let mut reader = Reader { mission, seen, is_strict: true, faults };
    reader.laptop(&mut fields);
    if let Some(node) = fields.optional("detection") {
        reader.detection(node);
    }
    reader.axes(fields.list("axis", MAX_AXES));
    if faults.is_empty() {
        reader.misspelt();
    }
    fields.list("constraint", MAX_CONSTRAINTS).iter().for_each(|it| reader.constraint(it));
    if fields.optional_is_there("ask") {
        return Some(reader.ask(&mut fields));
    }
    Some(Case { mission: reader.mission, ask: Vec::new(), course: Course::default() })
}

//! The models that come with the program.

use cotama_core::net::{Known, Net};
use cotama_core::system::System;
use cotama_models::nets::ace::robot;
use cotama_models::nets::by_hand::{
    contextual, delivery, faults, global, local, observation, operator, path_following, permit,
    teleoperation,
};
use cotama_models::nets::families::Family;
use cotama_models::nets::{self, Model};

/// A model that comes with the program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    /// Description, in a sentence or a few.
    pub(crate) description: &'static str,
    pub(crate) kind: Kind,
}

/// The kind of model that a name stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// A net, and how it was checked.
    Net(&'static Net<'static>, Known),
    /// A net for each number.
    Family(&'static Family),
    /// Nets that work together.
    System(&'static System<'static>),
}

impl Entry {
    /// Returns the name, with `:N` where a number is needed.
    pub(crate) fn shown_name(&self) -> String {
        let number = if matches!(self.kind, Kind::Family(_)) { ":N" } else { "" };
        format!("{}{number}", self.name)
    }

    /// The first sentence of its description.
    pub(crate) fn sentence(&self) -> &'static str {
        // `Fig. 3` ends none.
        let ends = |&(at, _): &(usize, &str)| {
            self.description[at + 2..].starts_with(|next: char| next.is_ascii_uppercase())
        };
        let end = self.description.match_indices(". ").find(ends).map(|(at, _)| at + 1);
        &self.description[..end.unwrap_or(self.description.len())]
    }
}

static SYSTEMS: [System<'static>; 2] = [robot::SYSTEM, delivery::SYSTEM];

/// All of them, in the order in which they are listed.
pub(crate) fn entries() -> Vec<Entry> {
    let shipped = nets::all().iter().map(|it| Entry {
        name: it.name,
        description: it.description,
        kind: match it.model {
            Model::Defined { net, known } => Kind::Net(net, known),
            Model::Family(family) => Kind::Family(family),
        },
    });
    let supervisors: [(&'static Net<'static>, Known); 9] = [
        (&global::NET, global::KNOWN),
        (&local::NET, local::KNOWN),
        (&path_following::NET, path_following::KNOWN),
        (&teleoperation::NET, teleoperation::KNOWN),
        (&contextual::NET, contextual::KNOWN),
        (&permit::NET, permit::KNOWN),
        (&observation::NET, observation::KNOWN),
        (&faults::NET, faults::KNOWN),
        (&operator::NET, operator::KNOWN),
    ];
    let supervisors = supervisors.map(|(net, known)| Entry {
        name: net.name,
        description: net.doc,
        kind: Kind::Net(net, known),
    });
    let systems = SYSTEMS.iter().map(|it| Entry {
        name: system_name(it),
        description: it.doc,
        kind: Kind::System(it),
    });
    shipped.chain(supervisors).chain(systems).collect()
}

/// The supervisors that are written by hand: `delivery` itself is the mission, whose supervisors
/// its robot's file makes.
const BY_HAND: &str = "delivery_by_hand";

fn system_name(system: &System<'static>) -> &'static str {
    if system.name == delivery::SYSTEM.name { BY_HAND } else { system.name }
}

/// The model of this name.
pub(crate) fn entry(name: &str) -> Option<Entry> {
    entries().into_iter().find(|entry| entry.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_ends_before_the_next_one() {
        let sentence = |name| entry(name).unwrap().sentence();
        assert_eq!(
            sentence("delivery_by_hand"),
            "COTAMA's decisional level as it drives the robot, with everything that may fail and \
             the operator."
        );
        assert!(sentence("local").contains("Fig. 3"));
    }

    #[test]
    fn no_two_models_have_the_same_name() {
        let mut names: Vec<_> = entries().iter().map(|it| it.name).collect();
        let all = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all);
    }
}

//! The protocol of a team's file: of tasks with coalitions of several sizes.

use super::{Asked, holds};
use cotama_models::team::protocol::{Defect, Team};
use cotama_models::team::scenario::{self, Scenario};
use cotama_verification::check::{Options, Verdict, check};
use cotama_verification::property;

/// Three robots, of which two can speak; a task that three or two do together, or one alone; and
/// one for two.
const THREE: &str = r#"
format = "cotama-team/1"
name = "three"
floor = { places = ["hall", "desk"], way = [{ between = ["hall", "desk"], length_mm = 6000 }] }
robot = [
  { name = "anna", at = "hall", skills = ["grasp", "talk"] },
  { name = "ben", at = "desk", skills = ["grasp"] },
  { name = "cleo", at = "desk", skills = ["grasp", "talk"] },
]
fault = [{ at_ms = 9, robot = "anna", mode = "EST1" }]
[[task]]
name = "parcel"
from = "hall"
to = "desk"
skip_ms = 600000
[[task.plan]]
name = "three"
role = [FIRST, MIDDLE, LAST]
MORE
[[task]]
name = "letter"
from = "hall"
to = "desk"
skip_ms = 600000
[[task.plan]]
name = "two"
role = [FIRST, LAST]
"#;

const ROLES: [(&str, &str); 4] = [
    ("FIRST", "needs = ['grasp'], take = 'object', give = { partner_at = 'desk' }"),
    ("MIDDLE", "needs = ['grasp'], take = { partner_at = 'desk' }, give = { partner_at = 'desk' }"),
    ("LAST", "needs = ['talk'], take = { partner_at = 'desk' }, give = 'goal'"),
    ("ALONE", "needs = ['talk'], take = 'object', give = 'goal'"),
];

fn team(more: &str) -> Team {
    let text = ROLES.iter().fold(THREE.replace("MORE", more), |text, (word, role)| {
        text.replace(word, &format!("{{ name = 'it', {role}, take_ms = 1, give_ms = 1 }}"))
    });
    Team::from(&Scenario::parse("three.toml", &text).unwrap())
}

impl Asked {
    fn holds(&self, text: &str) -> bool {
        let property = property::parse(text, self.model.pt()).unwrap();
        match check(&self.model, &property, &Options::default()).verdict {
            Verdict::Holds(holds) => holds,
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn the_service_of_the_thesis_keeps_all_requirements() {
    holds(&Team::from(&scenario::service().unwrap()), 45_860, 183_270);
}

#[test]
fn a_coalition_of_three_keeps_all_requirements() {
    holds(&team(""), 153_350, 747_685);
}

#[test]
#[ignore = "ten seconds: 374,160 states"]
fn coalitions_of_three_two_and_one_keep_all_requirements() {
    let more = "[[task.plan]]\nname = 'two'\nrole = [FIRST, LAST]\n[[task.plan]]\nname = 'one'\n\
                role = [ALONE]";
    holds(&team(more), 374_160, 1_766_053);
}

#[test]
fn a_defect_among_three_breaks_its_requirement() {
    for (defect, id) in [(Defect::StartsAlone, "S3"), (Defect::AcksWhileBusy, "S2")] {
        let asked = Asked::new(&team("").with(&[defect]));
        let text = &asked.requirements.iter().find(|it| it.id == id).unwrap().text;
        assert!(!asked.holds(text), "{defect:?}");
    }
}

#[test]
fn each_size_of_coalition_comes_about() {
    let more = "[[task.plan]]\nname = 'one'\nrole = [ALONE]";
    let asked = Asked::new(&team(more));
    for (text, expected) in [
        ("EF (r1.executing.t1 & r2.executing.t1 & r3.executing.t1)", true),
        ("EF (r3.executing.t1 & t1.silent.r1 & t1.silent.r2)", true),
        // Ben cannot speak, and no plan is for two.
        ("EF (r2.executing.t1 & t1.silent.r1)", false),
        ("EF (r2.executing.t1 & t1.silent.r3)", false),
    ] {
        assert_eq!(asked.holds(text), expected, "{text}");
    }
}

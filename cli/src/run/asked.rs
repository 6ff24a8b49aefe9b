//! A run whose operator is the person at the terminal: at each request the situation is drawn, and
//! the run is made again with the answers so far.

use super::situation;
use crate::exit::Failure;
use crate::input;
use crate::names::near;
use crate::output::Screen;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Faults;
use cotama_models::robots::{Answer, Incident, IncidentKind, Mode, Moment, Robot};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::trace::{Record, Request, Trace};

/// Time of an answer, as long as those of the simulated operator.
const ANSWERS_AFTER: Millis = Millis(8_000);
/// The most requests of a run that are put to a person.
const MOST: usize = 1_000;

/// Returns the options of a run with the answers that a person gives, in place of those of the
/// script. At the end of the input the rest is left to the habits of the simulated operator.
pub(super) fn answered(
    mission: &Mission,
    options: Options,
    screen: &Screen,
) -> Result<Options, Failure> {
    let robot = mission.robot().map(cotama_models::robots::RobotFile::robot);
    let Some(robot) = robot.filter(|it| it.operator.is_some() && mission.is_supervised()) else {
        let message = "--operator ask is for missions whose supervisors ask an operator";
        return Err(Failure::new(message).help("`cotama run delivery --operator ask` is one"));
    };
    let mut faults = super::of_run(&options.faults, mission).cloned().unwrap_or_default();
    faults.of_robot.retain(|it| !matches!(it.kind, IncidentKind::Operator { .. }));
    let mut options = Options { faults: given(&faults), ..options };
    for number in 0..MOST {
        // What cannot be run is told by the run itself.
        let Ok((trace, _)) = Trace::record(mission, &options) else { break };
        let Some(request) = requests(&trace).nth(number) else { break };
        screen.note(&situation::words(&trace, number, request, screen.width()));
        let Some(answers) = asked(robot, screen)? else { break };
        let when = Moment::Place(Millimetres(request.x_mm));
        let kind = IncidentKind::Operator { answers, delay: ANSWERS_AFTER };
        faults.of_robot.push(Incident { when, kind });
        options.faults = given(&faults);
    }
    Ok(options)
}

fn given(faults: &Faults) -> FaultChoice {
    FaultChoice::Given { source: "script, answers of a person".into(), faults: faults.clone() }
}

/// The requests of a run, in their order.
fn requests(trace: &Trace) -> impl Iterator<Item = &Request> {
    trace.records.iter().filter_map(|it| match it {
        Record::Request(it) => Some(it),
        _ => None,
    })
}

/// Asks until the answers make sense; `None` at the end of the input.
fn asked(robot: &Robot, screen: &Screen) -> Result<Option<Vec<Answer>>, Failure> {
    let known = robot.sub_objectives.iter().filter(|it| it.mode == Mode::Operator);
    let known: Vec<&str> = known.map(|it| it.name.as_str()).collect();
    let first = known.first().copied().unwrap_or("done");
    screen.note(&format!(
        "you choose, one after the other: {}; then `done`, or `give_up` (as `{first} done`)",
        known.join(", ")
    ));
    while let Some(line) = input::answer()? {
        match read(robot, &line) {
            Ok(answers) => return Ok(Some(answers)),
            Err(why) => screen.note(&why),
        }
    }
    screen.note("no more answers: the rest is left to the simulated operator");
    Ok(None)
}

/// Reads answers, which end with `done` or `give_up`.
fn read(robot: &Robot, line: &str) -> Result<Vec<Answer>, String> {
    let words = line.split(|it: char| it.is_whitespace() || it == ',').filter(|it| !it.is_empty());
    let one = |word: &str| match word {
        "done" => Ok(Answer::Done),
        "give_up" => Ok(Answer::GivesUp),
        _ => {
            let his = |it: &cotama_models::robots::SubObjective| it.mode == Mode::Operator;
            let all =
                || robot.sub_objectives.iter().filter(|it| his(it)).map(|it| it.name.as_str());
            let found = robot.sub_objectives.iter().position(|it| his(it) && it.name == word);
            found.map(Answer::Chooses).ok_or_else(|| match near(word, all()) {
                Some(near) => format!("`{word}` is no answer; did you mean `{near}`?"),
                None => format!("`{word}` is no answer"),
            })
        }
    };
    let answers = words.map(one).collect::<Result<Vec<_>, _>>()?;
    let chosen = |it: &Answer| matches!(it, Answer::Chooses(_));
    match answers.split_last() {
        Some((Answer::Done, before)) if !before.is_empty() && before.iter().all(chosen) => {}
        Some((Answer::GivesUp, before)) if before.iter().all(chosen) => {}
        _ => {
            return Err(
                "answers begin with what you choose, and end with `done` or `give_up`".into()
            );
        }
    }
    Ok(answers)
}

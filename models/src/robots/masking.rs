//! Checks of what asks the operator first, and of masks: none may hide what has to be seen.

use super::sound::Places;
use super::{Failure, MAX_MASKS, Mask, Mode, Robot};
use crate::missions::Diagnostic;
use crate::missions::reader::fields::Sink;
use crate::names::quoted;
use crate::severity::Severity;
use std::ops::Range;

/// Reports masks and questions to the operator that make no sense.
pub(super) fn makes_sense(robot: &Robot, at: &Places, sink: &Sink) {
    let place = |all: &[Range<usize>], number: usize| all.get(number).cloned().unwrap_or_default();
    let wrong = |span: Range<usize>, message: String, label: &str, help: &str| {
        sink.report(Diagnostic::new(span, message, label).help(help));
    };
    let severities = |it: &Failure| [it.autonomous, it.operator];
    let mut masks = 0;
    for (number, it) in robot.failures.iter().enumerate() {
        let id = || quoted(&it.id);
        if it.asks.is_some() && !robot.can_ask(0) {
            let help = "leave `ask` out, or add an `[operator]` and a configuration for him";
            let message = format!("{} asks first, and there is nobody to ask", id());
            wrong(place(&at.asks, number), message, "nobody to ask", help);
        } else if it.asks.is_some() && severities(it) == [Severity::Hard; 2] {
            let message = format!("{} is hard, and asks the operator anyway", id());
            wrong(place(&at.asks, number), message, "of no use", "leave `ask` out");
        }
        let Some(mask) = &it.masks else { continue };
        let span = || place(&at.masks, number);
        masks += 1;
        if masks == MAX_MASKS + 1 {
            let message = format!("a robot has at most {MAX_MASKS} masks");
            wrong(span(), message, "one too many", "leave some out");
        }
        if severities(it) == [Severity::Fatal; 2] && !(mask.on_order && it.asks.is_some()) {
            let message = format!("{} ends the mission, and masks something", id());
            wrong(span(), message, "of no use", "leave `mask` out, or let him be asked first");
        } else if mask.on_order && !is_ordered(robot, it) {
            let message = format!("nobody is asked for {}, and so nobody orders its mask", id());
            let help = "call it `hard`, or add `ask = { times = 1 }`, with an operator";
            wrong(span(), message, "never made", help);
        }
        for (message, help) in robot.failures.iter().filter_map(|of| hides(robot, it, mask, of)) {
            wrong(span(), message, "hides too much", help);
        }
    }
}

/// Whether the operator is asked for a failure at some time.
fn is_ordered(robot: &Robot, it: &Failure) -> bool {
    let is_hard = [it.autonomous, it.operator].contains(&Severity::Hard);
    robot.can_ask(0) && (is_hard || it.asks.is_some())
}

/// Says why a mask of a failure hides too much of one of all failures; `None` where it does not.
///
/// The failure itself is known when its mask is made, and answered. Another one is to be seen
/// still: by a flag of its own that is left, and if it is hard, with somebody to ask or something
/// below to go on with.
fn hides(robot: &Robot, it: &Failure, mask: &Mask, of: &Failure) -> Option<(String, &'static str)> {
    if it.id == of.id {
        return None;
    }
    let flag = mask.flags.iter().copied().find(|flag| of.flags.contains(flag))?;
    let flag = robot.flags().nth(flag).map_or("", |it| it.1);
    let is_hidden = of.flags.iter().all(|flag| mask.flags.contains(flag));
    let (own, flag, other) = (quoted(&it.id), quoted(flag), quoted(&of.id));
    if is_hidden {
        let message = format!("{own} masks {flag}, and nothing else shows {other}");
        return Some((message, "let another flag show it too, or mask nothing here"));
    }
    let lost = robot.lost(of.loses);
    if of.autonomous >= Severity::Hard && !robot.can_ask(lost) && !has_less(robot, lost) {
        let message = format!(
            "{own} masks {flag}, which shows {other}: nobody can be asked then, and there is no \
             configuration below"
        );
        return Some((message, "mask nothing that shows what is hard, or add one that is slower"));
    }
    None
}

/// Whether each part of a drive that the robot serves itself goes on with a worse configuration
/// after these losses.
fn has_less(robot: &Robot, lost: u32) -> bool {
    let mut own =
        robot.sub_objectives.iter().enumerate().filter(|it| it.1.mode == Mode::Autonomous);
    own.all(|(number, _)| {
        let left = robot.best(number, lost);
        left.is_some() && left != robot.best(number, 0)
    })
}

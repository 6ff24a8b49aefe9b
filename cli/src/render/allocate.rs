//! The screen of `cotama allocate`.

use super::numbers::{grouped, joules, seconds};
use super::plan::status;
use crate::answers::AllocateAnswer;
use cotama_models::missions::infeasible::amount;
use cotama_models::missions::tables::ENERGY;
use std::fmt::Write;

/// The most choices that are shown.
const SHOWN: usize = 200;

/// The screen.
pub(crate) fn screen(
    answer: &AllocateAnswer,
    limits: [u64; 2],
    objective: &str,
    width: usize,
) -> String {
    let mut text =
        format!("{}, {} steps\n", status(answer.status), grouped(&answer.steps.to_string()));
    if let (Some(quality), Some(duration), Some(energy)) =
        (answer.quality, answer.duration_ms, answer.energy_mj)
    {
        let _ = writeln!(text, "  quality   {}", grouped(&quality.to_string()));
        let _ = writeln!(text, "  duration  {} of {}", seconds(duration), seconds(limits[0]));
        let _ = writeln!(text, "  energy    {} of {}", joules(energy), joules(limits[1]));
        let choice: Vec<_> = answer.choice.iter().take(SHOWN).map(u16::to_string).collect();
        let more = if answer.choice.len() > SHOWN { " ... (all: --json)" } else { "" };
        let _ = writeln!(text, "  choice    {}{more}", choice.join(" "));
    }
    if let Some(bound) = answer.bound {
        let side = if objective == "quality" {
            "no plan has more quality than"
        } else {
            "no plan needs less energy than"
        };
        let bound = match objective {
            "quality" => grouped(&bound.to_string()),
            _ => amount(ENERGY, bound),
        };
        let _ = writeln!(text, "  bound     {side} {bound}");
    }
    if let Some(reason) = &answer.reason {
        text += &super::reason::reason(reason, width);
    }
    text
}

//! Plays a schedule by the rules of time nets, clock by clock.

use crate::tpn::discrete::{enabled, fire};
use cotama_verification::tpn::{Date, Schedule, TimeNet};

/// The marking at the end; or which rule is broken.
pub(crate) fn replay(net: &TimeNet, run: &Schedule) -> Result<Vec<u32>, String> {
    let per_unit = run.steps.iter().map(|it| it.date.per_unit).max().unwrap_or(1);
    let mut tokens: Vec<u32> = net.places().iter().map(|it| it.initial).collect();
    // For each enabled transition the date since when it is, in parts of a unit.
    let mut since: Vec<Option<u64>> =
        net.transitions().iter().map(|it| enabled(it, &tokens).then_some(0)).collect();
    let mut now = 0;
    for (number, step) in run.steps.iter().enumerate() {
        let Date { parts, per_unit: of } = step.date;
        if per_unit % of != 0 || of > 1 && parts % 2 == 0 {
            return Err(format!("{parts}/{of} is not in lowest terms"));
        }
        let date = parts * (per_unit / of);
        if date < now {
            return Err(format!("firing {number} is earlier than the one before"));
        }
        now = date;
        for (it, since) in net.transitions().iter().zip(&since) {
            let Some((clock, upper)) = since.map(|since| now - since).zip(it.interval.upper) else {
                continue;
            };
            if clock > upper * per_unit || it.interval.upper_strict && clock == upper * per_unit {
                return Err(format!("at firing {number}, {} should have fired before", it.name));
            }
        }
        let fired = step.transition.0 as usize;
        let it = &net.transitions()[fired];
        let Some(clock) = since[fired].map(|since| now - since) else {
            return Err(format!("firing {number}: {} is not enabled", it.name));
        };
        let lower = it.interval.lower * per_unit;
        if clock < lower || it.interval.lower_strict && clock == lower {
            return Err(format!("firing {number}: {} is too early", it.name));
        }
        let (after, new) = fire(net, &tokens, fired);
        tokens = after;
        since = new
            .iter()
            .zip(&since)
            .map(|(new, since)| new.and_then(|new| if new { Some(now) } else { *since }))
            .collect();
    }
    Ok(tokens)
}

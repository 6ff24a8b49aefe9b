//! COTAMA's whole decisional level: flags in, requests out.

use crate::control::{Control, PERIOD_MS};
use crate::surroundings::{Noise, SEVEN_POINTS, Surroundings};
use crate::trace::{Sink, Trace};
use cotama_core::units::Millis;
use cotama_models::cotama::NoPlans;

/// The delivery is over by then.
const LONGEST: Millis = Millis(1_200_000);
/// The place of the global supervisor after its four objectives.
const DELIVERED: u32 = 5;
/// So many random scripts, of so many periods each.
const SCRIPTS: u64 = 1_000;
const PERIODS: u64 = 300;

pub(super) fn seven_points(trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let (mut control, mut world) = (Control::default(), Surroundings::new(&SEVEN_POINTS));
    let mut now = Millis(0);
    while now < LONGEST {
        let given = world.before(now, &control);
        let requests = control.period(now, &given, &mut NoPlans, trace);
        world.after(&requests);
        if control.decider().global().0 >= DELIVERED {
            break;
        }
        now = Millis(now.0 + PERIOD_MS);
    }
    let delivered = control.decider().global().0 == DELIVERED;
    [(now.0 / 1_000) as u32, u32::from(delivered)]
}

pub(super) fn random(trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let (mut periods, mut safe) = (0, 0);
    for script in 0..SCRIPTS {
        let (mut control, mut noise) = (Control::default(), Noise::new(script));
        let mut ended = false;
        for now in (0..PERIODS).map(|it| Millis(it * PERIOD_MS)) {
            let requests = control.period(now, &noise.period(), &mut NoPlans, trace);
            periods += 1;
            ended |= requests.alarm || requests.halt;
        }
        safe += u32::from(ended);
    }
    [periods, safe]
}

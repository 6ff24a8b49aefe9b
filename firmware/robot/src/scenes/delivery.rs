//! The whole decisional level of two robots: flags in, requests out.

use crate::control::{Control, PERIOD_MS};
use crate::robots::{delivery, transport};
use crate::surroundings::{Noise, SEVEN_POINTS, Surroundings};
use crate::trace::{Sink, Trace};
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::level::Global;

/// The delivery is over by then.
const LONGEST: Millis = Millis(1_200_000);
/// So many random scripts, of so many periods each.
const SCRIPTS: u64 = 1_000;
const PERIODS: u64 = 300;

pub(super) fn seven_points(trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let mut control = delivery::Control::default();
    let mut world = Surroundings::new(&SEVEN_POINTS);
    let mut now = Millis(0);
    let is_over = |global| matches!(global, Global::Done | Global::Secures | Global::Safe);
    while now < LONGEST && !is_over(control.decider().level().global()) {
        let given = world.before(now, &control);
        let (requests, _) = control.period(now, &given, trace);
        world.after(&requests, delivery::TABLES);
        now = Millis(now.0 + PERIOD_MS);
    }
    let delivered = control.decider().level().global() == Global::Done;
    [(now.0 / 1_000) as u32, u32::from(delivered)]
}

/// Each other script is of the other robot.
pub(super) fn random(trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let (mut periods, mut safe) = (0, 0);
    for script in 0..SCRIPTS {
        let (more, ended) = if script % 2 == 0 {
            of_noise(delivery::Control::default(), Noise::new(script, delivery::TABLES), trace)
        } else {
            of_noise(transport::Control::default(), Noise::new(script, transport::TABLES), trace)
        };
        periods += more;
        safe += u32::from(ended);
    }
    [periods, safe]
}

/// Returns how many periods there were, and whether the robot ended in safety.
fn of_noise<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
    mut control: Control<P, W, C, S>,
    mut noise: Noise,
    trace: &mut Trace<'_, impl Sink>,
) -> (u32, bool) {
    let mut ended = false;
    for now in (0..PERIODS).map(|it| Millis(it * PERIOD_MS)) {
        let (requests, _) = control.period(now, &noise.period(), trace);
        ended |= requests.alarm || requests.halt;
    }
    (PERIODS as u32, ended)
}

//! Reading the body of a robot, and what a failure does to its motion.

use crate::missions::reader::fields::Fields;
use crate::missions::{Diagnostic, MotionPower, harmless_speed};
use crate::robots::known::{
    AXLES, BODY_SPEEDS, CELLS, CHARGES, COEFFICIENTS, COUNTS, CURRENTS, ERRORS, MOTIONS, NO_LOADS,
    PERIODS, POSITIVE, RADII, RESISTANCES, ROLLINGS, SLOWED, TIMES, TURNS, VOLTAGES, WHEELS,
};
use crate::robots::{Battery, Body, Motion, Motors, Wheels};
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis};

/// The period of a control loop where nothing is said (stated of the delivery: below 0.1 s).
const PERIOD: Millis = Millis(100);

/// The radius of a robot where nothing is said: a Pioneer 3-DX (its manual, appendix B).
const RADIUS: Millimetres = Millimetres(260);

pub(super) fn body(mut fields: Fields<'_>, hardware: &[String]) -> Option<Body> {
    let speed_max = fields.integer("speed_max_mm_s", BODY_SPEEDS).map(MillimetresPerSecond);
    let acceleration = fields.integer("acceleration_mm_s2", POSITIVE);
    let radius = fields.optional_integer("radius_mm", RADII);
    let period = fields.optional_integer("period_ms", PERIODS);
    let motion_power = fields.table("motion_power").and_then(|mut it| {
        let c0 = it.integer("c0", COEFFICIENTS);
        let c1 = it.integer("c1", COEFFICIENTS);
        let c2 = it.integer("c2", COEFFICIENTS);
        it.finish();
        Some(MotionPower { c0: c0?, c1: c1?, c2: c2? })
    });
    let wheels = match fields.optional_table("wheels") {
        Ok(it) => it.map_or(Some(Wheels::default()), wheels),
        Err(_) => None,
    };
    let motors = fields.optional_table("motors");
    let battery = match fields.optional_table("battery") {
        Ok(it) => it.map_or(Some(None), |it| battery(it).map(Some)),
        Err(_) => None,
    };
    let sensing = super::sensing::sensing(&mut fields, hardware);
    let mass = fields.optional_integer::<u64>("mass_g", POSITIVE);
    let energy = fields.optional_integer::<u64>("impact_energy_max_mj", POSITIVE);
    let source = super::words(&mut fields, "source");
    let (mass, energy) = (mass.ok()?, energy.ok()?);
    let motors = match motors {
        Ok(it) => it.map_or(Some(None), |it| motors_of(it, mass).map(Some)),
        Err(_) => None,
    };
    let impact = match (mass, energy) {
        (Some(mass), Some(energy)) => Some((mass, energy)),
        (None | Some(_), None) => None,
        (None, Some(_)) => {
            let (span, message) = (fields.span_of("impact_energy_max_mj"), "no `mass_g`");
            let it = Diagnostic::new(span, "the energy of an impact is that of a mass", message);
            fields.report(it.help("add `mass_g`, or leave `impact_energy_max_mj` out"));
            None
        }
    };
    let harms = |(mass, energy)| harmless_speed(mass, Millijoules(energy)).0 == 0;
    if impact.is_some_and(harms) {
        let (span, label) = (fields.span_of("impact_energy_max_mj"), "too low");
        let it = Diagnostic::new(span, "no speed is harmless: even 1 mm/s is too fast", label);
        fields.report(it.help("give a lower mass or a higher energy"));
    }
    fields.finish();
    Some(Body {
        speed_max: speed_max?,
        acceleration: acceleration?,
        radius: radius.ok()?.map_or(RADIUS, Millimetres),
        period: period.ok()?.map_or(PERIOD, Millis),
        motion_power: motion_power?,
        impact,
        wheels: wheels?,
        motors: motors?,
        battery: battery?,
        sensing: sensing?,
        source,
    })
}

/// Reads the motors, which move a mass.
fn motors_of(mut fields: Fields<'_>, mass: Option<u64>) -> Option<Motors> {
    let voltage = fields.integer("voltage_mv", VOLTAGES);
    let no_load = fields.integer("no_load_mrad_s", NO_LOADS);
    let resistance = fields.integer("resistance_mohm", RESISTANCES);
    let limit = fields.integer("limit_ma", CURRENTS);
    let rolling = fields.integer("rolling_permille", ROLLINGS);
    let stall = fields.integer("stall_ms", TIMES).map(Millis);
    if mass.is_none() {
        let it = Diagnostic::new(fields.whole(), "motors move a mass", "no `mass_g` in `body`");
        fields.report(it.help("add `mass_g` to `body`, or leave its `motors` out"));
    }
    fields.finish();
    Some(Motors {
        voltage_mv: voltage?,
        no_load_mrad_s: no_load?,
        resistance_mohm: resistance?,
        limit_ma: limit?,
        rolling_permille: rolling?,
        mass_g: mass?,
        stall: stall?,
    })
}

/// Reads the battery; its voltages fall from full to empty, and the robot is on when it is full.
fn battery(mut fields: Fields<'_>) -> Option<Battery> {
    let capacity = fields.integer("capacity_mah", CHARGES);
    let full = fields.integer::<u64>("full_mv", VOLTAGES);
    let empty = fields.integer::<u64>("empty_mv", VOLTAGES);
    let cutoff = fields.integer::<u64>("cutoff_mv", VOLTAGES);
    let resistance = fields.integer("resistance_mohm", RESISTANCES);
    let cells = fields.integer("cells", CELLS);
    for (key, it) in [("empty_mv", empty), ("cutoff_mv", cutoff)] {
        if it.zip(full).is_some_and(|(it, full)| it >= full) {
            let message = format!("`{key}` must be below `full_mv`");
            let it = Diagnostic::new(fields.span_of(key), message, "too high");
            fields.report(it.help("give a lower voltage, or a higher `full_mv`"));
        }
    }
    fields.finish();
    Some(Battery {
        capacity_mah: capacity?,
        full_mv: full?,
        empty_mv: empty?,
        cutoff_mv: cutoff?,
        resistance_mohm: resistance?,
        cells: cells?,
    })
}

/// Reads the wheels; what is not said is that of a Pioneer 3-DX.
fn wheels(mut fields: Fields<'_>) -> Option<Wheels> {
    let known = Wheels::default();
    let radius = fields.optional_integer("radius_um", WHEELS);
    let axle = fields.optional_integer("axle_mm", AXLES);
    let turn = fields.optional_integer("turn_mrad_s", TURNS);
    let turn_acceleration = fields.optional_integer("turn_acceleration_mrad_s2", TURNS);
    let counts = fields.optional_integer("counts", COUNTS);
    let errors = ["left_error_ppm", "right_error_ppm", "axle_error_ppm"]
        .map(|key| fields.optional_integer::<i32>(key, ERRORS));
    fields.finish();
    let [left, right, between] = errors;
    let error = |it: Option<i32>| it.unwrap_or(0);
    Some(Wheels {
        radius_um: radius.ok()?.unwrap_or(known.radius_um),
        axle: axle.ok()?.map_or(known.axle, Millimetres),
        turn_mrad_s: turn.ok()?.unwrap_or(known.turn_mrad_s),
        turn_acceleration: turn_acceleration.ok()?.unwrap_or(known.turn_acceleration),
        counts: counts.ok()?.unwrap_or(known.counts),
        errors_ppm: [error(left.ok()?), error(right.ok()?), error(between.ok()?)],
    })
}

/// Reads what a failure does to the motion: `motion`, or `slowed_permille`.
pub(super) fn motion(fields: &mut Fields<'_>) -> Option<Motion> {
    let slowed = fields.optional_integer::<u16>("slowed_permille", SLOWED);
    let named = fields.optional_text("motion");
    let (slowed, named) = (slowed.ok()?, named.ok()?);
    match (slowed, named) {
        (None, None) => Some(Motion::Free),
        (Some(parts), None) => Some(Motion::Slowed(parts)),
        (None, Some(name)) => {
            let names = MOTIONS.iter().map(|it| it.0);
            let at = fields.index_of(&name, "effect on motion", names)?;
            MOTIONS.get(at).map(|it| it.1)
        }
        (Some(_), Some(name)) => {
            let message = "a failure has one effect on motion";
            let it = Diagnostic::new(name.span, message, "and `slowed_permille` too");
            fields.report(it.help("leave one of them out"));
            None
        }
    }
}

//! Reading the devices by which a robot senses in the plane.

use crate::missions::Diagnostic;
use crate::missions::reader::fields::Fields;
use crate::robots::known::{
    HEADINGS, LATENCIES, LEASTS, MOUNTS, NOISES, RANGES, RATES, RAYS, SHARP, SONARS, VIEWS,
};
use crate::robots::sensing::{Gyro, LaserScanner, MAX_LASERS, MarkCamera, Mount, Sensing};
use cotama_core::units::{Millimetres, Millis};

/// Reads the devices in the table of the body.
pub(super) fn sensing(fields: &mut Fields<'_>, hardware: &[String]) -> Option<Sensing> {
    let sonars = match fields.optional_text("sonars") {
        Ok(Some(it)) => fields.index_of(&it, "ring of sonars", SONARS.into_iter()),
        Ok(None) => Some(0),
        Err(_) => None,
    };
    let lasers = fields.tables_up_to("laser", false, MAX_LASERS);
    let lasers: Option<Vec<_>> =
        lasers.into_iter().flatten().map(|it| laser(it, hardware)).collect();
    let camera = match fields.optional_table("camera") {
        Ok(it) => it.map_or(Some(None), |it| camera(it, hardware).map(Some)),
        Err(_) => None,
    };
    let gyro = match fields.optional_table("gyro") {
        Ok(it) => it.map_or(Some(None), |it| gyro(it, hardware).map(Some)),
        Err(_) => None,
    };
    Some(Sensing { no_sonars: sonars? == 1, lasers: lasers?, camera: camera?, gyro: gyro? })
}

/// Reads the number of the hardware that a device is.
fn hardware_of(fields: &mut Fields<'_>, known: &[String]) -> Option<usize> {
    let name = fields.text("hardware")?;
    fields.index_of(&name, "hardware", known.iter().map(String::as_str))
}

fn mount(fields: &mut Fields<'_>) -> Option<Mount> {
    let places = ["x_mm", "y_mm"].map(|key| fields.optional_integer(key, MOUNTS));
    let heading = fields.optional_integer("heading_deg", HEADINGS);
    let [x_mm, y_mm] = places;
    Some(Mount {
        x_mm: x_mm.ok()?.unwrap_or(0),
        y_mm: y_mm.ok()?.unwrap_or(0),
        heading_deg: heading.ok()?.unwrap_or(0),
    })
}

/// Reads the time between two readings, and from a reading to its arrival.
fn times(fields: &mut Fields<'_>) -> Option<[Millis; 2]> {
    let period = fields.optional_integer("period_ms", RATES);
    let latency = fields.optional_integer("latency_ms", LATENCIES);
    Some([Millis(period.ok()?.unwrap_or(100)), Millis(latency.ok()?.unwrap_or(0))])
}

fn laser(mut fields: Fields<'_>, known: &[String]) -> Option<LaserScanner> {
    let hardware = hardware_of(&mut fields, known);
    let mount = mount(&mut fields);
    let view = fields.integer("view_deg", VIEWS);
    let rays = fields.integer("rays", RAYS);
    let range = fields.integer::<u64>("range_mm", RANGES);
    let least = fields.optional_integer::<u64>("least_mm", LEASTS);
    let noise = fields.optional_integer("noise_mm", LEASTS);
    let times = times(&mut fields);
    if let (Ok(Some(least)), Some(range)) = (&least, range)
        && *least >= range
    {
        let message = "the least range is not below the range";
        let it = Diagnostic::new(fields.span_of("least_mm"), message, "too far");
        fields.report(it.help("give a lower `least_mm`, or a higher `range_mm`"));
    }
    fields.finish();
    let least = least.ok()?.unwrap_or(0);
    Some(LaserScanner {
        hardware: hardware?,
        mount: mount?,
        view_deg: view?,
        rays: rays?,
        range: [Millimetres(least), Millimetres(range?)],
        noise: Millimetres(noise.ok()?.unwrap_or(10)),
        times: times?,
    })
}

fn camera(mut fields: Fields<'_>, known: &[String]) -> Option<MarkCamera> {
    let hardware = hardware_of(&mut fields, known);
    let mount = mount(&mut fields);
    let view = fields.integer("view_deg", VIEWS);
    let sharp = fields.integer("sharp_mm_s", SHARP);
    let times = times(&mut fields);
    fields.finish();
    Some(MarkCamera {
        hardware: hardware?,
        mount: mount?,
        view_deg: view?,
        sharp_mm_s: sharp?,
        times: times?,
    })
}

fn gyro(mut fields: Fields<'_>, known: &[String]) -> Option<Gyro> {
    let hardware = hardware_of(&mut fields, known);
    let bias = fields.integer("bias_urad_s", NOISES);
    let noise = fields.integer("noise_urad_s", NOISES);
    fields.finish();
    Some(Gyro { hardware: hardware?, bias_urad_s: bias?, noise_urad_s: noise? })
}

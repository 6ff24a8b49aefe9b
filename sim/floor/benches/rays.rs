//! Rays per second on one core: on the three public maps at 8 m, and on the office that ships.
//!
//! `COTAMA_MAPS_DIR=.. cargo bench -p cotama-floor --bench rays`; with any argument of its own it
//! runs briefly. *At random*: each ray begins in another free place and goes another way. *Scans*:
//! 360 rays from one place, one after the other around. Each figure is the median of 21 rounds: by
//! the time on the processor where Linux tells it, as others may work beside, and by the clock.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_floor::map_server::{Map, Metadata};
use cotama_floor::{Point, Ray, Sense, Surface, Version, embedded};
use cotama_fuzz::Random;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

const RANGE_M: f64 = 8.0;
const SCAN: usize = 360;

/// A free place, drawn evenly.
fn place(random: &mut Random, floor: &dyn Surface) -> Point {
    let bounds = floor.bounds();
    loop {
        let mut part = || random.below(1 << 30) as f64 / f64::from(1 << 30);
        let at = Point::new(
            bounds.least.x + bounds.width() * part(),
            bounds.least.y + bounds.height() * part(),
        );
        if floor.clearance(at, 0.1) >= 0.1 {
            return at;
        }
    }
}

fn measure(name: &str, floor: &dyn Surface, (count, repeats, rounds): (usize, usize, usize)) {
    let mut random = Random(1);
    let mut drawn = Vec::with_capacity(count);
    let mut scans = Vec::with_capacity(count);
    while drawn.len() < count {
        let angle = TAU * random.below(1 << 30) as f64 / f64::from(1 << 30);
        let at = place(&mut random, floor);
        drawn.push(Ray::at(at, angle));
        if drawn.len() % SCAN == 0 {
            scans.extend((0..SCAN).map(|it| Ray::at(at, angle + TAU * it as f64 / SCAN as f64)));
        }
    }
    for (kind, rays) in [("at random", &drawn), ("scans", &scans)] {
        let mut out = vec![0.0; rays.len()];
        let mut rates: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
        for _ in 0..rounds {
            let (start, before) = (Instant::now(), on_processor());
            for _ in 0..repeats {
                for (rays, out) in rays.chunks(SCAN).zip(out.chunks_mut(SCAN)) {
                    floor.distances(black_box(rays), RANGE_M, Sense::Light, out);
                }
            }
            let count = (repeats * rays.len()) as f64 / 1e6;
            rates[0].push(count / start.elapsed().as_secs_f64());
            let used = on_processor().zip(before).map(|(now, before)| now - before);
            rates[1].push(used.map_or(f64::NAN, |it| count / it));
        }
        let [clock, processor] = rates.map(|mut it| {
            it.sort_by(f64::total_cmp);
            [it[rounds / 2], it[rounds - 1]]
        });
        let hits: Vec<f64> = out.iter().copied().filter(|it| it.is_finite()).collect();
        let mean = hits.iter().sum::<f64>() / hits.len() as f64;
        println!(
            "{name:22} {kind:10} {:5.1} M rays/s on the processor, {:5.1} by the clock, at best \
             {:5.1}  ({:.0} % hit, {mean:.2} m on average)",
            processor[0],
            clock[0],
            clock[1],
            100.0 * hits.len() as f64 / out.len() as f64,
        );
    }
}

/// Returns the seconds that the program has been on a processor.
fn on_processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|it| it / 1e9)
}

fn main() {
    let brief = std::env::args().skip(1).any(|argument| argument == "--test");
    // A round takes about 0.1 s, as times on the processor are counted in steps of 4 ms.
    let size = if brief { (SCAN * 4, 1, 1) } else { (SCAN * 400, 20, 21) };
    let office = embedded::OFFICE.floor().unwrap().surface(Version::Real, &[]).unwrap();
    measure("office, stretches", &office, size);
    let Some(folder) = std::env::var_os("COTAMA_MAPS_DIR") else {
        println!("SKIPPED: the public maps; set COTAMA_MAPS_DIR to the folder that holds them");
        return;
    };
    for name in ["willow_full_10cm", "nav2_depot_5cm", "turtlebot3_world_5cm"] {
        let path = Path::new(&folder).join(name).with_extension("yaml");
        let text = std::fs::read_to_string(&path).unwrap();
        let (metadata, _) = Metadata::parse(name, &text).unwrap();
        let image = std::fs::read(metadata.image_path(&path)).unwrap();
        let map = Map::read(&metadata, name, &image).unwrap();
        measure(name, &map.grid().unwrap(), size);
    }
}

//! Many rays at once, as on cells (`grid/march.rs`); where a ray comes to a cell with stretches, it
//! looks at them before it goes on.

use super::Segments;
use crate::geometry::Ray;
use crate::octants::Walk;
use crate::surface::{Sense, Surface};

/// So many rays go together: their state stays in the first cache.
const TOGETHER: usize = 128;

/// Writes how far each ray goes; infinity where nothing is within the range.
pub(super) fn march(floor: &Segments, rays: &[Ray], range: f64, sense: Sense, out: &mut [f64]) {
    let mut walks = [Walk::default(); TOGETHER];
    for (rays, out) in rays.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER)) {
        together(floor, rays, range, sense, &mut walks, out);
    }
}

fn together(
    floor: &Segments,
    rays: &[Ray],
    range: f64,
    sense: Sense,
    walks: &mut [Walk; TOGETHER],
    out: &mut [f64],
) {
    let octants = &floor.octants;
    // Until here something nearer may come, in cells.
    let mut limits = [range * floor.per_metre; TOGETHER];
    let mut best = [f64::INFINITY; TOGETHER];
    // Numbers of the rays that are on their way, and of those that look.
    let (mut open, mut looks) = ([0_u8; TOGETHER], [0_u8; TOGETHER]);
    let (mut count, mut looking) = (0, 0);
    for ((at, ray), walk) in rays.iter().enumerate().zip(walks.iter_mut()) {
        let from = floor.in_cells(ray.from);
        if octants.holds(from) {
            *walk = octants.walk(from, ray.along);
            open[count] = at as u8;
            count += usize::from(walk.is_open());
            looks[looking] = at as u8;
            looking += usize::from(walk.has_hit());
        } else {
            // Seldom: it is asked alone.
            let hit = floor.hit(ray, range, sense);
            best[at] = hit.map_or(f64::INFINITY, |it| it.distance);
        }
    }
    while count + looking > 0 {
        while count > 0 {
            let last = core::mem::take(&mut count);
            for place in 0..last.min(TOGETHER) {
                let at = open[place] as usize % TOGETHER;
                let walk = &mut walks[at];
                octants.step(walk);
                let is_near = usize::from(walk.distance <= limits[at]);
                open[count % TOGETHER] = at as u8;
                count += usize::from(walk.is_open()) & is_near;
                looks[looking % TOGETHER] = at as u8;
                looking += usize::from(walk.has_hit()) & is_near;
            }
        }
        for at in looks.iter().take(core::mem::take(&mut looking)) {
            let at = *at as usize % TOGETHER;
            let (walk, limit) = (&mut walks[at], &mut limits[at]);
            let Some(ray) = rays.get(at) else { continue };
            while walk.has_hit() && walk.distance <= *limit {
                floor.nearest_here(walk, ray, sense, &mut best[at]);
                *limit = limit.min(best[at] * floor.per_metre);
                octants.step_one(walk);
            }
            open[count % TOGETHER] = at as u8;
            count += usize::from(walk.is_open() && walk.distance <= *limit);
        }
    }
    for (best, out) in best.iter().zip(out) {
        *out = if *best <= range { *best } else { f64::INFINITY };
    }
}

//! Many rays at once, as on cells (`grid/march.rs`); those that come to a cell with stretches look
//! at them before they go on.

use super::Segments;
use crate::geometry::Ray;
use crate::octants::{Walk, is_open};
use crate::surface::{Sense, Surface};

/// So many rays go together: their state stays in the first cache.
const MANY: usize = 128;
/// So many are not worth the room of many: those of a sonar.
const FEW: usize = 16;

/// Writes how far each ray goes; infinity where nothing is within the range.
pub(super) fn march(floor: &Segments, rays: &[Ray], range: f64, sense: Sense, out: &mut [f64]) {
    if rays.len() <= FEW {
        by::<FEW>(floor, rays, range, sense, out);
    } else {
        by::<MANY>(floor, rays, range, sense, out);
    }
}

fn by<const N: usize>(floor: &Segments, rays: &[Ray], range: f64, sense: Sense, out: &mut [f64]) {
    let mut walks = [Walk::default(); N];
    for (rays, out) in rays.chunks(N).zip(out.chunks_mut(N)) {
        together(floor, rays, range, sense, &mut walks, out);
    }
}

fn together<const N: usize>(
    floor: &Segments,
    rays: &[Ray],
    range: f64,
    sense: Sense,
    walks: &mut [Walk; N],
    out: &mut [f64],
) {
    let octants = &floor.octants;
    // Until here something nearer may come, in cells.
    let mut limits = [range * floor.per_metre; N];
    let mut best = [f64::INFINITY; N];
    // Numbers of the rays that came to another cell; its place, what is there, and whether it is
    // near enough. Those whose cell has stretches look at them.
    let (mut moved, mut looks) = ([0_u8; N], [0_u8; N]);
    let (mut places, mut sides, mut near) = ([0_u32; N], [0_u8; N], [true; N]);
    let mut count = 0;
    for ((at, ray), walk) in rays.iter().enumerate().zip(walks.iter_mut()) {
        let from = floor.in_cells(ray.from);
        if octants.holds(from) {
            *walk = octants.begin(from, ray.along);
            moved[count % N] = at as u8;
            places[count % N] = walk.place();
            count += 1;
        } else {
            // Seldom: it is asked alone.
            let hit = floor.hit(ray, range, sense);
            best[at] = hit.map_or(f64::INFINITY, |it| it.distance);
        }
    }
    while count > 0 {
        let last = core::mem::take(&mut count).min(N);
        octants.sides(&places[..last], &mut sides);
        let mut looking = 0;
        for place in 0..last {
            let (at, side, is_near) = (moved[place], sides[place], usize::from(near[place]));
            walks[at as usize % N].side = side;
            moved[count % N] = at;
            count += usize::from(is_open(side)) & is_near;
            looks[looking % N] = at;
            looking += usize::from(side == 0) & is_near;
        }
        for place in 0..count.min(N) {
            let at = moved[place] as usize % N;
            let walk = &mut walks[at];
            walk.go();
            places[place] = walk.place();
            near[place] = walk.distance <= limits[at];
        }
        for at in looks.iter().take(looking) {
            let (place, number) = (count % N, *at as usize % N);
            let (walk, limit) = (&mut walks[number], &mut limits[number]);
            let Some(ray) = rays.get(number) else { continue };
            best[number] = floor.nearest_here(walk, ray, sense, best[number]).0;
            *limit = limit.min(best[number] * floor.per_metre);
            walk.go_one();
            (moved[place], places[place]) = (*at, walk.place());
            near[place] = true;
            count += usize::from(walk.distance <= *limit);
        }
    }
    for (best, out) in best.iter().zip(out) {
        *out = if *best <= range { *best } else { f64::INFINITY };
    }
}

//! Many rays at once.

use super::Grid;
use crate::geometry::Ray;
use crate::octants::Walk;
use crate::surface::{Sense, Surface};

/// So many rays go together: their state stays in the first cache.
const TOGETHER: usize = 256;

/// Writes how far each ray goes; infinity where nothing is within the range.
///
/// Each ray goes one step, again and again, so that the processor works on several at once; those
/// that have come to their end are left out without a branch.
pub(super) fn march(grid: &Grid, rays: &[Ray], range: f64, out: &mut [f64]) {
    #[allow(clippy::large_stack_arrays, reason = "22 KiB in the first cache, not on the heap")]
    let mut walks = [Walk::default(); TOGETHER];
    for (rays, out) in rays.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER)) {
        together(grid, rays, range, &mut walks, out);
    }
}

fn together(grid: &Grid, rays: &[Ray], range: f64, walks: &mut [Walk; TOGETHER], out: &mut [f64]) {
    let octants = &grid.octants;
    let most = range * grid.per_metre;
    // Numbers of the rays that are on their way.
    let mut open = [0_u8; TOGETHER];
    let mut count = 0;
    for ((at, ray), walk) in rays.iter().enumerate().zip(walks.iter_mut()) {
        let from = grid.in_cells(ray.from);
        open[count % TOGETHER] = at as u8;
        if octants.holds(from) {
            let mut it = octants.walk(from, ray.along);
            // Nearly all begin in an empty cell: the first step is foreseen.
            if it.is_open() {
                octants.step(&mut it);
            }
            count += usize::from(it.is_open()) & usize::from(it.distance <= most);
            *walk = it;
        } else {
            // Seldom: it is asked alone, below.
            *walk = Walk::default();
            walk.distance = f64::NAN;
        }
    }
    while count > 0 {
        let last = core::mem::take(&mut count);
        for place in 0..last.min(TOGETHER) {
            let at = open[place];
            let walk = &mut walks[at as usize];
            octants.step(walk);
            open[count % TOGETHER] = at;
            // Both are looked at: to skip one would be a branch.
            count += usize::from(walk.is_open()) & usize::from(walk.distance <= most);
        }
    }
    for ((walk, out), ray) in walks.iter().zip(out).zip(rays) {
        let hits = walk.has_hit() && walk.distance <= most;
        *out = if hits { walk.distance * grid.resolution } else { f64::INFINITY };
        if walk.distance.is_nan() {
            *out = grid.hit(ray, range, Sense::Light).map_or(f64::INFINITY, |it| it.distance);
        }
    }
}

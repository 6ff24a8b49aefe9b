//! Many rays at once.

use super::Grid;
use crate::geometry::Ray;
use crate::octants::{Walk, is_open};
use crate::surface::{Sense, Surface};

/// So many rays go together: their state stays in the first cache.
const MANY: usize = 128;
/// So many are not worth the room of many: those of a sonar.
const FEW: usize = 16;

/// Writes how far each ray goes; infinity where nothing is within the range.
pub(super) fn march(grid: &Grid, rays: &[Ray], range: f64, out: &mut [f64]) {
    if rays.len() <= FEW {
        by::<FEW>(grid, rays, range, out);
    } else {
        by::<MANY>(grid, rays, range, out);
    }
}

fn by<const N: usize>(grid: &Grid, rays: &[Ray], range: f64, out: &mut [f64]) {
    let mut walks = [Walk::default(); N];
    for (rays, out) in rays.chunks(N).zip(out.chunks_mut(N)) {
        together(grid, rays, range, &mut walks, out);
    }
}

/// Takes each ray one step, again and again, so that the processor works on several at once; those
/// that have come to their end are left out without a branch. All look at their next cells at one
/// go: a ray that waits for memory keeps no other from its arithmetic.
fn together<const N: usize>(
    grid: &Grid,
    rays: &[Ray],
    range: f64,
    walks: &mut [Walk; N],
    out: &mut [f64],
) {
    let octants = &grid.octants;
    let most = range * grid.per_metre;
    // Numbers of the rays that are on their way; the places of their cells, what is there, and
    // whether these are within the range.
    let (mut open, mut places) = ([0_u8; N], [0_u32; N]);
    let (mut sides, mut near) = ([0_u8; N], [true; N]);
    let mut count = 0;
    for ((at, ray), walk) in rays.iter().enumerate().zip(walks.iter_mut()) {
        let from = grid.in_cells(ray.from);
        if octants.holds(from) {
            *walk = octants.begin(from, ray.along);
            open[count % N] = at as u8;
            places[count % N] = walk.place();
            count += 1;
        } else {
            // Seldom: it is asked alone, below.
            *walk = Walk::default();
            walk.distance = f64::NAN;
        }
    }
    while count > 0 {
        let last = core::mem::take(&mut count).min(N);
        octants.sides(&places[..last], &mut sides);
        for place in 0..last {
            let (at, side) = (open[place], sides[place]);
            walks[at as usize % N].side = side;
            open[count % N] = at;
            // Both are looked at: to skip one would be a branch.
            count += usize::from(is_open(side)) & usize::from(near[place]);
        }
        for place in 0..count.min(N) {
            let walk = &mut walks[open[place] as usize % N];
            walk.go();
            places[place] = walk.place();
            near[place] = walk.distance <= most;
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

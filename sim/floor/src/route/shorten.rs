//! Straight lines in place of steps from cell to cell.

use super::Needs;
use crate::geometry::Point;
use crate::surface::Surface;

/// A line is looked at in steps of at least so much, in metres.
const STEP_M: f64 = 0.005;
/// So much less room than what it replaces is allowed to a straight line, in metres.
const LESS_M: f64 = 0.02;

/// Whether a disc finds room all along a straight line, to half of [`STEP_M`].
pub(super) fn is_free(surface: &dyn Surface, from: Point, to: Point, radius: f64) -> bool {
    let length = (to - from).norm();
    let mut done = 0.0;
    loop {
        let part = if length > 0.0 { done / length } else { 0.0 };
        let at = from + (to - from) * part;
        let room = surface.clearance(at, radius + length - done);
        if room < radius {
            return false;
        }
        if done >= length {
            return true;
        }
        // So far nothing can be nearer than the radius.
        done = (done + (room - radius).max(STEP_M)).min(length);
    }
}

/// Returns the points that are left when straight lines replace what they may.
pub(super) fn shorten(surface: &dyn Surface, needs: Needs, points: &[Point]) -> Vec<Point> {
    let most = needs.liked_m.max(needs.radius_m);
    let rooms: Vec<f64> = points.iter().map(|it| surface.clearance(*it, most)).collect();
    let mut kept = Vec::new();
    let mut at = 0;
    while let Some(from) = points.get(at) {
        kept.push(*from);
        let mut next = at + 1;
        let mut least = rooms[at].min(rooms.get(next).copied().unwrap_or(most));
        for to in at + 2..points.len() {
            least = least.min(rooms[to]);
            let wanted = (least - LESS_M).max(needs.radius_m);
            if !is_free(surface, *from, points[to], wanted) {
                break;
            }
            next = to;
        }
        at = next;
    }
    kept
}

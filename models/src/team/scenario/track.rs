//! The track of a way on a floor: where one is after a length.

/// The corners of a way in mm, with the length up to each in µm.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Track {
    points: Vec<[i32; 2]>,
    lengths: Vec<u64>,
}

impl Track {
    pub(super) fn of(points: &[[i32; 2]]) -> Self {
        let mut lengths = Vec::with_capacity(points.len());
        let (mut length, mut last) = (0_u64, points.first().copied());
        for point in points {
            let from = last.replace(*point).unwrap_or(*point);
            let side = |axis: usize| i64::from(point[axis]).abs_diff(i64::from(from[axis])) * 1_000;
            // Floors are at most 10 km wide: squares of µm fit in 128 bits.
            let square = u128::from(side(0)).pow(2) + u128::from(side(1)).pow(2);
            length += u64::try_from(square.isqrt()).unwrap_or(u64::MAX);
            lengths.push(length);
        }
        Self { points: points.to_vec(), lengths }
    }

    /// Returns the place after a part of the way, in mm: one interpolation.
    pub(super) fn at(&self, done: u64, whole: u64) -> Option<[i32; 2]> {
        let all = u128::from(*self.lengths.last()?);
        let gone = all * u128::from(done.min(whole)) / u128::from(whole.max(1));
        let gone = u64::try_from(gone).ok()?;
        let next = self.lengths.partition_point(|it| *it < gone).min(self.lengths.len() - 1);
        let before = next.saturating_sub(1);
        let (from, to) = (self.points[before], self.points[next]);
        let span = i64::try_from(self.lengths[next] - self.lengths[before]).ok()?.max(1);
        let part = i64::try_from(gone - self.lengths[before]).ok()?;
        let axis = |it: usize| {
            let way = i128::from(i64::from(to[it]) - i64::from(from[it])) * i128::from(part);
            // To the nearest mm.
            let moved = (2 * way + i128::from(span)).div_euclid(2 * i128::from(span));
            i32::try_from(i128::from(from[it]) + moved).unwrap_or(to[it])
        };
        Some([axis(0), axis(1)])
    }

    /// Returns the corners between two parts of the way, each with the part at which it is, in the
    /// order of a drive from the first to the second.
    pub(super) fn between(&self, start: u64, end: u64, whole: u64) -> Vec<(u64, [i32; 2])> {
        let all = u128::from(self.lengths.last().copied().unwrap_or(0)).max(1);
        let part = |length: u64| {
            let part = (u128::from(length) * u128::from(whole) + all / 2) / all;
            u64::try_from(part).unwrap_or(whole)
        };
        let (low, high) = (start.min(end), start.max(end));
        let corners = self.lengths.iter().zip(&self.points).map(|it| (part(*it.0), *it.1));
        let mut corners: Vec<_> = corners.filter(|it| it.0 > low && it.0 < high).collect();
        if start > end {
            corners.reverse();
        }
        corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_track_is_followed_around_its_corner() {
        let track = Track::of(&[[0, 0], [4_000, 0], [4_000, -3_000]]);
        let at = |done| track.at(done, 7_000).unwrap();
        assert_eq!(
            [0, 4_000, 5_000, 7_000, 9_000].map(at),
            [[0, 0], [4_000, 0], [4_000, -1_000], [4_000, -3_000], [4_000, -3_000]]
        );
        // The file says half as much as the floor: half of it is the same place.
        assert_eq!(track.at(2_500, 3_500), Some([4_000, -1_000]));
        assert_eq!(track.between(1_000, 6_000, 7_000), [(4_000, [4_000, 0])]);
        assert_eq!(track.between(7_000, 0, 7_000), [(4_000, [4_000, 0])]);
    }
}

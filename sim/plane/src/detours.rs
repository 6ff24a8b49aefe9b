//! Lengths along a path that was changed on the way, beside those that the mission counts.

/// The way that a changed path is longer by. Within a leg it is driven first: until then the robot
/// is as far along its mission as it was, so that a new path that comes back to the old one counts
/// there as the old one did.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Detours {
    /// The length along the path beyond that of the mission, when the path was changed last.
    before: f64,
    legs: Vec<Longer>,
}

/// A leg, and by how much it is longer than the mission says; all in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Longer {
    x: f64,
    along: f64,
    by: f64,
}

impl Detours {
    /// A path that was changed at a length of the mission and of the path; each leg from there on
    /// ends at a length of the mission, and is so long.
    pub(crate) fn from(x: f64, along: f64, legs: impl Iterator<Item = (f64, f64)>) -> Self {
        let (mut x, mut along, before) = (x, along, along - x);
        let leg = |(end, length): (f64, f64)| {
            let it = Longer { x, along, by: length - (end - x) };
            (x, along) = (end, along + length);
            it
        };
        Self { before, legs: legs.map(leg).collect() }
    }

    /// Makes the path longer from a length of the mission and of the path on.
    pub(crate) fn lengthen(&mut self, x: f64, along: f64, by: f64) {
        self.legs.push(Longer { x, along, by });
    }

    /// Whether the path is that of the mission.
    pub(crate) fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the length along the path at which a leg of the mission ends.
    pub(crate) fn goal(&self, x: f64) -> f64 {
        let longer = self.legs.iter().filter(|it| it.x < x).map(|it| it.by);
        x + self.before + longer.sum::<f64>()
    }

    /// Returns the length that the mission counts for one along the path.
    pub(crate) fn x(&self, along: f64) -> f64 {
        let (mut by, mut least) = (self.before, 0.0);
        for it in self.legs.iter().take_while(|it| it.along <= along) {
            (by, least) = (by + it.by, it.x);
        }
        (along - by).max(least)
    }

    /// Returns the way that is longer still, from a place on.
    pub(crate) fn owed(&self, x: f64, along: f64) -> f64 {
        let all = self.before + self.legs.iter().map(|it| it.by).sum::<f64>();
        (all + x - along).max(0.0)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // halves
mod tests {
    use super::*;

    #[test]
    fn a_detour_is_driven_before_the_mission_counts_on() {
        assert_eq!(Detours::default().x(3.5), 3.5);
        // At 2 m a leg that ends at 6 m becomes 10 m long, and the next, of 2 m, stays.
        let it = Detours::from(2.0, 2.0, [(6.0, 10.0), (8.0, 2.0)].into_iter());
        assert_eq!(
            [2.0, 7.5, 8.0, 10.0, 12.0, 13.0].map(|along| it.x(along)),
            [2.0, 2.0, 2.0, 4.0, 6.0, 7.0]
        );
        assert_eq!([it.goal(6.0), it.goal(8.0)], [12.0, 14.0]);
        assert_eq!([it.owed(2.0, 2.0), it.owed(2.0, 7.5), it.owed(4.0, 10.0)], [6.0, 0.5, 0.0]);
    }

    #[test]
    fn a_path_that_is_longer_is_owed_from_where_it_is() {
        let mut it = Detours::default();
        it.lengthen(3.0, 3.0, 2.0);
        it.lengthen(6.0, 8.0, 1.0);
        assert_eq!(
            [2.0, 3.0, 5.0, 8.0, 9.0, 10.0].map(|at| it.x(at)),
            [2.0, 3.0, 3.0, 6.0, 6.0, 7.0]
        );
        assert_eq!([it.goal(3.0), it.goal(6.0), it.goal(9.0)], [3.0, 8.0, 12.0]);
        assert_eq!([it.owed(6.0, 8.0), it.owed(6.0, 8.5)], [1.0, 0.5]);
    }
}

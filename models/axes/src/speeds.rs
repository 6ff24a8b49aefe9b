//! Speeds that a robot knows: multiples of a step, or a few levels.

/// The speeds that a robot drives; derived speeds are among them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Speeds {
    /// Multiples of a step.
    Step {
        /// The lowest speed, and the distance from one to the next, mm/s.
        step_mm_s: i64,
        /// The robot is never faster, mm/s.
        most_mm_s: i64,
    },
    /// A few speeds in mm/s, in rising order: Section 5 of Lambert et al. prints four.
    Levels(Vec<i64>),
}

impl Speeds {
    /// Number of speeds.
    ///
    /// ```
    /// use cotama_axes::Speeds;
    /// assert_eq!(Speeds::Step { step_mm_s: 10, most_mm_s: 765 }.count(), 76);
    /// assert_eq!(Speeds::Levels(vec![330, 410]).count(), 2);
    /// ```
    pub fn count(&self) -> usize {
        match self {
            Self::Step { step_mm_s, most_mm_s } => {
                most_mm_s.checked_div(*step_mm_s).and_then(|it| it.try_into().ok()).unwrap_or(0)
            }
            Self::Levels(all) => all.len(),
        }
    }

    /// Returns the number of speeds that are no higher than one in mm/s.
    ///
    /// ```
    /// use cotama_axes::Speeds;
    /// assert_eq!(Speeds::Step { step_mm_s: 10, most_mm_s: 765 }.up_to(419), 41);
    /// assert_eq!(Speeds::Levels(vec![330, 410]).up_to(410), 2);
    /// ```
    pub fn up_to(&self, most_mm_s: i64) -> usize {
        match self {
            Self::Step { step_mm_s, most_mm_s: own } => {
                Self::Step { step_mm_s: *step_mm_s, most_mm_s: most_mm_s.min(*own).max(0) }.count()
            }
            Self::Levels(all) => all.iter().filter(|it| **it <= most_mm_s).count(),
        }
    }

    /// Returns the speed of this number, from 0 and the lowest, in mm/s; zero beyond the last.
    pub fn at(&self, number: usize) -> i64 {
        match self {
            Self::Step { step_mm_s, .. } => {
                i64::try_from(number + 1).unwrap_or(0).saturating_mul(*step_mm_s)
            }
            Self::Levels(all) => all.get(number).copied().unwrap_or(0),
        }
    }

    /// Returns the next speed above one, in mm/s; none above the highest.
    ///
    /// ```
    /// use cotama_axes::Speeds;
    /// let levels = Speeds::Levels(vec![330, 410, 560]);
    /// assert_eq!((levels.above(410), levels.above(560)), (Some(560), None));
    /// assert_eq!(Speeds::Step { step_mm_s: 10, most_mm_s: 760 }.above(410), Some(420));
    /// ```
    pub fn above(&self, speed_mm_s: i64) -> Option<i64> {
        match self {
            Self::Step { step_mm_s, most_mm_s } => {
                Some(speed_mm_s + step_mm_s).filter(|it| it <= most_mm_s)
            }
            Self::Levels(all) => all.iter().copied().find(|it| *it > speed_mm_s),
        }
    }

    /// Returns the highest speed, mm/s.
    pub fn highest(&self) -> i64 {
        self.count().checked_sub(1).map_or(0, |it| self.at(it))
    }
}

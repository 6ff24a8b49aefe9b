//! Seeded instances of the allocation problem: small ones for brute force, and missions like the
//! paper's. Integers only, so that a seed gives the same instance on every machine.

pub use crate::draw::Draw;
use cotama_core::problem::{Candidate, Problem};

/// An instance that owns its tables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance<const A: usize> {
    /// Candidates of each activity.
    pub activities: Vec<Vec<Candidate<A>>>,
    /// The inclusive limit of each axis.
    pub limits: [u64; A],
}

impl<const A: usize> Instance<A> {
    /// The candidates as the allocators borrow them.
    #[must_use]
    pub fn slices(&self) -> Vec<&[Candidate<A>]> {
        self.activities.iter().map(Vec::as_slice).collect()
    }

    /// The problem over borrowed slices, axes treated as they are numbered.
    ///
    /// # Panics
    /// When an activity has no candidate.
    #[must_use]
    pub fn problem<'a>(&self, slices: &'a [&'a [Candidate<A>]]) -> Problem<'a, A> {
        Problem::new(slices, self.limits, core::array::from_fn(|axis| axis))
            .expect("an instance is a problem")
    }

    /// Sets each limit at a share, in permille, of the way from the least to the largest total of
    /// its axis.
    #[must_use]
    pub fn limited(activities: Vec<Vec<Candidate<A>>>, permille: [u64; A]) -> Self {
        let limits = core::array::from_fn(|axis| {
            let sum = |pick: fn(u64, u64) -> u64| -> u64 {
                activities
                    .iter()
                    .map(|c| c.iter().map(|c| u64::from(c.cost[axis])).reduce(pick).unwrap_or(0))
                    .sum()
            };
            let (least, most) = (sum(u64::min), sum(u64::max));
            least + (most - least) * permille[axis] / 1000
        });
        Self { activities, limits }
    }
}

/// Robot-like travel: 7 moving options times 3 localisations on a stretch of corridor, with the
/// patrol's speeds and powers.
#[must_use]
pub fn travel(
    draw: &mut Draw,
    zone_speed: u64,
    allowed: impl Fn(u64, usize) -> bool,
) -> Vec<Candidate<2>> {
    let length = draw.between(5, 400) * 100;
    // Sonar rings and lasers of M1..M7; Kinect and lasers of L1..L3, and their quality.
    let moving = [(1, 0), (1, 0), (0, 1), (0, 2), (1, 2), (1, 2), (0, 2)];
    let localisation = [(0, 0, 0), (1, 0, 3), (0, 2, 2)];
    let mut candidates = Vec::new();
    for (sonar, lasers) in moving {
        for (place, (kinect, more_lasers, quality)) in localisation.into_iter().enumerate() {
            if !allowed(sonar, place) {
                continue;
            }
            let speed: u64 = if kinect > 0 { zone_speed.min(410) } else { zone_speed };
            let motion =
                4890 + (3930 * speed + 500) / 1000 + (8466 * speed * speed + 500_000) / 1_000_000;
            let power = motion + 1300 * sonar + 2200 * lasers.max(more_lasers) + 4600 * kinect;
            let duration = (length * 1000 + speed / 2) / speed;
            candidates.push(Candidate {
                cost: [duration as u32, ((power * duration + 500) / 1000) as u32],
                quality: ((3 * quality + sonar + lasers) * (length / 100)) as u32,
                id: candidates.len() as u16,
            });
        }
    }
    candidates
}

/// Which speed limits the zones of a mission have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zones {
    /// Each its own, from 300 to 600 mm/s.
    Varied,
    /// The patrol's three, 330, 410 and 560 mm/s: many activities then share the very same ratio of
    /// quality to energy, which makes a long mission a subset-sum problem and the hardest kind
    /// here.
    Three,
}

impl Zones {
    /// The speed limit of one zone, in mm/s.
    #[must_use]
    pub fn speed(self, draw: &mut Draw) -> u64 {
        match self {
            Self::Varied => draw.between(300, 600),
            Self::Three => [330, 410, 560][draw.between(0, 2) as usize],
        }
    }
}

/// Missions like the paper's: stretches with 21, 12 or 4 candidates, and at every fourth place a
/// turn, a detection and a turn.
#[must_use]
pub fn paper_like(activities: usize, zones: Zones, permille: [u64; 2], seed: u64) -> Instance<2> {
    let mut draw = Draw::new(seed);
    let fixed = |duration: u64, options: &[(u64, u64)]| {
        let each = options.iter().enumerate().map(|(id, &(power, quality))| Candidate {
            cost: [duration as u32, (power * duration / 1000) as u32],
            quality: quality as u32,
            id: id as u16,
        });
        each.collect::<Vec<_>>()
    };
    let (turn, detection) = ([(7_500, 0), (12_100, 30), (11_900, 20)], [(9_490, 10), (11_100, 20)]);
    let mut made = Vec::new();
    while made.len() < activities {
        match made.len() % 7 {
            3 | 5 => made.push(fixed(draw.between(6_000, 10_000), &turn)),
            4 => made.push(fixed(draw.between(10_000, 18_000), &detection)),
            _ => {
                let speed = zones.speed(&mut draw);
                made.push(match draw.between(0, 3) {
                    0 => travel(&mut draw, speed, |sonar, place| sonar == 1 && place == 1),
                    1 => travel(&mut draw, speed, |sonar, _| sonar == 1),
                    _ => travel(&mut draw, speed, |_, _| true),
                });
            }
        }
    }
    Instance::limited(made, permille)
}

/// A mission of 17 activities like the paper's, with either kind of zones and limits anywhere
/// between least and most.
#[must_use]
pub fn random_mission(seed: u64) -> Instance<2> {
    let mut draw = Draw::new(seed);
    let zones = [Zones::Varied, Zones::Three][draw.between(0, 1) as usize];
    paper_like(17, zones, [draw.between(0, 1000), draw.between(0, 1000)], seed)
}

/// A small problem for comparison with brute force: costs and qualities from a small range, so that
/// ties, equal candidates and infeasible limits are frequent.
#[must_use]
pub fn small<const A: usize>(seed: u64) -> Instance<A> {
    let mut draw = Draw::new(seed);
    let largest = [3, 10, 100, 1_000_000, u64::from(u32::MAX)][draw.between(0, 4) as usize];
    let activities = (0..draw.between(1, 5))
        .map(|_| {
            (0..draw.between(1, 5))
                .map(|id| Candidate {
                    cost: core::array::from_fn(|_| draw.between(0, largest) as u32),
                    quality: draw.between(0, largest) as u32,
                    id: id as u16,
                })
                .collect()
        })
        .collect();
    let permille = core::array::from_fn(|_| draw.between(0, 1000));
    let mut instance = Instance::limited(activities, permille);
    if draw.between(0, 5) == 0 {
        let axis = draw.between(0, A as u64 - 1) as usize;
        instance.limits[axis] = draw.between(0, instance.limits[axis]);
    }
    instance
}

//! Which robot answers for which coalition (Algorithm A.1).

use super::bit;
use cotama_core::team::RobotSet;

/// All coalitions of `N` robots but the empty one, by falling size, within a size in the order of
/// their members, each with the robot that answers for it: they are dealt round robin, and a robot
/// is passed over whose coalitions would have more than half of all members together.
///
/// ```
/// use cotama_models::team::thesis::Shares;
/// let dealt: Vec<_> = Shares::<2>::new().collect();
/// assert_eq!(dealt, [(0b11, 0), (0b01, 1), (0b10, 1)]);
/// ```
#[derive(Clone, Debug)]
pub struct Shares<const N: usize> {
    /// The members of the next coalition, by rising number; the first `size` of them count.
    members: [usize; N],
    size: usize,
    /// The robot whose turn it is, and the number of members of each.
    turn: usize,
    load: [u64; N],
}

impl<const N: usize> Shares<N> {
    /// From the coalition of all robots on; `N` is at most 63.
    #[must_use]
    pub fn new() -> Self {
        Self { members: core::array::from_fn(|it| it), size: N, turn: 0, load: [0; N] }
    }

    /// The next coalition of the same size, or the first that is smaller by one.
    fn step(&mut self) {
        let size = self.size;
        for at in (0..size).rev() {
            let last = N.saturating_sub(size).saturating_add(at);
            let Some(member) = self.members.get(at).copied().filter(|it| *it < last) else {
                continue;
            };
            let rest = self.members.iter_mut().take(size).skip(at);
            rest.zip(member.saturating_add(1)..=N).for_each(|(it, next)| *it = next);
            return;
        }
        self.size = size.saturating_sub(1);
        self.members = core::array::from_fn(|it| it);
    }
}

impl<const N: usize> Default for Shares<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Iterator for Shares<N> {
    type Item = (RobotSet, usize);

    fn next(&mut self) -> Option<Self::Item> {
        if self.size == 0 {
            return None;
        }
        let set = self.members.iter().take(self.size).fold(0, |set, it| set | bit(*it));
        let most = 1_u64.wrapping_shl((N as u32).saturating_sub(1));
        let fits = |robot: &usize| {
            let load = self.load.get(*robot).copied().unwrap_or(u64::MAX);
            load.saturating_add(self.size as u64) <= most
        };
        let robot = (self.turn..N).chain(0..self.turn).find(fits)?;
        if let Some(it) = self.load.get_mut(robot) {
            *it = it.saturating_add(self.size as u64);
        }
        self.turn = robot.saturating_add(1).checked_rem(N).unwrap_or(0);
        self.step();
        Some((set, robot))
    }
}

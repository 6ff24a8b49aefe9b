//! Counts for the last levels of the walk over subsets, all at once: a cell is a table of their
//! states, with a place for the sum over each of them. All sums of some cells side by side are
//! made, and all subsets of these levels read what they need.

/// Cells that are counted side by side.
pub(super) const LANES: usize = 8;

/// The most places of a table, all of which are looked at for each cell: four levels of three
/// states, five of two.
const PLACES: usize = 256;

/// The last levels, as many as a table has places for.
#[derive(Default)]
pub(super) struct Tail {
    pub(super) levels: usize,
    /// Shift of their states in an entry.
    shift: u32,
    /// For the bits of their states the place in a table.
    places: Vec<u16>,
    /// For each level how far apart in a table its states are, and how many.
    steps: Vec<(usize, usize)>,
    /// For each subset of the levels what it reads; the first level has the most significant bit.
    pub(super) parts: Vec<Part>,
}

/// A subset of the last levels.
pub(super) struct Part {
    /// How far it moves the number of a table of `f`.
    pub(super) stride: usize,
    /// Places of sums over all other levels.
    pub(super) places: Vec<u16>,
}

impl Tail {
    /// The tail of levels with so many states, shifts in an entry, and strides of tables of `f`.
    pub(super) fn new(states: &[usize], shifts: &[u32], strides: &[usize]) -> Self {
        let (mut first, mut size) = (states.len(), 1);
        while first > 0 && size * (states[first - 1] + 1) <= PLACES {
            first -= 1;
            size *= states[first] + 1;
        }
        let levels = states.len() - first;
        let mut steps = vec![(1, 0); levels];
        let mut step = 1;
        for (own, states) in steps.iter_mut().zip(&states[first..]) {
            *own = (step, *states);
            step *= states + 1;
        }
        let ends: Vec<u32> = shifts[first..].iter().map(|it| it - shifts[first]).collect();
        let place = |bits: usize| {
            let state = |it: usize| bits >> ends[it] & ((1 << (ends[it + 1] - ends[it])) - 1);
            (0..levels).map(|it| state(it) * steps[it].0).sum::<usize>() as u16
        };
        let part = |mask: usize| {
            let has = |level: usize| mask >> (levels - 1 - level) & 1 == 1;
            let reads = |place: &u16| {
                let is_state = |(step, states): (usize, usize)| {
                    usize::from(*place) / step % (states + 1) < states
                };
                (0..levels).all(|it| is_state(steps[it]) == has(it))
            };
            Part {
                stride: (0..levels).filter(|it| has(*it)).map(|it| strides[first + it]).sum(),
                places: (0..size as u16).filter(reads).collect(),
            }
        };
        Self {
            levels,
            shift: shifts[first],
            places: (0..1 << ends[levels]).map(place).collect(),
            parts: (0..1 << levels).map(part).collect(),
            steps,
        }
    }

    /// Places of a table.
    pub(super) fn size(&self) -> usize {
        self.steps.iter().map(|it| it.1 + 1).product()
    }

    /// The place of an entry whose other levels were cut off.
    pub(super) fn place(&self, entry: u64) -> usize {
        usize::from(self.places[(entry >> self.shift) as usize])
    }

    /// Fills places of sums, which are 0.
    pub(super) fn add_up(&self, grid: &mut [[u32; LANES]]) {
        for &(step, states) in &self.steps {
            for block in grid.chunks_exact_mut(step * (states + 1)) {
                let (own, sums) = block.split_at_mut(step * states);
                for own in own.chunks_exact(step) {
                    let pairs = sums.as_flattened_mut().iter_mut().zip(own.as_flattened());
                    pairs.for_each(|(sum, own)| *sum += own);
                }
            }
        }
    }
}

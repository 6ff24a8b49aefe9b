//! Rows of numbers of which small ones are good, and whether one of them is nowhere above another.

/// A leaf has at most so many rows.
const LEAF: usize = 16;

/// Undominated rows, split by place: a tree as that of Jaszkiewicz and Lust, "ND-Tree-based
/// update", IEEE Transactions on Evolutionary Computation 22 (2018), with halves for subtrees.
///
/// Rows come in rising order, so none that is kept is dominated by a later one.
#[derive(Debug)]
pub(crate) struct Undominated {
    width: usize,
    rows: Vec<i64>,
    nodes: Vec<Node>,
    /// For each node the least and the most of each column.
    corners: Vec<i64>,
}

#[derive(Debug)]
enum Node {
    Leaf(Vec<u32>),
    /// Rows at most so large in a column are in the first node.
    Inner {
        column: usize,
        split: i64,
        below: [usize; 2],
    },
}

impl Undominated {
    pub(crate) fn new(width: usize) -> Self {
        let mut tree = Self { width, rows: Vec::new(), nodes: Vec::new(), corners: Vec::new() };
        tree.leaf(Vec::new());
        tree
    }

    /// All rows, one behind the other.
    pub(crate) fn into_rows(self) -> Vec<i64> {
        self.rows
    }

    fn leaf(&mut self, rows: Vec<u32>) -> usize {
        self.nodes.push(Node::Leaf(rows));
        self.corners.extend(std::iter::repeat_n(i64::MAX, self.width));
        self.corners.extend(std::iter::repeat_n(i64::MIN, self.width));
        self.nodes.len() - 1
    }

    fn row(&self, number: u32) -> &[i64] {
        let start = number as usize * self.width;
        self.rows.get(start..start + self.width).unwrap_or(&[])
    }

    fn corner(&self, node: usize) -> (&[i64], &[i64]) {
        let start = 2 * node * self.width;
        self.corners.get(start..start + 2 * self.width).unwrap_or(&[]).split_at(self.width)
    }

    /// Keeps a row if none that is kept is nowhere above it; says so, and how much was looked at.
    pub(crate) fn offer(&mut self, row: &[i64]) -> (bool, u64) {
        debug_assert_eq!(row.len(), self.width);
        let mut looked = 1;
        let mut open = vec![0];
        while let Some(node) = open.pop() {
            looked += 1;
            let (least, most) = self.corner(node);
            if !within(least, row) {
                continue;
            }
            if within(most, row) {
                return (false, looked);
            }
            match self.nodes.get(node) {
                Some(Node::Inner { below, .. }) => open.extend(below),
                Some(Node::Leaf(rows)) => {
                    looked += rows.len() as u64;
                    if rows.iter().any(|&it| within(self.row(it), row)) {
                        return (false, looked);
                    }
                }
                None => {}
            }
        }
        self.insert(row);
        (true, looked)
    }

    fn insert(&mut self, row: &[i64]) {
        let number = (self.rows.len() / self.width.max(1)) as u32;
        self.rows.extend(row);
        let mut node = 0;
        loop {
            self.widen(node, row);
            match self.nodes.get_mut(node) {
                Some(Node::Inner { column, split, below: [low, high] }) => {
                    let is_low = row.get(*column).is_some_and(|it| it <= split);
                    node = if is_low { *low } else { *high };
                }
                Some(Node::Leaf(rows)) => {
                    rows.push(number);
                    if rows.len() > LEAF {
                        let rows = std::mem::take(rows);
                        self.halve(node, rows);
                    }
                    return;
                }
                None => return,
            }
        }
    }

    fn widen(&mut self, node: usize, row: &[i64]) {
        let start = 2 * node * self.width;
        let corner = self.corners.get_mut(start..start + 2 * self.width).unwrap_or_default();
        let (least, most) = corner.split_at_mut(self.width);
        for ((least, most), it) in least.iter_mut().zip(most).zip(row) {
            *least = (*least).min(*it);
            *most = (*most).max(*it);
        }
    }

    /// Makes two leaves of a full one: halves in the column in which they differ most, against the
    /// width of all rows there.
    fn halve(&mut self, node: usize, rows: Vec<u32>) {
        let (all_least, all_most) = self.corner(0);
        let (least, most) = self.corner(node);
        let share = |column: usize| {
            let at = |corner: &[i64]| corner.get(column).copied().map_or(0, i128::from);
            let whole = at(all_most) - at(all_least);
            ((at(most) - at(least)) << 62) / whole.max(1)
        };
        let column = (0..self.width).max_by_key(|&it| share(it)).unwrap_or(0);
        let value = |it: &u32| self.row(*it).get(column).copied().unwrap_or(0);
        let mut values: Vec<_> = rows.iter().map(value).collect();
        values.sort_unstable();
        let last = values.last().copied().unwrap_or(0);
        let middle = values.get(values.len() / 2).copied().unwrap_or(0);
        // Something must be above.
        let below_last = values.iter().rev().find(|&&it| it < last).copied().unwrap_or(last);
        let split = if middle < last { middle } else { below_last };
        let (low, high): (Vec<_>, Vec<_>) = rows.into_iter().partition(|it| value(it) <= split);
        let below = [low, high].map(|half| {
            let leaf = self.leaf(Vec::new());
            for &it in &half {
                let row = self.row(it).to_vec();
                self.widen(leaf, &row);
            }
            if let Some(it) = self.nodes.get_mut(leaf) {
                *it = Node::Leaf(half);
            }
            leaf
        });
        if let Some(it) = self.nodes.get_mut(node) {
            *it = Node::Inner { column, split, below };
        }
    }
}

/// Whether each number of a row is at most that of another.
pub(crate) fn within(row: &[i64], other: &[i64]) -> bool {
    row.iter().zip(other).all(|(a, b)| a <= b)
}

//! Empty rectangles: how far a ray may jump.
//!
//! A ray goes mostly along one axis, one way, and aside along the other: eight cases. For each of
//! them each cell knows the largest empty rectangle, twice as long as wide, that begins there and
//! lies that way. A ray leaves it at a line between cells, which is where the next jump begins; so
//! it finds the same cell at the same distance as a walk from cell to cell, in three steps on
//! average of the three maps that are measured (`benches/rays.rs`). A field of Euclidean distances,
//! as marches commonly use, knows nothing of the way: close to a wall its steps are short, even
//! where they lead away.
//!
//! A distance is that of a line between cells, rounded three times. The cell beside is chosen to
//! 2⁻³⁶ of a cell: a ray that passes a corner as closely as that may go on either side of it.

use crate::geometry::{Point, Vector};

/// The largest number of columns and of rows.
pub(crate) const MAX_SIDE: usize = 1 << 15;

/// With so much added, the whole part of a coordinate in cells is a field of a double's bits.
const BIAS: f64 = (1_u32 << 16) as f64;
const FRACTION: u32 = 52 - 16;

/// The largest length that is noted; all but 0 and 1 are even.
const MOST: u8 = 254;
/// The mark of what is outside, in place of a length.
const OUTSIDE: u8 = u8::MAX;

/// The half of a cell that holds its column.
const COLUMN: u64 = u32::MAX as u64;

/// Columns and rows of a rectangle by its length, the rows in the upper half.
const SHAPES: [u64; 256] = {
    let mut shapes = [0; 256];
    let mut length = 1;
    while length < 256 {
        shapes[length] = length as u64 | (length as u64).div_ceil(2) << 32;
        length += 1;
    }
    shapes
};

/// The eight tables, each turned so that its rays go to the right and less far up.
#[derive(Clone, Debug)]
pub(crate) struct Octants {
    width: usize,
    height: usize,
    /// One table behind the other, each with a column to the right and a row above that are
    /// outside.
    tables: Vec<u8>,
    /// For each case the number of the cell that its table begins with, and the steps from it to
    /// the next in its row and in its column, modulo 2³².
    turns: [[u32; 3]; 8],
}

/// A case: a bit for rays to the left, one for rays down, one for those that are steeper than 45°.
const LEFT: u32 = 1;
const DOWN: u32 = 2;
const STEEP: u32 = 4;

impl Octants {
    /// Makes the tables; `is_empty` says it of a column and a row.
    pub(crate) fn of(width: usize, height: usize, is_empty: impl Fn(usize, usize) -> bool) -> Self {
        let size = (width + 1) * (height + 1);
        let mut it = Self { width, height, tables: vec![OUTSIDE; 8 * size], turns: [[0; 3]; 8] };
        for case in 0..8 {
            let number = |x, y| {
                let (column, row) = it.turned_back(case, x, y);
                (row.wrapping_mul(width)).wrapping_add(column) as u32
            };
            let first = number(0, 0);
            let to = |next: u32| next.wrapping_sub(first);
            it.turns[case as usize] = [first, to(number(1, 0)), to(number(0, 1))];
            let (columns, rows) = if case & STEEP == 0 { (width, height) } else { (height, width) };
            let stride = columns + 1;
            for y in (0..rows).rev() {
                for x in (0..columns).rev() {
                    let (column, row) = it.turned_back(case, x, y);
                    let is_empty = is_empty(column, row);
                    let table = &mut it.tables[case as usize * size..][..size];
                    let at = y * stride + x;
                    let next = |at: usize| match table.get(at) {
                        None | Some(&OUTSIDE) => 0,
                        Some(length) => length & MOST,
                    };
                    // Two cells in a row make the first rectangle; three and those two the next.
                    table[at] = if !is_empty {
                        0
                    } else if matches!(table[at + 1], 0 | OUTSIDE) {
                        1
                    } else {
                        let above = at + stride;
                        let beyond = if x + 2 > columns { 0 } else { next(at + 2) };
                        let least = next(above).min(beyond).min(next(above + 2));
                        least.min(MOST - 2) + 2
                    };
                }
            }
        }
        it
    }

    /// Turns a cell of a table back.
    fn turned_back(&self, case: u32, x: usize, y: usize) -> (usize, usize) {
        let (x, y) = if case & STEEP == 0 { (x, y) } else { (y, x) };
        let column = if case & LEFT == 0 { x } else { (self.width - 1).wrapping_sub(x) };
        (column, if case & DOWN == 0 { y } else { (self.height - 1).wrapping_sub(y) })
    }

    /// Returns how many cells around a cell, in each way, are empty with it: 0 if it is not.
    pub(crate) fn around(&self, column: usize, row: usize) -> usize {
        let least = |case: u32| {
            let x = if case & LEFT == 0 { column } else { self.width - 1 - column };
            let y = if case & DOWN == 0 { row } else { self.height - 1 - row };
            let (x, y, stride) =
                if case & STEEP == 0 { (x, y, self.width + 1) } else { (y, x, self.height + 1) };
            let at = case as usize * (self.width + 1) * (self.height + 1) + y * stride + x;
            self.tables.get(at).copied().unwrap_or(0).div_ceil(2)
        };
        (0..8).map(least).min().unwrap_or(0).into()
    }

    /// Whether a point in cells is inside, or on the border.
    #[inline]
    pub(crate) fn holds(&self, at: Point) -> bool {
        let (width, height) = (self.width as f64, self.height as f64);
        at.x >= 0.0 && at.y >= 0.0 && at.x <= width && at.y <= height
    }

    /// Returns how far a ray from outside goes before it enters, in cells; `None` if never.
    pub(crate) fn entry(&self, from: Point, along: Vector) -> Option<f64> {
        let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
        let sizes = [self.width as f64, self.height as f64];
        for ((from, along), size) in from.iter().zip(along.iter()).zip(sizes) {
            if !from.is_finite() || (*along == 0.0 && !(0.0..=size).contains(from)) {
                return None;
            }
            if *along != 0.0 {
                let (one, two) = (-from / along, (size - from) / along);
                enters = enters.max(one.min(two));
                leaves = leaves.min(one.max(two));
            }
        }
        (enters <= leaves).then_some(enters)
    }

    /// Begins a ray at a point in cells, inside; from outside see [`entry`](Self::entry).
    #[inline]
    pub(crate) fn walk(&self, from: Point, along: Vector) -> Walk {
        let mut it = self.begin(from, along);
        it.side = self.side(it.place());
        it
    }

    /// Begins a ray, but does not look at the cell where it begins.
    #[inline]
    pub(crate) fn begin(&self, from: Point, along: Vector) -> Walk {
        let (width, height) = (self.width as u32, self.height as u32);
        let (left, down) = (along.x < 0.0, along.y < 0.0);
        let x = if left { f64::from(width) - from.x } else { from.x };
        let y = if down { f64::from(height) - from.y } else { from.y };
        let (along_x, along_y) = (along.x.abs(), along.y.abs());
        let steep = along_y > along_x;
        // Choosing by place does not branch.
        let (one, two) = (usize::from(steep), usize::from(!steep));
        let (from, along) = ([x, y], [along_x, along_y]);
        let (x, y) = (from[one], from[two]);
        let (along_x, along_y) = (along[one], along[two]);
        let case = u32::from(left) * LEFT + u32::from(down) * DOWN + u32::from(steep) * STEEP;
        Walk {
            from: [x, y],
            biased: [x + BIAS, y + BIAS],
            along: [along_x, along_y],
            inverse: [along_x.recip(), along_y.recip()],
            cell: whole(x + BIAS) | whole(y + BIAS) << 32,
            distance: 0.0,
            table: case * ((width + 1) * (height + 1)),
            stride: [width, height][one] + 1,
            side: 0,
            case: case as u8,
        }
    }

    /// Returns the length of the empty rectangle that begins at a place of the tables, or what is
    /// there.
    #[inline]
    fn side(&self, place: u32) -> u8 {
        self.tables.get(place as usize).copied().unwrap_or(OUTSIDE)
    }

    /// Looks at many places of the tables.
    ///
    /// Nothing else is done between one and the next, so that the processor waits for all of them
    /// together where they are far in memory.
    #[inline]
    pub(crate) fn sides(&self, places: &[u32], out: &mut [u8]) {
        for (place, out) in places.iter().zip(out) {
            *out = self.side(*place);
        }
    }

    /// Goes through the empty rectangle of a walk to the cell behind it, and looks at it.
    #[inline]
    pub(crate) fn step(&self, walk: &mut Walk) {
        walk.go();
        walk.side = self.side(walk.place());
    }

    /// Goes to the next cell, whatever is in this one, and looks at it.
    pub(crate) fn step_one(&self, walk: &mut Walk) {
        walk.go_one();
        walk.side = self.side(walk.place());
    }

    /// Returns the number of the cell of a walk, which is inside: row by row from the lowest.
    #[inline]
    pub(crate) fn cell(&self, walk: &Walk) -> usize {
        let (x, y) = (walk.cell as u32, (walk.cell >> 32) as u32);
        let [first, by_x, by_y] = self.turns[usize::from(walk.case % 8)];
        // Modulo 2³²: a step to the left is a large one to the right.
        let at = first.wrapping_add(x.wrapping_mul(by_x)).wrapping_add(y.wrapping_mul(by_y));
        at as usize
    }
}

/// Returns the whole part of a coordinate to which [`BIAS`] was added.
#[inline]
fn whole(biased: f64) -> u64 {
    biased.to_bits() >> FRACTION & 0xFFFF
}

/// Whether a cell is empty, by what is noted of it.
#[inline]
pub(crate) fn is_open(side: u8) -> bool {
    side.wrapping_add(1) > 1
}

/// A ray on its way, in cells, turned so that it goes to the right and less far up.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Walk {
    from: [f64; 2],
    biased: [f64; 2],
    along: [f64; 2],
    inverse: [f64; 2],
    /// The column, and in the upper half the row.
    cell: u64,
    /// How far it went until it entered its cell.
    pub(crate) distance: f64,
    /// Begin of its table, and the width of a row of it.
    table: u32,
    stride: u32,
    /// The length of the empty rectangle that begins here; 0 where something is.
    pub(crate) side: u8,
    case: u8,
}

impl Walk {
    /// Returns the place of its cell in the tables.
    #[inline]
    pub(crate) fn place(&self) -> u32 {
        let (x, y) = (self.cell as u32, (self.cell >> 32) as u32);
        self.table + y * self.stride + x
    }

    /// Goes through its empty rectangle to the cell behind it, but does not look at that. At a
    /// corner it is the cell above, as its table is turned.
    ///
    /// Nothing branches, as a processor guesses no better than a coin which side a ray leaves by.
    #[inline]
    pub(crate) fn go(&mut self) {
        self.go_by(SHAPES[self.side as usize]);
    }

    /// Goes to the next cell, whatever is in this one, but does not look at that.
    #[inline]
    pub(crate) fn go_one(&mut self) {
        self.go_by(SHAPES[1]);
    }

    #[inline]
    fn go_by(&mut self, shape: u64) {
        let cell = self.cell;
        let end = cell + shape;
        let end_x = f64::from((end as u32).cast_signed());
        let end_y = f64::from(((end >> 32) as u32).cast_signed());
        // No error is carried on from step to step.
        let to_x = (end_x - self.from[0]) * self.inverse[0];
        let to_y = (end_y - self.from[1]) * self.inverse[1];
        let distance = if to_x < to_y { to_x } else { to_y };
        // Whether it leaves over the side of a column.
        let is_aside = to_x < to_y;
        let x = whole(self.biased[0] + distance * self.along[0]).max(cell & COLUMN);
        let y = whole(self.biased[1] + distance * self.along[1]).max(cell >> 32);
        let x = if is_aside { end & COLUMN } else { x };
        let y = if is_aside { y } else { end >> 32 };
        self.cell = x | y << 32;
        self.distance = distance;
    }

    /// Whether its cell is empty.
    #[inline]
    pub(crate) fn is_open(&self) -> bool {
        is_open(self.side)
    }

    /// Whether something is in its cell.
    #[inline]
    pub(crate) fn has_hit(&self) -> bool {
        self.side == 0
    }

    /// The axis of the floor along which it entered its cell: 0 for columns.
    pub(crate) fn axis(&self) -> usize {
        // The line of its column is where it came in, if that is as far away, bit for bit.
        let column = f64::from((self.cell as u32).cast_signed());
        let to_x = (column - self.from[0]) * self.inverse[0];
        let is_aside = to_x.to_bits() == self.distance.to_bits();
        usize::from(!is_aside) ^ usize::from(u32::from(self.case) & STEEP != 0)
    }
}

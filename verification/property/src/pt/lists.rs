//! Lists of ids with a weight each: the arcs of a net, seen from either side.

/// Lists of ids with a weight each, one list after the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lists<T> {
    starts: Vec<u32>,
    items: Vec<(u32, T)>,
}

impl<T: Copy> Lists<T> {
    /// Puts lists together.
    pub fn new<I: IntoIterator<Item = (u32, T)>>(lists: impl IntoIterator<Item = I>) -> Self {
        let mut all = Self { starts: vec![0], items: Vec::new() };
        for list in lists {
            all.items.extend(list);
            all.starts.push(all.items.len() as u32);
        }
        all
    }

    /// The list at this position; empty beyond the last.
    #[inline]
    pub fn of(&self, at: u32) -> &[(u32, T)] {
        match (self.starts.get(at as usize), self.starts.get(at as usize + 1)) {
            (Some(&start), Some(&end)) => {
                self.items.get(start as usize..end as usize).unwrap_or(&[])
            }
            _ => &[],
        }
    }

    /// Bytes.
    pub fn size(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.items[..])
    }

    /// How many lists there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is no list.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The same seen from the other side: for each of `count` ids the lists that it is in.
    #[must_use]
    pub fn reversed(&self, count: usize) -> Self {
        let mut sizes = vec![0_u32; count + 1];
        for &(id, _) in &self.items {
            sizes[id as usize + 1] += 1;
        }
        for at in 0..count {
            sizes[at + 1] += sizes[at];
        }
        let starts = sizes.clone();
        let Some(&first) = self.items.first() else { return Self { starts, items: Vec::new() } };
        let mut items = vec![first; self.items.len()];
        for list in 0..self.len() as u32 {
            for &(id, weight) in self.of(list) {
                let slot = &mut sizes[id as usize];
                items[*slot as usize] = (list, weight);
                *slot += 1;
            }
        }
        Self { starts, items }
    }
}

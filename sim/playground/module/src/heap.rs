//! A heap for one thread: blocks of powers of two, each size with a list of those given back.

use alloc::alloc::{GlobalAlloc, Layout};
use core::arch::wasm32::{memory_grow, memory_size};
use core::cell::UnsafeCell;
use core::ptr::null_mut;

const PAGE: usize = 1 << 16;
/// The smallest block; all of them are aligned to it.
const LEAST: usize = 16;
const SIZES: usize = usize::BITS as usize;

struct Heap(UnsafeCell<Lists>);

struct Lists {
    /// First free block of each size; a free block begins with the address of the next one.
    free: [usize; SIZES],
    /// Memory that was never used.
    fresh: usize,
    end: usize,
}

#[global_allocator]
static HEAP: Heap = Heap(UnsafeCell::new(Lists { free: [0; SIZES], fresh: 0, end: 0 }));

// SAFETY: a module without threads and atomics has one thread.
unsafe impl Sync for Heap {}

/// The power of two of a block for this; none if it cannot be had.
fn power(layout: Layout) -> Option<usize> {
    let size = layout.size().max(LEAST).checked_next_power_of_two()?;
    (layout.align() <= LEAST).then_some(size.trailing_zeros() as usize)
}

impl Lists {
    /// Memory for a block of this size, from the end of all memory.
    fn grow(&mut self, size: usize) -> Option<usize> {
        if self.end - self.fresh < size {
            let pages = size.div_ceil(PAGE);
            let end = memory_size(0).checked_mul(PAGE)?;
            if memory_grow(0, pages) == usize::MAX {
                return None;
            }
            // The rest before it stays unused, unless the new memory follows it.
            if end != self.end {
                self.fresh = end;
            }
            self.end = end.checked_add(pages * PAGE)?;
        }
        let at = self.fresh;
        self.fresh += size;
        Some(at)
    }
}

// SAFETY: a block has the size of its list, which is that of the layout or more, is aligned to
// `LEAST`, and is in no list while it is used: it is taken off when given out. Fresh memory is
// given out once, as `fresh` only grows.
unsafe impl GlobalAlloc for Heap {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: one thread, and no reference outlives a call.
        let lists = unsafe { &mut *self.0.get() };
        let Some(power) = power(layout) else { return null_mut() };
        match lists.free[power] {
            0 => lists.grow(1 << power).map_or(null_mut(), |it| it as *mut u8),
            first => {
                // SAFETY: a free block begins with the address of the next one.
                lists.free[power] = unsafe { *(first as *const usize) };
                first as *mut u8
            }
        }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: as above.
        let lists = unsafe { &mut *self.0.get() };
        let Some(power) = power(layout) else { return };
        // SAFETY: the block is nobody's any more, aligned to `LEAST`, and holds an address.
        unsafe { *block.cast::<usize>() = lists.free[power] };
        lists.free[power] = block as usize;
    }
}

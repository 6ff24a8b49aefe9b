//! Functions that must not link: where one of them does, the check is blind.

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `canary_`, which nothing else does.

/// An index beyond the end is a panic.
#[unsafe(no_mangle)]
pub fn canary_index(items: &[u8; 4], place: usize) -> u8 {
    items[place]
}

/// A sum that does not fit is a panic.
#[unsafe(no_mangle)]
pub fn canary_overflow(a: u32, b: u32) -> u32 {
    a + b
}

/// Takes memory from the heap, for which there is no allocator: with this, the crate does not even
/// build.
#[cfg(feature = "canary-heap")]
#[unsafe(no_mangle)]
pub fn canary_heap(byte: u8) -> alloc::boxed::Box<u8> {
    alloc::boxed::Box::new(byte)
}

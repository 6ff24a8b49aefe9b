//! Registers of a peripheral.

/// A register at an address.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Register(usize);

impl Register {
    /// The register of a peripheral, so many bytes from its base.
    ///
    /// # Safety
    /// A device must have a 32-bit register there that nothing else in the program uses, and
    /// reading and writing it must not touch memory.
    pub(crate) const unsafe fn new(base: usize, offset: usize) -> Self {
        Self(base + offset)
    }

    pub(crate) fn read(self) -> u32 {
        // SAFETY: `new` says that there is a register.
        unsafe { (self.0 as *const u32).read_volatile() }
    }

    pub(crate) fn write(self, value: u32) {
        // SAFETY: `new` says that there is a register, and that writing it touches no memory.
        unsafe { (self.0 as *mut u32).write_volatile(value) }
    }
}

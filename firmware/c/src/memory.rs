//! Memory of the caller's: what is checked before it is read or written.
//!
//! C hands over addresses. Whether an address is null, aligned and long enough can be checked, and
//! is; that it points to memory at all cannot, and is what the caller promises.

use crate::error::{Done, cotama_error};
use core::ffi::c_void;
use core::mem::{align_of, size_of};

/// A type that C knows by its address alone. What lies there is a [`Kept`] value.
pub trait Handle: Sized {
    /// The value that the handle keeps.
    type Value;
    /// The bytes of a handle, as the header says: at least those of what it keeps.
    const BYTES: usize;
    /// Tells this type of handle from all others; any number that no other has, nor its complement.
    /// A handle at rest begins with it, and one that is in use with its complement.
    const MARK: u64;
}

/// A value in the caller's memory, behind the mark that says what it is.
#[repr(C)]
pub struct Kept<T> {
    mark: u64,
    value: T,
}

impl<T> Kept<T> {
    /// Whether memory of this length and alignment holds it: for the constants of the header, while
    /// compiling.
    pub const fn fits(bytes: usize, align: usize) -> bool {
        size_of::<Self>() <= bytes && align_of::<Self>() <= align
    }
}

/// A piece of memory that a call uses, up to its end, which it does not hold.
#[derive(Clone, Copy)]
struct Piece {
    start: usize,
    end: usize,
    written: bool,
}

impl Piece {
    /// Whether it shares a byte with another one, and one of them is written.
    const fn collides_with(self, other: Self) -> bool {
        (self.written || other.written) && self.end > other.start && other.end > self.start
    }
}

/// All memory that one call uses.
///
/// The caller's memory is reached through it alone, piece by piece: a piece that is written is
/// compared with every other one, and nothing is written before all have been named.
pub(crate) struct Pieces([Piece; Self::MOST]);

impl Pieces {
    /// The most pieces of a call.
    const MOST: usize = 8;

    pub(crate) const fn new() -> Self {
        Self([Piece { start: 0, end: 0, written: false }; Self::MOST])
    }

    /// Names a piece of `count` values, having checked that its address can be one.
    fn name<T>(&mut self, at: *const T, count: usize, written: bool) -> Done {
        self.check(at.addr(), count.saturating_mul(size_of::<T>()), align_of::<T>(), written)
    }

    /// The same in bytes: once for all types.
    #[inline(never)]
    fn check(&mut self, address: usize, bytes: usize, align: usize, written: bool) -> Done {
        if address == 0 {
            return Err(cotama_error::NullPointer);
        }
        if address & align.wrapping_sub(1) != 0 {
            return Err(cotama_error::Misaligned);
        }
        if isize::try_from(bytes).is_err() {
            return Err(cotama_error::BadNumber);
        }
        if bytes == 0 {
            return Ok(());
        }
        let piece = Piece { start: address, end: address.saturating_add(bytes), written };
        for named in &mut self.0 {
            if named.end == 0 {
                *named = piece;
                return Ok(());
            }
            if named.collides_with(piece) {
                break;
            }
        }
        // Nor is one too many let through: those behind it could not be compared with it.
        Err(cotama_error::Overlap)
    }

    /// A value that the caller hands over by its address.
    ///
    /// # Safety
    /// `from` is null or points to a value.
    pub(crate) unsafe fn read<T: Copy>(&mut self, from: *const T) -> Result<T, cotama_error> {
        self.name(from, 1, false)?;
        // SAFETY: the address was checked, and it is promised that a value is there.
        Ok(unsafe { from.read() })
    }

    /// A list that the caller hands over by its address; null is an empty one.
    ///
    /// # Safety
    /// `from` is null, or points to `count` values that nobody changes while the list is used.
    pub(crate) unsafe fn list<'l, T>(
        &mut self,
        from: *const T,
        count: usize,
    ) -> Result<&'l [T], cotama_error> {
        if count == 0 {
            return Ok(&[]);
        }
        self.name(from, count, false)?;
        // SAFETY: the address was checked; that the values are there and stay is promised.
        Ok(unsafe { core::slice::from_raw_parts(from, count) })
    }

    /// The same to be written.
    ///
    /// # Safety
    /// As for [`list`](Self::list), and nobody reads them either.
    pub(crate) unsafe fn list_to_write<'l, T>(
        &mut self,
        to: *mut T,
        count: usize,
    ) -> Result<&'l mut [T], cotama_error> {
        if count == 0 {
            return Ok(&mut []);
        }
        self.name(to, count, true)?;
        // SAFETY: the address was checked, and the list overlaps nothing else that the call uses;
        // that the values are there and are nobody else's is promised.
        Ok(unsafe { core::slice::from_raw_parts_mut(to, count) })
    }

    /// Memory for an answer.
    ///
    /// # Safety
    /// `to` is null or points to memory for a value, which stays there until it is put.
    pub(crate) unsafe fn out<T>(&mut self, to: *mut T) -> Result<Out<T>, cotama_error> {
        self.name(to, 1, true)?;
        Ok(Out(to))
    }

    /// The same where null means that nobody wants the answer.
    ///
    /// # Safety
    /// As for [`out`](Self::out).
    pub(crate) unsafe fn wanted<T>(&mut self, to: *mut T) -> Result<Option<Out<T>>, cotama_error> {
        if to.is_null() {
            return Ok(None);
        }
        // SAFETY: the caller's promise is the same.
        unsafe { self.out(to) }.map(Some)
    }

    /// A value that is read and written again, and memory for it.
    ///
    /// # Safety
    /// `at` is null or points to a value.
    pub(crate) unsafe fn change<T: Copy>(
        &mut self,
        at: *mut T,
    ) -> Result<(T, Out<T>), cotama_error> {
        self.name(at, 1, true)?;
        // SAFETY: the address was checked, and it is promised that a value is there.
        Ok((unsafe { at.read() }, Out(at)))
    }

    /// Memory in which a handle is to be started, and where its address is to be put.
    ///
    /// # Safety
    /// `memory` is null or points to that many bytes, which are the handle's from now on; `handle`
    /// is null or points to memory for an address.
    pub(crate) unsafe fn place<H: Handle>(
        &mut self,
        memory: *mut c_void,
        bytes: usize,
        handle: *mut *mut H,
    ) -> Result<Place<H>, cotama_error> {
        const { assert!(Kept::<H::Value>::fits(H::BYTES, align_of::<Kept<H::Value>>())) };
        let kept = memory.cast::<Kept<H::Value>>();
        if !kept.is_null() && kept.is_aligned() && bytes < H::BYTES {
            return Err(cotama_error::TooSmall);
        }
        // All of the memory is the handle's, not only what the value takes.
        self.check(kept.addr(), bytes, align_of::<Kept<H::Value>>(), true)?;
        // SAFETY: it is promised that memory for an address is there.
        Ok(Place { kept, handle: unsafe { self.out(handle) }? })
    }

    /// A handle that was started, for the time of a call.
    ///
    /// # Safety
    /// `handle` is null or points to what [`Place::start`] has put there, or to other memory of at
    /// least eight bytes; no other thread uses it.
    pub(crate) unsafe fn started<H: Handle>(
        &mut self,
        handle: *const H,
    ) -> Result<Started<H>, cotama_error> {
        let kept = handle.cast::<Kept<H::Value>>().cast_mut();
        let align = align_of::<Kept<H::Value>>();
        // SAFETY: the caller promises the same, and the mark comes first.
        unsafe { self.marked(kept.cast(), H::BYTES, align, H::MARK) }?;
        Ok(Started(kept))
    }

    /// Names memory that is to begin with a mark: once for all types of handle.
    ///
    /// # Safety
    /// `at` is null or points to a mark.
    #[inline(never)]
    unsafe fn marked(&mut self, at: *const u64, bytes: usize, align: usize, mark: u64) -> Done {
        self.check(at.addr(), bytes, align, true)?;
        // SAFETY: the address was checked. Nothing else is read before the mark is known to be
        // right.
        match unsafe { at.read() } {
            it if it == mark => Ok(()),
            it if it == !mark => Err(cotama_error::Busy),
            _ => Err(cotama_error::NotStarted),
        }
    }

    /// Memory to be cut into lists.
    ///
    /// # Safety
    /// `memory` is null or points to that many bytes, which nobody else uses as long as the lists
    /// are used.
    pub(crate) unsafe fn carver(
        &mut self,
        memory: *mut c_void,
        bytes: usize,
    ) -> Result<Carver, cotama_error> {
        self.name(memory.cast::<u8>(), bytes, true)?;
        Ok(Carver { at: memory.cast(), left: bytes })
    }
}

/// Memory for an answer, checked before anything happens.
pub(crate) struct Out<T>(*mut T);

impl<T> Out<T> {
    pub(crate) fn put(self, value: T) {
        // SAFETY: the address was checked, and it is promised that memory is there.
        unsafe { self.0.write(value) };
    }

    /// The address, for a part of the value.
    pub(crate) fn address(&self) -> *mut T {
        self.0
    }
}

/// Memory for a handle, checked before anything happens.
pub(crate) struct Place<H: Handle> {
    kept: *mut Kept<H::Value>,
    handle: Out<*mut H>,
}

impl<H: Handle> Place<H> {
    /// Puts a handle there.
    pub(crate) fn start(self, value: H::Value) {
        // SAFETY: address and length were checked, and the memory is the handle's.
        unsafe { self.kept.write(Kept { mark: H::MARK, value }) };
        self.handle.put(self.kept.cast());
    }
}

/// A handle that was started, for the time of a call.
pub(crate) struct Started<H: Handle>(*mut Kept<H::Value>);

impl<H: Handle> Started<H> {
    /// Lends the value. Whoever calls with the same handle meanwhile is told that it is busy.
    pub(crate) fn with<R>(self, act: impl FnOnce(&mut H::Value) -> R) -> R {
        // SAFETY: the mark said that a value of this type lies there. The mark is written by its
        // address alone, and is no part of the value that is lent; it keeps a second loan away.
        unsafe {
            (&raw mut (*self.0).mark).write(!H::MARK);
            let done = act(&mut (*self.0).value);
            (&raw mut (*self.0).mark).write(H::MARK);
            done
        }
    }
}

/// Memory of the caller's that is cut into lists.
pub(crate) struct Carver {
    at: *mut u8,
    left: usize,
}

impl Carver {
    /// The most that is lost to alignment for one list.
    pub(crate) const LOST: usize = 15;

    /// A list of its own, filled.
    pub(crate) fn take<'m, T: Copy>(
        &mut self,
        count: usize,
        fill: T,
    ) -> Result<&'m mut [T], cotama_error> {
        const { assert!(align_of::<T>() <= Self::LOST + 1) };
        let skipped = self.at.align_offset(align_of::<T>());
        let bytes = count.checked_mul(size_of::<T>()).and_then(|it| it.checked_add(skipped));
        let bytes = bytes.filter(|it| *it <= self.left).ok_or(cotama_error::TooSmall)?;
        // SAFETY: so many bytes are left, the first value is aligned, and what is handed out is not
        // handed out again. All values are written before anybody sees them.
        unsafe {
            let list = self.at.add(skipped).cast::<T>();
            (0..count).for_each(|it| list.add(it).write(fill));
            self.at = self.at.add(bytes);
            self.left = self.left.saturating_sub(bytes);
            Ok(core::slice::from_raw_parts_mut(list, count))
        }
    }
}

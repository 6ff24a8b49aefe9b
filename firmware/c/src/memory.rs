//! Memory of the caller's: what is checked before it is read or written.
//!
//! C hands over addresses. Whether an address is null, aligned and long enough can be checked, and
//! is; that it points to memory at all cannot, and is what the caller promises.

use crate::error::{Done, cotama_error};
use core::ffi::c_void;
use core::mem::{align_of, size_of};

/// A type that C knows by its address alone. What lies there is a [`Kept`] value.
pub trait Handle: Sized {
    /// What the handle keeps.
    type Value;
    /// Tells this type of handle from all others; any number that no other has.
    const MARK: u64;
}

/// The handle is in use: no type of handle has this mark.
///
/// cbindgen:ignore
const BUSY: u64 = u64::MAX;

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

/// A piece of memory, for comparing.
#[derive(Clone, Copy)]
pub(crate) struct Piece {
    address: usize,
    bytes: usize,
}

impl Piece {
    pub(crate) fn of<T>(at: *const T, count: usize) -> Self {
        Self { address: at.addr(), bytes: count.saturating_mul(size_of::<T>()) }
    }

    /// Of a list that can be one: aligned, not null unless it is empty, and not too long.
    pub(crate) fn of_list<T>(at: *const T, count: usize) -> Result<Self, cotama_error> {
        if count > 0 {
            usable(at, count)?;
        }
        Ok(Self::of(at, count))
    }

    fn end(self) -> usize {
        self.address.saturating_add(self.bytes)
    }

    /// Whether it shares no byte with another.
    pub(crate) fn apart_from(self, other: Self) -> Done {
        let empty = self.bytes == 0 || other.bytes == 0;
        if empty || self.end() <= other.address || other.end() <= self.address {
            Ok(())
        } else {
            Err(cotama_error::Overlap)
        }
    }
}

/// Whether an address can be one of `count` values.
fn usable<T>(at: *const T, count: usize) -> Done {
    if at.is_null() {
        Err(cotama_error::NullPointer)
    } else if !at.is_aligned() {
        Err(cotama_error::Misaligned)
    } else if count.checked_mul(size_of::<T>()).is_none_or(|it| it > isize::MAX as usize) {
        Err(cotama_error::BadNumber)
    } else {
        Ok(())
    }
}

/// Memory for an answer, checked before anything happens.
pub(crate) struct Out<T>(*mut T);

impl<T> Out<T> {
    /// # Safety
    /// `to` is null or points to memory for a value, which stays there until it is put.
    pub(crate) unsafe fn new(to: *mut T, beside: Piece) -> Result<Self, cotama_error> {
        usable(to, 1)?;
        Piece::of(to, 1).apart_from(beside)?;
        Ok(Self(to))
    }

    /// The same where null means that nobody wants the answer.
    ///
    /// # Safety
    /// As for [`Out::new`].
    pub(crate) unsafe fn wanted(to: *mut T, beside: Piece) -> Result<Option<Self>, cotama_error> {
        if to.is_null() {
            return Ok(None);
        }
        // SAFETY: the caller's promise is the same.
        unsafe { Self::new(to, beside) }.map(Some)
    }

    pub(crate) fn piece(&self) -> Piece {
        Piece::of(self.0, 1)
    }

    pub(crate) fn put(self, value: T) {
        // SAFETY: the address was checked, and it is promised that memory is there.
        unsafe { self.0.write(value) };
    }
}

/// A value that the caller hands over by its address.
///
/// # Safety
/// `from` is null or points to a value.
pub(crate) unsafe fn read<T: Copy>(from: *const T) -> Result<T, cotama_error> {
    usable(from, 1)?;
    // SAFETY: the address was checked, and it is promised that a value is there.
    Ok(unsafe { from.read() })
}

/// A list that the caller hands over by its address; null is an empty one.
///
/// # Safety
/// `from` is null, or points to `count` values that nobody changes while the list is used.
pub(crate) unsafe fn list<'l, T>(from: *const T, count: usize) -> Result<&'l [T], cotama_error> {
    if count == 0 {
        return Ok(&[]);
    }
    usable(from, count)?;
    // SAFETY: the address was checked; that the values are there and stay is promised.
    Ok(unsafe { core::slice::from_raw_parts(from, count) })
}

/// The same to be written.
///
/// # Safety
/// As for [`list`], and nobody reads them either.
pub(crate) unsafe fn list_to_write<'l, T>(
    to: *mut T,
    count: usize,
) -> Result<&'l mut [T], cotama_error> {
    if count == 0 {
        return Ok(&mut []);
    }
    usable(to, count)?;
    // SAFETY: the address was checked; that the values are there and are nobody else's is promised.
    Ok(unsafe { core::slice::from_raw_parts_mut(to, count) })
}

/// Puts a handle into the caller's memory.
///
/// # Safety
/// `memory` is null or points to that many bytes, which are the handle's from now on; `handle` is
/// null or points to memory for an address.
pub(crate) unsafe fn start<H: Handle>(
    memory: *mut c_void,
    bytes: usize,
    handle: *mut *mut H,
    make: impl FnOnce() -> Result<H::Value, cotama_error>,
) -> Done {
    let kept = memory.cast::<Kept<H::Value>>();
    usable(kept, 1)?;
    if bytes < size_of::<Kept<H::Value>>() {
        return Err(cotama_error::TooSmall);
    }
    // SAFETY: it is promised that memory for an address is there.
    let handle = unsafe { Out::new(handle, Piece::of(kept, 1)) }?;
    let value = make()?;
    // SAFETY: address and length were checked, and the memory is the handle's.
    unsafe { kept.write(Kept { mark: H::MARK, value }) };
    handle.put(kept.cast());
    Ok(())
}

/// A handle that was started, for the time of a call.
pub(crate) struct Started<H: Handle>(*mut Kept<H::Value>);

impl<H: Handle> Started<H> {
    /// # Safety
    /// `handle` is null or points to what [`start`] has put there, or to other memory of at least
    /// eight bytes; no other thread uses it.
    pub(crate) unsafe fn new(handle: *const H) -> Result<Self, cotama_error> {
        let kept = handle.cast::<Kept<H::Value>>().cast_mut();
        usable(kept, 1)?;
        // SAFETY: the address was checked, and the mark comes first. Nothing else is read before it
        // is known to be right.
        match unsafe { kept.cast::<u64>().read() } {
            mark if mark == H::MARK => Ok(Self(kept)),
            BUSY => Err(cotama_error::Busy),
            _ => Err(cotama_error::NotStarted),
        }
    }

    pub(crate) fn piece(&self) -> Piece {
        Piece::of(self.0, 1)
    }

    /// Lends the value. Whoever calls with the same handle from within is told that it is busy.
    pub(crate) fn with<R>(self, act: impl FnOnce(&mut H::Value) -> R) -> R {
        // SAFETY: the mark said that a value of this type lies there. The mark is written by its
        // address alone, and is no part of the value that is lent; it keeps a second loan away.
        unsafe {
            (&raw mut (*self.0).mark).write(BUSY);
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

    /// # Safety
    /// `memory` is null or points to that many bytes, which nobody else uses as long as the lists
    /// are used.
    pub(crate) unsafe fn new(memory: *mut c_void, bytes: usize) -> Result<Self, cotama_error> {
        usable(memory.cast::<u8>(), bytes)?;
        Ok(Self { at: memory.cast(), left: bytes })
    }

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

//! A system as bytes, for a page to carry: numbers in base 128, texts and lists with their length,
//! a checksum at the end.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use cotama_core::checksum::crc32;
use cotama_core::net::owned::{OwnedIgnored, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition};
use cotama_core::net::{Arc, EventId, OutputId, PlaceId, Role, TransitionId, Within};
use cotama_core::system::owned::OwnedSystem;
use cotama_core::system::{Binding, Clear, Delivery, Link, Of, System, Target};

/// First bytes of the format, with its version.
const MAGIC: &[u8; 4] = b"cpl1";

/// Bytes that are no system: cut, changed, or of another version.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damaged;

impl fmt::Display for Damaged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the model in the page is damaged")
    }
}

impl core::error::Error for Damaged {}

/// Writes all of a system that its player needs: not its laws, nor what is said about its parts.
///
/// ```
/// use cotama_core::system::{Component, System};
/// use cotama_models::nets::door;
/// use cotama_playground::{decode, encode};
/// let bytes = encode(&System::alone(&[Component::alone(&door::NET)]));
/// assert_eq!(decode(&bytes).unwrap().nets[0].1.transitions.len(), door::NET.transitions.len());
/// assert!(decode(&bytes[..bytes.len() - 1]).is_err());
/// ```
pub fn encode(system: &System<'_>) -> Vec<u8> {
    let mut to = Vec::from(MAGIC);
    OwnedSystem::from(system).write(&mut to);
    closed(to)
}

/// Bytes with their checksum.
pub(super) fn closed(mut bytes: Vec<u8>) -> Vec<u8> {
    let sum = crc32(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// The bytes before a checksum that is theirs.
pub(super) fn opened(bytes: &[u8]) -> Result<&[u8], Damaged> {
    let (body, sum) = bytes.split_last_chunk::<4>().ok_or(Damaged)?;
    if crc32(body) == u32::from_le_bytes(*sum) { Ok(body) } else { Err(Damaged) }
}

/// Reads a system.
///
/// # Errors
/// [`Damaged`] when they are not what [`encode`] wrote. That its nets fit together is found when
/// they are played.
pub fn decode(bytes: &[u8]) -> Result<OwnedSystem, Damaged> {
    let mut from = opened(bytes)?.strip_prefix(MAGIC).ok_or(Damaged)?;
    let system = OwnedSystem::read(&mut from)?;
    if from.is_empty() { Ok(system) } else { Err(Damaged) }
}

/// Something that is written and read again.
pub(super) trait Coded: Sized {
    fn write(&self, to: &mut Vec<u8>);
    fn read(from: &mut &[u8]) -> Result<Self, Damaged>;
}

impl Coded for u8 {
    fn write(&self, to: &mut Vec<u8>) {
        to.push(*self);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let (first, rest) = from.split_first().ok_or(Damaged)?;
        *from = rest;
        Ok(*first)
    }
}

impl Coded for u32 {
    fn write(&self, to: &mut Vec<u8>) {
        let mut left = *self;
        while left > 0x7f {
            to.push((left & 0x7f) as u8 | 0x80);
            left >>= 7;
        }
        to.push(left as u8);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let mut all = 0_u64;
        for shift in [0, 7, 14, 21, 28] {
            let byte = u8::read(from)?;
            all |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return u32::try_from(all).map_err(|_| Damaged);
            }
        }
        Err(Damaged)
    }
}

impl Coded for u16 {
    fn write(&self, to: &mut Vec<u8>) {
        u32::from(*self).write(to);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        u32::read(from)?.try_into().map_err(|_| Damaged)
    }
}

impl Coded for u64 {
    fn write(&self, to: &mut Vec<u8>) {
        (*self as u32).write(to);
        ((self >> 32) as u32).write(to);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let (low, high): (u32, u32) = Coded::read(from)?;
        Ok(Self::from(high) << 32 | Self::from(low))
    }
}

impl Coded for bool {
    fn write(&self, to: &mut Vec<u8>) {
        to.push(u8::from(*self));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Damaged),
        }
    }
}

impl<T: Coded> Coded for [T; 2] {
    fn write(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|it| it.write(to));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok([T::read(from)?, T::read(from)?])
    }
}

impl Coded for i16 {
    fn write(&self, to: &mut Vec<u8>) {
        self.cast_unsigned().write(to);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        u16::read(from).map(u16::cast_signed)
    }
}

impl<T: Coded> Coded for Vec<T> {
    fn write(&self, to: &mut Vec<u8>) {
        (self.len() as u32).write(to);
        self.iter().for_each(|it| it.write(to));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let length = u32::read(from)? as usize;
        // Each item takes a byte at least: a length that lies asks for no memory.
        if length > from.len() {
            return Err(Damaged);
        }
        (0..length).map(|_| T::read(from)).collect()
    }
}

impl Coded for String {
    fn write(&self, to: &mut Vec<u8>) {
        (self.len() as u32).write(to);
        to.extend(self.as_bytes());
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let length = u32::read(from)? as usize;
        let (text, rest) = from.split_at_checked(length).ok_or(Damaged)?;
        *from = rest;
        core::str::from_utf8(text).map(String::from).map_err(|_| Damaged)
    }
}

impl<T: Coded> Coded for Option<T> {
    fn write(&self, to: &mut Vec<u8>) {
        u8::from(self.is_some()).write(to);
        self.iter().for_each(|it| it.write(to));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        match u8::read(from)? {
            0 => Ok(None),
            1 => T::read(from).map(Some),
            _ => Err(Damaged),
        }
    }
}

impl<A: Coded, B: Coded> Coded for (A, B) {
    fn write(&self, to: &mut Vec<u8>) {
        self.0.write(to);
        self.1.write(to);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok((A::read(from)?, B::read(from)?))
    }
}

impl<T: Coded> Coded for Of<T> {
    fn write(&self, to: &mut Vec<u8>) {
        self.component.write(to);
        self.id.write(to);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(Self { component: u16::read(from)?, id: T::read(from)? })
    }
}

/// A structure is its fields in order; what is left out has a value of its own.
macro_rules! fields {
    ($type:ident { $($field:tt),* } $(leaving $out:ident: $value:expr)*) => {
        impl Coded for $type {
            fn write(&self, to: &mut Vec<u8>) {
                $(self.$field.write(to);)*
            }

            fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
                $(let $out = $value;)*
                Ok(Self { $($field: Coded::read(from)?,)* $($out,)* })
            }
        }
    };
}

pub(super) use fields;

fields!(PlaceId { 0 });
fields!(TransitionId { 0 });
fields!(EventId { 0 });
fields!(OutputId { 0 });
fields!(Arc { place, weight });
fields!(Within { earliest, latest });
fields!(OwnedPlace { name, initial, bound, role } leaving doc: String::new());
fields!(OwnedSignal { name } leaving doc: String::new());
fields!(OwnedTransition { name, line, on, take, read, give, emits, within, priority }
    leaving doc: String::new());
fields!(OwnedIgnored { event, place, guard });
fields!(OwnedNet { name, places, events, outputs, transitions, ignored }
    leaving doc: String::new() leaving laws: Vec::new());
fields!(Link { from, to, delivery });
fields!(Binding { shared, target });
fields!(Clear { on, mailbox });
fields!(OwnedSystem { name, nets, links, bindings, clears } leaving doc: String::new());

impl Coded for Role {
    fn write(&self, to: &mut Vec<u8>) {
        match self {
            Self::State => to.push(0),
            Self::Data => to.push(1),
            Self::Complement(of) => {
                to.push(2);
                of.write(to);
            }
            Self::Shared => to.push(3),
            Self::Mailbox => to.push(4),
        }
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(match u8::read(from)? {
            0 => Self::State,
            1 => Self::Data,
            2 => Self::Complement(PlaceId::read(from)?),
            3 => Self::Shared,
            4 => Self::Mailbox,
            _ => return Err(Damaged),
        })
    }
}

impl Coded for Delivery {
    fn write(&self, to: &mut Vec<u8>) {
        match self {
            Self::Now => to.push(0),
            Self::Mail { capacity } => {
                to.push(1);
                capacity.write(to);
            }
        }
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(match u8::read(from)? {
            0 => Self::Now,
            1 => Self::Mail { capacity: u16::read(from)? },
            _ => return Err(Damaged),
        })
    }
}

impl Coded for Target {
    fn write(&self, to: &mut Vec<u8>) {
        match self {
            Self::Place(it) => {
                to.push(0);
                it.write(to);
            }
            Self::Mailbox(it) => {
                to.push(1);
                it.write(to);
            }
        }
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(match u8::read(from)? {
            0 => Self::Place(Of::read(from)?),
            1 => Self::Mailbox(Of::read(from)?),
            _ => return Err(Damaged),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Damaged, decode, encode};
    use cotama_core::system::owned::OwnedSystem;
    use cotama_core::system::{Component, System};
    use cotama_models::nets::by_hand::delivery;
    use cotama_models::nets::{crossing, find};
    use cotama_models::robots::{self, EMBEDDED, Robot};
    use std::string::String;
    use std::vec::Vec;

    /// The same without what the bytes leave out.
    fn bare(system: &System<'_>) -> OwnedSystem {
        let mut bare = OwnedSystem::from(system);
        bare.doc = String::new();
        for (_, net) in &mut bare.nets {
            net.doc = String::new();
            net.laws = Vec::new();
            net.places.iter_mut().for_each(|it| it.doc = String::new());
            net.transitions.iter_mut().for_each(|it| it.doc = String::new());
            net.events.iter_mut().for_each(|it| it.doc = String::new());
            net.outputs.iter_mut().for_each(|it| it.doc = String::new());
        }
        bare
    }

    #[test]
    fn a_system_is_read_as_it_was_written() {
        let same = |it: &System<'_>| assert_eq!(decode(&encode(it)), Ok(bare(it)), "{}", it.name);
        same(&delivery::SYSTEM);
        same(&System::alone(&[Component::alone(&crossing::NET)]));
        let fms = find("fms:3").unwrap();
        same(&System::alone(&[Component::alone(&fms.view().net())]));
        for it in EMBEDDED {
            let robot = Robot::shipped(it.name).unwrap();
            robots::supervisors::system(&robot).with(same);
        }
    }

    #[test]
    fn bytes_that_were_cut_or_changed_are_refused() {
        let bytes = encode(&System::alone(&[Component::alone(&crossing::NET)]));
        for end in 0..bytes.len() {
            assert_eq!(decode(&bytes[..end]), Err(Damaged));
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            assert_eq!(decode(&changed), Err(Damaged), "byte {at}");
        }
    }
}

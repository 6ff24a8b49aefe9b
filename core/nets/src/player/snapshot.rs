//! A marking that is stored and comes back, if it belongs to this system and breaks none of its
//! laws.

use super::code::{Code, NONE};
use super::player::Player;
use super::program::{Checked, Program};
use crate::net::data::TransitionId;
use crate::system::data::Of;
use cotama_units::checksum::crc32;
use cotama_units::units::Millis;

/// A value that events carry along and that can be stored as bytes.
pub trait Stored: Copy {
    /// The number of bytes.
    const BYTES: usize;

    /// Writes it; the room is as large as [`BYTES`](Self::BYTES) says.
    fn write(&self, bytes: &mut [u8]);

    /// Reads it; `None` when these bytes stand for nothing.
    fn read(bytes: &[u8]) -> Option<Self>;
}

impl Stored for () {
    const BYTES: usize = 0;

    fn write(&self, _: &mut [u8]) {}

    fn read(_: &[u8]) -> Option<Self> {
        Some(())
    }
}

macro_rules! stored {
    ($($number:ty)*) => { $(
        /// Little endian.
        impl Stored for $number {
            const BYTES: usize = size_of::<$number>();

            fn write(&self, bytes: &mut [u8]) {
                if let Some(bytes) = bytes.first_chunk_mut() {
                    *bytes = self.to_le_bytes();
                }
            }

            fn read(bytes: &[u8]) -> Option<Self> {
                bytes.first_chunk().map(|it| Self::from_le_bytes(*it))
            }
        }
    )* };
}
stored! { u8 u16 u32 u64 }

/// A stored marking, with its clocks and what waits in mailboxes.
///
/// A player makes one, or [`Snapshot::read`] from bytes whose checksum is right.
///
/// ```
/// use cotama_core::{net, player::{Checked, Snapshot}, units::Millis};
/// net! { mod egg { places { Raw: 1, Hard } transitions { boil: Raw => Hard after 300 ms; } } }
/// let mut egg = egg::Player::new();
/// let _ = egg.advance(Millis(100));
/// let mut flash = [0; Snapshot::<1, 1>::BYTES];
/// assert!(egg.snapshot().write(&mut flash).is_some());
///
/// // The power was away until 5 s; 200 ms were left.
/// let stored = Snapshot::read(&flash).unwrap();
/// let egg = egg::Checked::restore(Checked(egg::Program), Millis(5_000), &stored).unwrap();
/// assert_eq!(egg.wake_at(), Some(Millis(5_200)));
/// flash[9] ^= 1;
/// assert_eq!(Snapshot::<1, 1>::read(&flash), None); // the checksum is wrong
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snapshot<const W: usize, const C: usize = 0, const S: usize = 0, M = ()> {
    /// Tells the system and its version: [`Code::fingerprint`].
    pub fingerprint: u64,
    /// The packed marking.
    pub marking: [u64; W],
    /// For each transition with an interval, how long it has been enabled, in milliseconds.
    pub clocks: [u32; C],
    /// The payloads of the waiting events. Slots of which nothing waits may hold anything.
    pub slots: [M; S],
}

/// Why a stored marking is refused.
///
/// ```
/// use cotama_core::{net, player::{Checked, RestoreError}, units::Millis};
/// net! { mod one { places { A: 1, B } events { go } transitions { go on go: A => B; } } }
/// net! { mod two { places { A: 1, C } events { go } transitions { go on go: A => C; } } }
/// let stored = one::Player::new().snapshot();
/// let refused = two::Checked::restore(Checked(two::Program), Millis(0), &stored);
/// assert!(matches!(refused, Err(RestoreError::OtherSystem { .. })));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RestoreError {
    /// The state is of another system, or of another version of this one.
    OtherSystem {
        /// The fingerprint of this system.
        expected: u64,
        /// The fingerprint of the stored marking.
        found: u64,
    },
    /// A place holds more than its bound, a place and its complement do not hold the bound
    /// together, or bits are set where no place or clock is.
    Marking,
    /// The marking breaks a law of a component: the component, and the position of the law in
    /// [`Net::laws`](crate::net::Net::laws).
    Law(u16, usize),
    /// A clock runs that cannot, or longer than it can; of this transition.
    Clock(Of<TransitionId>),
    /// A transition without event and interval is enabled: such a marking does not last.
    NotSettled,
}

impl core::fmt::Display for RestoreError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::OtherSystem { expected, found } => write!(
                f,
                "the stored marking is of another net or version: fingerprint {found:016x} \
                 instead of {expected:016x}"
            ),
            Self::Marking => f.write_str("the stored marking holds more tokens than a place can"),
            Self::Law(net, law) => write!(f, "the stored marking breaks law {law} of net {net}"),
            Self::Clock(Of { component, id }) => {
                write!(f, "the stored clock of transition {} of net {component} cannot be", id.0)
            }
            Self::NotSettled => f.write_str("the stored marking is not settled"),
        }
    }
}

impl core::error::Error for RestoreError {}

impl<const W: usize, const C: usize, const S: usize, M: Stored> Snapshot<W, C, S, M> {
    /// How many bytes [`Snapshot::write`] needs.
    pub const BYTES: usize = 8 + 8 * W + 4 * C + M::BYTES * S + 4;

    /// Writes it, little endian, with a checksum at the end; `None` when there is not enough room.
    pub fn write<'b>(&self, bytes: &'b mut [u8]) -> Option<&'b [u8]> {
        let (written, _) = bytes.split_at_mut_checked(Self::BYTES)?;
        let (content, checksum) = written.split_last_chunk_mut::<4>()?;
        let (words, rest) = content.split_at_mut_checked(8 + 8 * W)?;
        let (clocks, slots) = rest.split_at_mut_checked(4 * C)?;
        let of_words = core::iter::once(self.fingerprint).chain(self.marking);
        for (bytes, word) in words.chunks_exact_mut(8).zip(of_words) {
            *bytes.first_chunk_mut()? = word.to_le_bytes();
        }
        for (bytes, clock) in clocks.chunks_exact_mut(4).zip(self.clocks) {
            *bytes.first_chunk_mut()? = clock.to_le_bytes();
        }
        let mut rest = slots;
        for slot in &self.slots {
            let (bytes, after) = rest.split_at_mut_checked(M::BYTES)?;
            slot.write(bytes);
            rest = after;
        }
        *checksum = crc32(content).to_le_bytes();
        Some(written)
    }

    /// Reads what [`Snapshot::write`] wrote; `None` when the length is another or the checksum
    /// wrong.
    pub fn read(bytes: &[u8]) -> Option<Self>
    where
        M: Default,
    {
        let (content, checksum) = bytes.split_last_chunk::<4>()?;
        if bytes.len() != Self::BYTES || crc32(content) != u32::from_le_bytes(*checksum) {
            return None;
        }
        let (fingerprint, mut rest) = content.split_first_chunk::<8>()?;
        let (mut marking, mut clocks, mut slots) = ([0; W], [0; C], [M::default(); S]);
        for word in &mut marking {
            let (bytes, after) = rest.split_first_chunk::<8>()?;
            (*word, rest) = (u64::from_le_bytes(*bytes), after);
        }
        for clock in &mut clocks {
            let (bytes, after) = rest.split_first_chunk::<4>()?;
            (*clock, rest) = (u32::from_le_bytes(*bytes), after);
        }
        for slot in &mut slots {
            let (bytes, after) = rest.split_at_checked(M::BYTES)?;
            (*slot, rest) = (M::read(bytes)?, after);
        }
        Some(Self { fingerprint: u64::from_le_bytes(*fingerprint), marking, clocks, slots })
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<P, W, C, S, M>
{
    /// The marking, its clocks and what waits, to be stored.
    pub fn snapshot(&self) -> Snapshot<W, C, S, M> {
        let fingerprint = self.program.code().fingerprint;
        Snapshot { fingerprint, marking: self.marking, clocks: self.clocks, slots: self.slots }
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize, M: Copy + Default>
    Player<Checked<P>, W, C, S, M>
{
    /// A player that goes on at `now` where a stored one was. Whether the marking can be reached is
    /// not known, so it checks every firing against the bounds.
    ///
    /// ```
    /// use cotama_core::player::Snapshot;
    /// use cotama_core::{net, units::Millis};
    /// net! {
    ///     pub mod lamp {
    ///         places { Off: 1, On }
    ///         events { press }
    ///         transitions { light on press: Off => On; }
    ///     }
    /// }
    /// let mut player = lamp::Player::new();
    /// assert!(player.offer(Millis(5), &lamp::Event::press).fired());
    /// let mut flash = [0; Snapshot::<1>::BYTES];
    /// player.snapshot().write(&mut flash).unwrap();
    ///
    /// let stored = Snapshot::read(&flash).unwrap();
    /// let restored = lamp::Checked::restore(Default::default(), Millis(0), &stored).unwrap();
    /// assert_eq!(restored.state(), lamp::State::On);
    ///
    /// flash[9] ^= 1; // a damaged byte
    /// assert_eq!(Snapshot::<1>::read(&flash), None);
    /// ```
    ///
    /// # Errors
    /// When the marking is not one of this version of this system, breaks a law that can be told
    /// from a marking alone (invariants, `never_both`, bounds, complements), is not settled, or has
    /// clocks that cannot be.
    pub fn restore(
        program: Checked<P>,
        now: Millis,
        from: &Snapshot<W, C, S, M>,
    ) -> Result<Self, RestoreError> {
        let Snapshot { fingerprint, marking, clocks, slots } = *from;
        let player = Self { program, marking, clocks, slots, now };
        let code = player.program.code();
        if code.fingerprint != fingerprint {
            let expected = code.fingerprint;
            return Err(RestoreError::OtherSystem { expected, found: fingerprint });
        }
        let stray_clock = from.clocks.iter().skip(code.clocks.len()).any(|&elapsed| elapsed != 0);
        if stray_clock || !is_sound(code, &marking) || !player.complements(code) {
            return Err(RestoreError::Marking);
        }
        if let Some(broken) = code.kept.iter().find(|it| !it.holds(code, &marking)) {
            return Err(match broken.law {
                NONE => RestoreError::Marking,
                law => RestoreError::Law(broken.component, usize::from(law)),
            });
        }
        for (clock, &elapsed) in code.clocks.iter().zip(&from.clocks) {
            let most = if code.holds(&from.marking, &clock.need) { clock.cap() } else { 0 };
            if elapsed > most {
                let entry = code.entries.get(usize::from(clock.entry));
                let number = entry.map_or(u16::MAX, |it| it.transition);
                return Err(RestoreError::Clock(code.transition(number)));
            }
        }
        // A transition that waits for room in a mailbox may be enabled, where there are mailboxes.
        if S > 0 || player.settled(code) { Ok(player) } else { Err(RestoreError::NotSettled) }
    }

    /// Whether places and the complements that the system makes for them hold together what they
    /// can. Of the complements that nets have, and so of the room in mailboxes, [`Code::kept`] says
    /// so.
    fn complements(&self, code: &Code<'_, W>) -> bool {
        code.complements.iter().all(|&(place, field)| {
            code.fields.get(usize::from(place)).is_none_or(|it| {
                let (held, bound) = (it.of(&self.marking), it.of(&code.bounds));
                held.checked_add(field.of(&self.marking)) == Some(bound)
            })
        })
    }
}

/// Whether every field holds at most its bound, no other bit is set, and one state of a state
/// machine is marked.
fn is_sound<const W: usize>(code: &Code<'_, W>, marking: &[u64; W]) -> bool {
    let mut fields = [0_u64; W];
    let waiting = code.mailboxes.iter().flat_map(|it| [Some(it.waiting), it.room]).flatten();
    let made = code.complements.iter().map(|it| it.1);
    for field in code.fields.iter().copied().chain(waiting).chain(made) {
        if let Some(word) = fields.get_mut(usize::from(field.word)) {
            *word |= field.mask().wrapping_shl(u32::from(field.shift));
        }
    }
    let stray = fields.iter().zip(marking).any(|(field, word)| word & !field != 0);
    let one = code.control == 0
        || marking.first().is_some_and(|it| (it & code.control).is_power_of_two());
    !stray && one && code.holds(&code.bounds, marking)
}

#[cfg(test)]
mod tests {
    use super::RestoreError;
    use crate::net::TransitionId;
    use crate::system::Of;
    use std::string::ToString;

    #[test]
    fn a_refusal_names_the_defect_of_a_stored_marking() {
        let said = |it: RestoreError, text: &str| assert_eq!(it.to_string(), text);
        said(
            RestoreError::OtherSystem { expected: 0xab, found: 1 << 60 },
            "the stored marking is of another net or version: fingerprint 1000000000000000 \
             instead of 00000000000000ab",
        );
        said(RestoreError::Marking, "the stored marking holds more tokens than a place can");
        said(RestoreError::Law(2, 3), "the stored marking breaks law 3 of net 2");
        said(
            RestoreError::Clock(Of { component: 1, id: TransitionId(4) }),
            "the stored clock of transition 4 of net 1 cannot be",
        );
        said(RestoreError::NotSettled, "the stored marking is not settled");
    }
}

//! A marking that is stored and comes back, if it belongs to this net and breaks none of its laws.

use super::data::{Law, PlaceId, Role, TransitionId};
use super::player::Player;
use super::program::Program;
use crate::units::Millis;

/// A stored marking, with its clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snapshot<const W: usize, const C: usize> {
    /// Which net, in which version: [`Code::fingerprint`](super::code::Code::fingerprint).
    pub fingerprint: u64,
    /// The packed marking.
    pub marking: [u64; W],
    /// For each transition with an interval, how long it has been enabled, in milliseconds.
    pub clocks: [u32; C],
}

/// Why a stored marking is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestoreError {
    /// It is of another net, or of another version of this one.
    OtherNet {
        /// The fingerprint of this net.
        expected: u64,
        /// The fingerprint of the stored marking.
        found: u64,
    },
    /// A place holds more than its bound, or bits are set where no place or clock is.
    Marking,
    /// It breaks the law at this position of [`Net::laws`](super::Net::laws).
    Law(usize),
    /// A clock runs that cannot, or longer than it can; of this transition.
    Clock(TransitionId),
    /// A transition without event and interval is enabled: such a marking does not last.
    NotSettled,
}

impl core::fmt::Display for RestoreError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::OtherNet { expected, found } => write!(
                f,
                "the stored marking is of another net or version: fingerprint {found:016x} instead of {expected:016x}"
            ),
            Self::Marking => f.write_str("the stored marking holds more tokens than a place can"),
            Self::Law(law) => write!(f, "the stored marking breaks law {law} of the net"),
            Self::Clock(transition) => {
                write!(f, "the stored clock of transition {} cannot be", transition.0)
            }
            Self::NotSettled => f.write_str("the stored marking is not settled"),
        }
    }
}

impl core::error::Error for RestoreError {}

impl<const W: usize, const C: usize> Snapshot<W, C> {
    /// How many bytes [`Snapshot::write`] needs.
    pub const BYTES: usize = 8 + 8 * W + 4 * C;

    /// Writes it, little endian; `None` when there is not enough room.
    pub fn write<'b>(&self, bytes: &'b mut [u8]) -> Option<&'b [u8]> {
        let (written, _) = bytes.split_at_mut_checked(Self::BYTES)?;
        let (words, clocks) = written.split_at_mut_checked(8 + 8 * W)?;
        let of_words = core::iter::once(self.fingerprint).chain(self.marking);
        for (bytes, word) in words.chunks_exact_mut(8).zip(of_words) {
            *bytes.first_chunk_mut()? = word.to_le_bytes();
        }
        for (bytes, clock) in clocks.chunks_exact_mut(4).zip(self.clocks) {
            *bytes.first_chunk_mut()? = clock.to_le_bytes();
        }
        Some(written)
    }

    /// Reads what [`Snapshot::write`] wrote; `None` when the length is another.
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let (fingerprint, rest) = bytes.split_first_chunk::<8>()?;
        let (mut marking, mut clocks, mut rest) = ([0; W], [0; C], rest);
        for word in &mut marking {
            let (bytes, after) = rest.split_first_chunk::<8>()?;
            (*word, rest) = (u64::from_le_bytes(*bytes), after);
        }
        for clock in &mut clocks {
            let (bytes, after) = rest.split_first_chunk::<4>()?;
            (*clock, rest) = (u32::from_le_bytes(*bytes), after);
        }
        let fingerprint = u64::from_le_bytes(*fingerprint);
        rest.is_empty().then_some(Self { fingerprint, marking, clocks })
    }
}

impl<P: Program<W>, const W: usize, const C: usize> Player<P, W, C> {
    /// What is to be stored.
    pub fn snapshot(&self) -> Snapshot<W, C> {
        let fingerprint = self.program.code().fingerprint;
        Snapshot { fingerprint, marking: self.marking, clocks: self.clocks }
    }

    /// A player that goes on at `now` where a stored one was.
    ///
    /// # Errors
    /// When the marking is not one of this version of this net, breaks a law that can be told from
    /// a marking alone (invariants, `never_both`, bounds, flags and their complements), is not
    /// settled, or has clocks that cannot be.
    pub fn restore(program: P, now: Millis, from: &Snapshot<W, C>) -> Result<Self, RestoreError> {
        let player = Self { program, marking: from.marking, clocks: from.clocks, now };
        let code = player.program.code();
        if code.fingerprint != from.fingerprint {
            return Err(RestoreError::OtherNet {
                expected: code.fingerprint,
                found: from.fingerprint,
            });
        }
        let mut fields = [0_u64; W];
        for field in code.fields {
            if let Some(word) = fields.get_mut(usize::from(field.word)) {
                *word |= field.mask().wrapping_shl(u32::from(field.shift));
            }
        }
        let stray = fields.iter().zip(&from.marking).any(|(field, word)| word & !field != 0);
        let one = code.control == 0
            || from.marking.first().is_some_and(|it| (it & code.control).is_power_of_two());
        let stray =
            stray || from.clocks.iter().skip(code.clocks.len()).any(|&elapsed| elapsed != 0);
        if stray || !one || !code.holds(&code.bounds, &from.marking) || !player.complements() {
            return Err(RestoreError::Marking);
        }
        let tokens = |place| u64::from(code.tokens(&from.marking, place));
        let is_broken = |law: &Law<'_>| match *law {
            Law::Invariant { sum, equals } => {
                sum.iter()
                    .map(|arc| u64::from(arc.weight).saturating_mul(tokens(arc.place)))
                    .fold(0, u64::saturating_add)
                    != u64::from(equals)
            }
            Law::NeverBoth(a, b) => tokens(a) > 0 && tokens(b) > 0,
            _ => false,
        };
        if let Some((law, _)) =
            player.program.laws().iter().enumerate().find(|(_, law)| is_broken(law))
        {
            return Err(RestoreError::Law(law));
        }
        for (clock, &elapsed) in code.clocks.iter().zip(&from.clocks) {
            let most = if code.holds(&from.marking, &clock.need) { clock.cap() } else { 0 };
            if elapsed > most {
                let entry = code.entries.get(usize::from(clock.entry));
                return Err(RestoreError::Clock(
                    entry.map_or(TransitionId(u32::MAX), super::code::Entry::id),
                ));
            }
        }
        if player.settled() { Ok(player) } else { Err(RestoreError::NotSettled) }
    }

    /// Whether every complement holds what its place lacks.
    fn complements(&self) -> bool {
        let code = self.program.code();
        self.program.places().iter().enumerate().all(|(at, place)| match place.role {
            Role::Complement(of) => {
                let complement = code.tokens(&self.marking, PlaceId(at as u32));
                code.tokens(&self.marking, of).checked_add(complement) == Some(place.bound)
            }
            _ => true,
        })
    }
}

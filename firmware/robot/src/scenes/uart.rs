//! Frames over a line that flips bits, drops bytes and invents some.

use crate::dice::Dice;
use crate::link::{LONGEST, Received, Receiver, Sender};
use crate::trace::{Sink, Trace};

/// So many frames are sent.
pub const FRAMES: u32 = 20_000;

/// A line.
#[derive(Clone, Debug)]
pub struct Channel(Dice);

impl Channel {
    /// With its own noise for each seed.
    pub const fn new(seed: u64) -> Self {
        Self(Dice::new(seed))
    }

    /// Returns the bytes that come out for one that goes in: one bit in 1,000 is flipped, one byte
    /// in 2,000 is dropped, after one in 2,000 comes one from nowhere.
    pub fn carry(&mut self, byte: u8) -> [Option<u8>; 2] {
        let mut noise = 0;
        for bit in 0..8 {
            noise |= u8::from(self.0.once_in(1_000)) << bit;
        }
        let fate = self.0.roll(2_000);
        [(fate != 0).then_some(byte ^ noise), (fate == 1).then_some(self.0.bits() as u8)]
    }
}

/// The fates of the frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fates {
    /// Came as they were sent.
    pub accepted: u32,
    /// Were accepted and are not what was sent.
    pub wrong: u32,
    /// Are missing, by the numbers of those that came.
    pub missing: u32,
    /// Ends of what was no frame.
    pub refused: u32,
    /// Frames after the last one that came: nothing tells of them yet.
    pub after_the_last: u32,
}

/// Sends frames, and looks at what comes.
pub fn send(frames: u32, trace: &mut Trace<'_, impl Sink>) -> Fates {
    let (mut sender, mut receiver, mut channel) =
        (Sender::default(), Receiver::default(), Channel::new(1_055));
    let mut fates = Fates::default();
    // The number of the next frame, in 32 bits.
    let mut expected = 0_u32;
    for number in 0..frames {
        let (content, length) = content(number);
        sender.send(&content[..length], |byte| {
            for byte in channel.carry(byte).into_iter().flatten() {
                match receiver.take(byte) {
                    None => {}
                    Some(Received::Refused) => {
                        fates.refused += 1;
                        trace.frame(1, fates.refused);
                    }
                    Some(Received::Frame { missing, content: got, .. }) => {
                        let it = expected.wrapping_add(u32::from(missing));
                        let (sent, length) = self::content(it);
                        let right = it <= number && got == &sent[..length];
                        fates.missing = fates.missing.wrapping_add(u32::from(missing));
                        fates.accepted += u32::from(right);
                        fates.wrong += u32::from(!right);
                        expected = it.wrapping_add(1);
                        trace.frame(0, it);
                    }
                }
            }
        });
    }
    fates.after_the_last = frames.wrapping_sub(expected);
    fates
}

/// Returns the content of the frame of this number.
fn content(number: u32) -> ([u8; LONGEST], usize) {
    let mut dice = Dice::new(u64::from(number));
    let mut bytes = [0; LONGEST];
    for chunk in bytes.chunks_exact_mut(8) {
        chunk.copy_from_slice(&dice.bits().to_le_bytes());
    }
    (bytes, dice.roll(LONGEST as u32 + 1) as usize)
}

pub(super) fn play(frames: u32, trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let fates = send(frames, trace);
    [fates.accepted, fates.wrong]
}

//! Contents of the frames: the news of a period, and the requests.

use cotama_models::level::{Drive, Perceived, Requests, Told};

/// The input of the control loop in a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Period {
    /// News of observers and the scheduler.
    pub seen: Perceived,
    /// State of the drive.
    pub drive: Drive,
    /// A word of the mission, of the robot's programs, or of the operator.
    pub said: Option<Told>,
}

const SILENT: u8 = 0xFF;

impl Period {
    /// Length in bytes.
    pub const BYTES: usize = 27;

    /// As bytes, little endian: raised and lowered flags, the modules that work, the drive, the
    /// word.
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        let Perceived { raised, lowered, works } = self.seen;
        bytes[..8].copy_from_slice(&raised.to_le_bytes());
        bytes[8..16].copy_from_slice(&lowered.to_le_bytes());
        bytes[16..24].copy_from_slice(&works.to_le_bytes());
        bytes[24] = u8::from(self.drive.at_goal) | u8::from(self.drive.stands) << 1;
        bytes[25..].copy_from_slice(&self.said.map_or([SILENT, 0], |it| {
            let (kind, number) = it.to_numbers();
            [kind, number as u8]
        }));
        bytes
    }

    /// From bytes; `None` when they stand for nothing.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let bytes: &[u8; Self::BYTES] = bytes.try_into().ok()?;
        let long = |at: usize| bytes[at..].first_chunk().map(|it| u64::from_le_bytes(*it));
        let seen = Perceived { raised: long(0)?, lowered: long(8)?, works: long(16)? };
        let drive = match bytes[24] {
            it @ 0..=3 => Drive { at_goal: it & 1 != 0, stands: it & 2 != 0 },
            _ => return None,
        };
        let said = match [bytes[25], bytes[26]] {
            [SILENT, 0] => None,
            [kind, number] => Some(Told::from_numbers(kind, usize::from(number))?),
        };
        Some(Self { seen, drive, said })
    }
}

/// Length of the requests in bytes.
pub const REQUESTS_BYTES: usize = 22;

/// Requests as bytes, little endian: the configuration, 255 where nothing runs; drive, halt, ask,
/// alarm, from the lowest bit on; the fastest speed in mm/s; the reports whose settings hold; the
/// modules that are to be started anew.
pub fn requests_to_bytes(requests: &Requests, restarts: u64) -> [u8; REQUESTS_BYTES] {
    let Requests { configuration, drive, speed, settings, halt, ask, alarm } = *requests;
    let mut bytes = [0; REQUESTS_BYTES];
    bytes[0] = configuration.map_or(0xFF, |it| it as u8);
    bytes[1] = u8::from(drive) | u8::from(halt) << 1 | u8::from(ask) << 2 | u8::from(alarm) << 3;
    bytes[2..6].copy_from_slice(&(speed.0 as u32).to_le_bytes());
    bytes[6..14].copy_from_slice(&settings.to_le_bytes());
    bytes[14..].copy_from_slice(&restarts.to_le_bytes());
    bytes
}

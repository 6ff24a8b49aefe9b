//! Contents of the frames: the news of a period, and the requests.

use cotama_models::cotama::{Body, Flags, Modules, Perceived, Requests, Word, operator};

/// The input of the control loop in a period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Period {
    /// News of observers and the scheduler.
    pub seen: Perceived,
    /// State of the drive.
    pub body: Body,
    /// A word of the mission, of the planner of paths, or of the operator.
    pub said: Option<Word>,
}

/// The words, by their number.
pub const WORDS: [Word; 11] = [
    Word::MissionReceived,
    Word::ObjectReceived,
    Word::ObjectDelivered,
    Word::WaitOver,
    Word::PathReady,
    Word::Operator(operator::Event::teleprogram),
    Word::Operator(operator::Event::teleoperate),
    Word::Operator(operator::Event::waypoints),
    Word::Operator(operator::Event::new_path),
    Word::Operator(operator::Event::arrived),
    Word::Operator(operator::Event::gives_up),
];
const SILENT: u8 = 0xFF;

impl Period {
    /// Length in bytes.
    pub const BYTES: usize = 26;

    /// As bytes, little endian: raised and lowered flags, the module they are about, the modules
    /// that work, the body, the word.
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        let Perceived { raised, lowered, part, works } = self.seen;
        bytes[..8].copy_from_slice(&raised.bits().to_le_bytes());
        bytes[8..16].copy_from_slice(&lowered.bits().to_le_bytes());
        bytes[16..20].copy_from_slice(&part.bits().to_le_bytes());
        bytes[20..24].copy_from_slice(&works.bits().to_le_bytes());
        bytes[24] = u8::from(self.body.at_goal) | u8::from(self.body.stands) << 1;
        let number = WORDS.iter().position(|it| Some(*it) == self.said);
        bytes[25] = number.map_or(SILENT, |it| it as u8);
        bytes
    }

    /// From bytes; `None` when they stand for nothing.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let bytes: &[u8; Self::BYTES] = bytes.try_into().ok()?;
        let long = |at: usize| bytes[at..].first_chunk().map(|it| u64::from_le_bytes(*it));
        let short = |at: usize| bytes[at..].first_chunk().map(|it| u32::from_le_bytes(*it));
        let seen = Perceived {
            raised: Flags::from_bits(long(0)?)?,
            lowered: Flags::from_bits(long(8)?)?,
            part: Modules::from_bits(short(16)?)?,
            works: Modules::from_bits(short(20)?)?,
        };
        let body = match bytes[24] {
            it @ 0..=3 => Body { at_goal: it & 1 != 0, stands: it & 2 != 0 },
            _ => return None,
        };
        let said = match bytes[25] {
            SILENT => None,
            it => Some(*WORDS.get(usize::from(it))?),
        };
        Some(Self { seen, body, said })
    }
}

/// The configuration of requests as a byte; 255 where nothing runs.
pub fn configuration(requests: &Requests) -> u8 {
    requests.configuration.map_or(0xFF, |it| it as u8)
}

/// The yes and no of requests: drive, halt, ask, alarm, from the lowest bit on.
pub fn bits(requests: &Requests) -> u8 {
    let Requests { drive, halt, ask, alarm, .. } = *requests;
    u8::from(drive) | u8::from(halt) << 1 | u8::from(ask) << 2 | u8::from(alarm) << 3
}

/// Requests as bytes: configuration, yes and no, the fastest speed in mm/s.
pub fn requests_to_bytes(requests: &Requests) -> [u8; 6] {
    let mut bytes = [configuration(requests), bits(requests), 0, 0, 0, 0];
    bytes[2..].copy_from_slice(&(requests.speed.0 as u32).to_le_bytes());
    bytes
}

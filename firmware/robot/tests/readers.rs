//! No bytes make what reads them on the microcontroller panic: frames, what is asked in them, a
//! stored state, and two pages of flash. What is read is what is written again.
//!
//! A thousand mutants each here; a million each in a release build, which says what it found:
//! `cargo test --release --manifest-path firmware/Cargo.toml -p robot --test readers -- --ignored`.

use cotama_core::checksum::crc32;
use cotama_core::units::Millis;
use cotama_fuzz::Reader;
use embedded_storage::nor_flash::NorFlash;
use robot::link::{LONGEST, Received, Receiver, Sender};
use robot::message::Period;
use robot::robots::delivery::{Control, STORED_BYTES, TABLES};
use robot::scenes::{FlashModel, Memory, PAGE};
use robot::server::{Asked, PERIOD, PLAN, Served, Server};
use robot::store::{self, Store};
use robot::surroundings::Noise;
use robot::trace::Trace;

/// Two tests of each reader.
macro_rules! readers {
    ($($name:ident: $read:ident;)*) => {
        /// All of them, as the fuzz target reads them.
        #[allow(dead_code)]
        pub(crate) const ALL: &[Reader] = &[$($name::READER),*];

        $( mod $name {
            pub(super) const READER: cotama_fuzz::Reader =
                cotama_fuzz::Reader { name: stringify!($name), words: &[], read: super::$read };

            #[test]
            fn reads_or_refuses_a_thousand_mutants() {
                READER.run(1_000);
            }

            #[test]
            #[ignore = "a minute in a release build, by hand"]
            fn reads_or_refuses_a_million_mutants() {
                READER.run_a_million();
            }
        } )*
    };
}

readers! {
    frames: read_frames;
    served: read_served;
    states: read_state;
    flash: read_flash;
}

/// The bytes of a content on the wire.
fn sent(sender: &mut Sender, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    assert!(sender.send(content, |byte| bytes.push(byte)));
    bytes
}

/// The contents of all frames in these bytes.
fn received(receiver: &mut Receiver, bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut contents = Vec::new();
    for &byte in bytes {
        if let Some(Received::Frame { content, .. }) = receiver.take(byte) {
            assert!(content.len() <= LONGEST);
            contents.push(content.to_vec());
        }
    }
    contents
}

/// Any bytes on the wire: whether a frame was among them. It is received again when it is sent
/// again; and whatever came before, the next frame is received.
fn read_frames(bytes: &[u8]) -> bool {
    let mut receiver = Receiver::default();
    let contents = received(&mut receiver, bytes);
    let mut sender = Sender::default();
    for content in &contents {
        let again = received(&mut Receiver::default(), &sent(&mut sender, content));
        assert_eq!(&again[..], std::slice::from_ref(content));
    }
    let next = received(&mut receiver, &sent(&mut sender, b"next"));
    assert_eq!(next.last().map(Vec::as_slice), Some(&b"next"[..]));
    !contents.is_empty()
}

/// Reads requests to a server: a first byte for the planner, then contents, each behind its length.
/// Returns whether anything was answered but that the request is unknown. All answers are frames; a
/// content that is read is written as it was; and the state can be stored.
fn read_served(bytes: &[u8]) -> bool {
    let Some((&exactly, mut rest)) = bytes.split_first() else { return false };
    let (mut server, mut sender) = (Server::default(), Sender::default());
    let mut memory = Box::new(Memory::EMPTY);
    let (mut receiver, mut answered) = (Receiver::default(), false);
    while let Some((&length, after)) = rest.split_first() {
        let (content, after) = after.split_at(after.len().min(usize::from(length) % (LONGEST + 1)));
        rest = after;
        if let Some((_, said)) = content.split_first() {
            let period = Period::from_bytes(said).map(|it| it.to_bytes().to_vec());
            let asked = Asked::from_bytes(said).map(|it| it.to_bytes().to_vec());
            assert!(period.or(asked).is_none_or(|it| it == said));
        }
        let (mut back, mut served) = (Vec::new(), None);
        for byte in sent(&mut sender, content) {
            let workspace = (exactly & 1 == 1).then_some(&mut memory.workspace);
            let done = server.take(byte, &mut memory.tables, workspace, |it| back.push(it));
            served = served.or(done);
        }
        let answers = received(&mut receiver, &back);
        assert_eq!(answers.len(), usize::from(!matches!(served, None | Some(Served::Other(_)))));
        answered |= answers.iter().any(|it| matches!(it[0], PERIOD | PLAN));
    }
    assert!(Control::default().restore(&state(&server.control), Millis(0)));
    answered
}

/// The bytes of a stored state.
fn state(control: &Control) -> [u8; STORED_BYTES] {
    let mut bytes = [0; STORED_BYTES];
    assert!(control.store(&mut bytes).is_some());
    bytes
}

/// Periods of noise.
fn goes_on(control: &mut Control, seed: u64) {
    let mut noise = Noise::new(seed, TABLES);
    for now in (1..=5).map(|it| Millis(it * 100)) {
        let period = noise.period();
        let _ = control.period(now, &period, &mut Trace::new(&mut ()));
    }
}

/// Checks that a stored state is restored as it was, and goes on; or that it is refused and nothing
/// changes. Returns whether it was restored.
fn restored(bytes: &[u8]) -> bool {
    let mut control = Control::default();
    let before = state(&control);
    if !control.restore(bytes, Millis(0)) {
        assert_eq!(state(&control), before);
        return false;
    }
    assert_eq!(&state(&control)[..], bytes);
    goes_on(&mut control, 7);
    assert!(Control::default().restore(&state(&control), Millis(0)));
    true
}

/// A state as it is; then as long as it must be with the checksum that it must have.
fn read_state(bytes: &[u8]) -> bool {
    let _ = restored(bytes);
    let mut whole = [0; STORED_BYTES];
    for (to, &from) in whole.iter_mut().zip(bytes) {
        *to = from;
    }
    let checksum = crc32(&whole[..STORED_BYTES - 4]);
    whole[STORED_BYTES - 4..].copy_from_slice(&checksum.to_le_bytes());
    restored(&whole)
}

/// Two pages of flash with these bytes; what lacks is erased.
fn pages(bytes: &[u8]) -> [u8; 2 * PAGE] {
    let mut pages = [0xFF; 2 * PAGE];
    for (to, &from) in pages.iter_mut().zip(bytes) {
        *to = from;
    }
    pages
}

/// The number and the content of a page whose record is made whole: a length that fits, and the
/// checksums.
fn made_whole(page: &mut [u8]) -> (u32, Vec<u8>) {
    let word = |at: usize, page: &[u8]| u32::from_le_bytes(page[at..at + 4].try_into().unwrap());
    let length = word(0, page) as usize % (store::LONGEST + 1);
    page[..4].copy_from_slice(&(length as u32).to_le_bytes());
    let head = crc32(&page[..8]);
    page[8..12].copy_from_slice(&head.to_le_bytes());
    let end = 12 + length;
    let checksum = crc32(&page[..end]);
    page[end..end + 4].copy_from_slice(&checksum.to_le_bytes());
    (word(4, page), page[12..end].to_vec())
}

/// Opens it, and stores and finds another record. What was found first, with its number.
fn found(bytes: &[u8; 2 * PAGE]) -> Option<(u32, Vec<u8>)> {
    let mut flash = FlashModel::erased(0);
    flash.write(0, bytes).expect("there is power");
    let mut content = [0; store::LONGEST];
    let (mut store, length) = Store::open(flash, &mut content);
    let found = store.number().zip(length.map(|it| content[..it].to_vec()));
    assert_eq!(found.is_some(), length.is_some());
    store.write(b"another").expect("there is power");
    let next = found.as_ref().map_or(1, |it| it.0.wrapping_add(1));
    let (store, length) = Store::open(store.close(), &mut content);
    assert_eq!(store.number(), Some(next));
    assert_eq!(length.map(|it| &content[..it]), Some(&b"another"[..]));
    found
}

/// Flash as it is; then with both pages made whole, of which the later one is found. Whether
/// anything was found as it was.
fn read_flash(bytes: &[u8]) -> bool {
    let mut pages = pages(bytes);
    let as_it_is = found(&pages);
    let (first, second) = pages.split_at_mut(PAGE);
    let first = made_whole(first);
    let second = made_whole(second);
    let later = if second.0.wrapping_sub(first.0) < 1 << 31 { second } else { first };
    assert_eq!(found(&pages), Some(later));
    as_it_is.is_some()
}

/// The corpora: frames, a session, two states and two flashes.
#[test]
fn the_corpora_are_files_of_the_robot() {
    let mut noise = Noise::new(7, TABLES);
    let period = |noise: &mut Noise| [&[PERIOD][..], &noise.period().to_bytes()].concat();
    let asked = Asked { first: 0, rest: 31_000, hardware: 0x1121, used: [0; 2] };
    let asked = [&[PLAN][..], &asked.to_bytes()].concat();

    let contents = [period(&mut noise), asked.clone(), vec![0xC0, 0xDB], vec![]];
    let mut sender = Sender::default();
    frames::READER.keeps("four", &contents.map(|it| sent(&mut sender, &it)).concat());

    for (planner, name) in [(0, "rule"), (1, "exact")] {
        let contents = [period(&mut noise), asked.clone(), period(&mut noise), vec![0xFE, 1]];
        let behind_lengths = contents.map(|it| [&[it.len() as u8][..], &it].concat()).concat();
        served::READER.keeps(name, &[&[planner][..], &behind_lengths].concat());
    }

    let mut control = Control::default();
    states::READER.keeps("rest", &state(&control));
    for seed in 0..20 {
        goes_on(&mut control, seed);
    }
    assert_ne!(state(&control), state(&Control::default()));
    states::READER.keeps("noise", &state(&control));

    let mut bytes = pages(&[]);
    let mut record = |page: usize, number: u32, content: &[u8]| {
        let page = &mut bytes[page * PAGE..(page + 1) * PAGE];
        page[..4].copy_from_slice(&(content.len() as u32).to_le_bytes());
        page[4..8].copy_from_slice(&number.to_le_bytes());
        page[12..12 + content.len()].copy_from_slice(content);
        made_whole(page);
        bytes
    };
    flash::READER.keeps("one", &record(0, 1, b"once"));
    flash::READER.keeps("two", &record(1, 2, &state(&control)));
}

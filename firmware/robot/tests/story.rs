//! Promises of the firmware, on the host.

use cotama_core::units::Millis;
use embedded_storage::nor_flash::NorFlash;
use robot::dice::Dice;
use robot::guard::Guard;
use robot::link::{LONGEST, Received, Receiver, Sender};
use robot::message::{Period, REQUESTS_BYTES};
use robot::robots::delivery::TABLES;
use robot::scenes::{FlashModel, Memory, Power, Scene, play_all, send};
use robot::server::{Asked, PERIOD, PLAN, Served, Server, UNKNOWN};
use robot::store::{self, Store};
use robot::surroundings::Noise;
use robot::trace::Trace;

/// Nobody looks at it.
fn quiet(act: impl FnOnce(&mut Trace<'_, ()>)) {
    act(&mut Trace::new(&mut ()));
}

#[test]
fn the_scenes_are_those_of_the_golden_file() {
    let mut said = String::new();
    let mut memory = Box::new(Memory::EMPTY);
    let (digest, bytes) = play_all(&mut memory, &mut || (), &mut (), |scene, [a, b], (of, n)| {
        let [first, second] = scene.says();
        said += &format!("{}: {first} {a}, {second} {b}; {n} bytes, {of:016x}\n", scene.name());
    });
    said += &format!("all: {bytes} bytes, {digest:016x}\n");
    assert_eq!(said, include_str!("../../scenes.txt"), "write it with check.sh --write");
}

#[test]
fn of_a_million_frames_with_bit_errors_none_is_accepted_wrongly_or_lost_silently() {
    quiet(|trace| {
        let fates = send(1_000_000, trace);
        assert_eq!(fates.wrong, 0);
        assert_eq!(fates.accepted + fates.missing + fates.after_the_last, 1_000_000);
        assert_eq!((fates.accepted, fates.after_the_last), (809_140, 0));
    });
}

#[test]
fn bytes_from_nowhere_are_no_frame() {
    let (mut dice, mut receiver) = (Dice::new(3), Receiver::default());
    let mut refused = 0;
    for _ in 0..1_000_000 {
        match receiver.take(dice.bits() as u8) {
            Some(Received::Frame { .. }) => panic!("a frame"),
            Some(Received::Refused) => refused += 1,
            None => {}
        }
    }
    assert!(refused > 3_000);
}

#[test]
fn a_content_that_is_too_long_is_not_sent() {
    let mut sent = 0;
    assert!(!Sender::default().send(&[0; LONGEST + 1], |_| sent += 1));
    assert_eq!(sent, 0);
}

/// Returns the content found by a store that is opened after the power failed.
fn found(flash: FlashModel) -> Option<Vec<u8>> {
    let mut content = [0; store::LONGEST];
    let (_, length) = Store::open(flash, &mut content);
    length.map(|it| content[..it].to_vec())
}

#[test]
fn whichever_word_the_power_cuts_a_whole_record_is_found() {
    let records = [vec![1; 100], vec![2; 240], vec![3; 0]];
    for words in 0..400 {
        let mut flash = FlashModel::erased(words.into());
        flash.powered(words);
        let (mut store, _) = Store::open(flash, &mut [0; store::LONGEST]);
        let written = records.iter().take_while(|it| store.write(it).is_ok()).count();
        let after = found(store.close());
        let last = written.checked_sub(1).map(|it| records[it].clone());
        let torn = records.get(written).cloned();
        assert!(after == last || after.is_some() && after == torn, "cut after {words} words");
    }
}

#[test]
fn erased_and_cleared_flash_hold_nothing() {
    assert_eq!(found(FlashModel::erased(0)), None);
    let mut flash = FlashModel::erased(0);
    flash.write(0, &[0; 512]).unwrap();
    assert_eq!(found(flash), None);
}

#[test]
fn a_damaged_record_gives_way_to_the_one_before() {
    for bit in 0..8 * 512 {
        let mut store = Store::open(FlashModel::erased(0), &mut [0; store::LONGEST]).0;
        store.write(&[1; 136]).unwrap();
        store.write(&[2; 136]).unwrap();
        let mut flash = store.close();
        flash.flip(bit);
        let first = found(flash);
        assert!(first == Some(vec![1; 136]) || first == Some(vec![2; 136]), "bit {bit}");
    }
}

#[test]
fn the_board_boots_with_the_last_whole_state_after_each_of_500_power_cuts() {
    let mut power = Power::NEW;
    quiet(|trace| while power.boot(trace) {});
    let [whole, anew, wrong] = power.counts;
    assert_eq!((whole + anew, wrong), (500, 0));
    assert_eq!(anew, 22); // before the first record was whole, or after the only one was damaged
}

#[test]
fn a_period_survives_the_way_as_bytes_and_other_bytes_are_none() {
    let mut noise = Noise::new(7, TABLES);
    for _ in 0..1_000 {
        let period = noise.period();
        assert_eq!(Period::from_bytes(&period.to_bytes()), Some(period));
    }
    let mut bytes = noise.period().to_bytes();
    assert_eq!(Period::from_bytes(&bytes[1..]), None);
    bytes[25] = 200; // nobody says that
    assert_eq!(Period::from_bytes(&bytes), None);
}

#[test]
fn the_watchdog_starves_when_the_control_loop_hangs_and_not_when_it_is_late_twice() {
    let feeds = |ends: fn(u64) -> bool| {
        let mut guard = Guard::default();
        (0..2_000).find(|&now| {
            if now % 100 == 0 {
                guard.begin(Millis(now));
            }
            if ends(now) {
                guard.end(Millis(now));
            }
            !guard.feeds(Millis(now))
        })
    };
    assert_eq!(feeds(|_| true), None);
    assert_eq!(feeds(|now| !(200..390).contains(&now)), None);
    assert_eq!(feeds(|now| now < 1_000), Some(1_300));
}

/// Returns the answers of a server to a frame.
fn answers(server: &mut Server, sender: &mut Sender, content: &[u8]) -> (Option<Served>, Vec<u8>) {
    let (mut sent, mut back) = (Vec::new(), Vec::new());
    assert!(sender.send(content, |byte| sent.push(byte)));
    let mut memory = Memory::EMPTY;
    let mut served = None;
    for byte in sent {
        served = served.or(server.take(byte, &mut memory.tables, None, |it| back.push(it)));
    }
    let (mut receiver, mut contents) = (Receiver::default(), Vec::new());
    for byte in back {
        if let Some(Received::Frame { content, .. }) = receiver.take(byte) {
            contents.extend_from_slice(content);
        }
    }
    (served, contents)
}

#[test]
fn a_server_answers_each_request() {
    let (mut server, mut sender) = (Server::default(), Sender::default());
    let mut period = vec![PERIOD];
    period.extend(Noise::new(0, TABLES).period().to_bytes());
    let (served, answer) = answers(&mut server, &mut sender, &period);
    assert_eq!((served, answer.len()), (Some(Served::Period), 1 + REQUESTS_BYTES));

    // The whole patrol, nothing used: the plan of the published mission by the rule.
    let asked = Asked { first: 0, rest: 31_000, hardware: 0x1121, used: [0; 2] };
    let (served, answer) =
        answers(&mut server, &mut sender, &[&[PLAN][..], &asked.to_bytes()].concat());
    assert_eq!(served, Some(Served::Answered));
    let ms = u32::from_le_bytes(answer[19..23].try_into().unwrap());
    let mj = u32::from_le_bytes(answer[23..27].try_into().unwrap());
    assert_eq!((ms, mj), (527_924, 8_563_613));

    // Nothing is left of the time.
    let late = Asked { used: [600_000, 0], ..asked };
    let (_, answer) = answers(&mut server, &mut sender, &[&[PLAN][..], &late.to_bytes()].concat());
    assert_eq!(answer, [PLAN, 0]);

    let (_, answer) = answers(&mut server, &mut sender, &[PERIOD, 1, 2]);
    assert_eq!(answer, [UNKNOWN]);
    let (served, answer) = answers(&mut server, &mut sender, &[0xFE]);
    assert_eq!((served, answer), (Some(Served::Other(0xFE)), vec![]));
}

#[test]
fn scenes_have_names_of_their_own() {
    let mut names = Scene::ALL.map(Scene::name);
    names.sort_unstable();
    assert!(names.windows(2).all(|it| it[0] != it[1]));
}

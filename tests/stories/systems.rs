//! Stories of nets that work together.

use cotama_core::net::EventId;
use cotama_core::player::{
    Checked, Kind, Observer, Outcome, Packed, Player, Program, RestoreError, Round, Snapshot, Why,
};
use cotama_core::system::{Of, System, SystemError};
use cotama_core::units::Millis;
use cotama_core::{net, system};

net! {
    /// Makes parts; each carries its number.
    pub mod maker {
        places { Idle: 1 }
        events { make, flush }
        outputs { part, flushed }
        transitions {
            make on make: Idle => Idle emit part;
            flush on flush: Idle => Idle emit flushed;
        }
        laws { deadlock_free; handles(all); }
    }
}

net! {
    /// Takes one part at a time and works on it for 50 ms.
    pub mod worker {
        places { Free: 1, Busy }
        events { part, flush }
        outputs { done }
        transitions {
            begin on part: Free => Busy;
            end: Busy => Free emit done within 50..=60 ms;
        }
        ignore { part in Busy; flush in Free & Busy; }
        laws { handles(all); deadlock_free; }
    }
}

net! {
    /// Counts up to three, then answers nothing any more.
    pub mod tally {
        places { Counting: 1, Full }
        counters { parts: 0 of 3 }
        shared { coming: 0 of 2 }
        events { done }
        transitions {
            count on done [parts < 3]: Counting => Counting do parts += 1;
            full [parts == 3 & coming < 1]: Counting => Full;
        }
        ignore { done in Full; }
        laws { never_both(Counting, Full); reachable(Full); }
    }
}

system! {
    /// A line: parts wait for the worker, who tells the tally at once.
    pub mod line {
        nets { maker: maker, worker: worker, tally: tally }
        links {
            maker.part => worker.part mail 2;
            maker.flushed => worker.flush now;
            worker.done => tally.done now;
        }
        pending { tally.coming = worker.part; }
        clears { worker.flush empties worker.part; }
    }
}

system! {
    /// Two workers hear of each part.
    pub mod broadcast {
        nets { maker: maker, one: worker, two: worker }
        links {
            maker.part => one.part & two.part mail 1;
            maker.flushed => one.flush & two.flush now;
        }
    }
}

system! {
    /// Seventeen workers hear of each part: more happens at once than a player remembers.
    pub mod crowd {
        nets {
            maker: maker, w0: worker, w1: worker, w2: worker, w3: worker, w4: worker,
            w5: worker, w6: worker, w7: worker, w8: worker, w9: worker, w10: worker,
            w11: worker, w12: worker, w13: worker, w14: worker, w15: worker, w16: worker
        }
        links {
            maker.part => w0.part & w1.part & w2.part & w3.part & w4.part & w5.part &
                w6.part & w7.part & w8.part & w9.part & w10.part & w11.part &
                w12.part & w13.part & w14.part & w15.part & w16.part mail 1;
            maker.flushed => w0.flush now;
        }
    }
}

type Line = line::Carrying<u8>;

const MAKE: line::Event = line::Event::maker(maker::Event::make);
const FLUSH: line::Event = line::Event::maker(maker::Event::flush);
const PART: line::Event = line::Event::worker(worker::Event::part);

/// A log in words.
#[derive(Default)]
struct Log(Vec<String>);

fn name(event: Of<EventId>) -> String {
    let component = &line::SYSTEM.components[usize::from(event.component)];
    format!("{}.{}", component.name, component.net.events[event.id.0 as usize].name)
}

impl Observer<line::Program, u8> for Log {
    fn on_fire(&mut self, firing: &line::Firing<'_, u8>) {
        let net = line::SYSTEM.components[usize::from(firing.id.component)].net;
        let transition = net.transitions[firing.id.id.0 as usize].name;
        self.0.push(format!("{transition} at {} with {}", firing.at.0, firing.carries));
    }

    fn on_ignore(&mut self, event: Of<EventId>, carries: u8) {
        self.0.push(format!("{} ignored with {carries}", name(event)));
    }

    fn on_mail(&mut self, to: Of<EventId>, carries: u8) {
        self.0.push(format!("{} mailed with {carries}", name(to)));
    }

    fn on_clear(&mut self, mailbox: Of<EventId>, carries: u8) {
        self.0.push(format!("{} cleared of {carries}", name(mailbox)));
    }
}

#[test]
fn a_mailed_event_waits_for_the_turn_and_carries_its_payload() {
    let (mut line, mut log) = (Line::new(), Log::default());
    assert!(line.offer_carrying(Millis(5), &MAKE, 7, &mut log).fired());
    assert_eq!(line.waiting(&PART), 1);
    assert!(line.round_is_due());
    let round = line.round_with(Millis(10), &mut log);
    assert_eq!(round, Round { fired: 1, ..Round::default() });
    assert!(!line.round_is_due());
    assert_eq!(line.wake_at(), Some(Millis(60)));
    assert_eq!(line.advance_with(Millis(100), &mut log).fired, 2); // the tally counts too
    let told = [
        "make at 5 with 7",
        "worker.part mailed with 7",
        "begin at 10 with 7",
        "end at 60 with 0",
        "count.parts_0 at 60 with 0",
    ];
    // `count` is one line: the counter only adds, so it has one transition.
    let told = told.map(|it| it.replace(".parts_0", ""));
    assert_eq!(log.0, told);
    assert_eq!(line.tokens(line::Place::tally(tally::Place::parts)), 1);
}

#[test]
fn firings_have_typed_lines_and_outputs() {
    let mut line = Line::new();
    let mut seen = Vec::new();
    let mut see = |it: &line::Firing<'_, u8>| {
        assert_eq!(it.event, Some(&MAKE));
        assert!(it.says(line::Output::maker(maker::Output::part)));
        seen.push((it.transition(), it.outputs().collect::<Vec<_>>()));
    };
    assert!(line.offer_with(Millis(0), &MAKE, &mut see).fired());
    let made = line::Transition::maker(maker::Transition::make);
    assert_eq!(seen, [(made, vec![line::Output::maker(maker::Output::part)])]);
}

#[test]
fn a_full_mailbox_refuses_and_nothing_has_happened() {
    let mut line = Line::new();
    for part in [1, 2] {
        assert!(line.offer_carrying(Millis(0), &MAKE, part, &mut ()).fired());
    }
    let before = line;
    let outcome = line.offer_carrying(Millis(0), &MAKE, 3, &mut ());
    assert_eq!(outcome, Outcome::Refused { full: PART.id() });
    assert_eq!(line, before);
}

/// Messages to a person have the names of the tables, not numbers of places in them.
#[test]
fn answers_of_a_system_are_shown_by_their_names() {
    let (mut line, mut cell) = (Line::new(), broadcast::Carrying::<u8>::new());
    let make = broadcast::Event::maker(maker::Event::make);
    let nobody = Of { component: 9, id: EventId(0) };
    let mut shown = vec![
        format!("{:?}", line.offer_carrying(Millis(0), &MAKE, 1, &mut ())),
        format!("{:?}", line.offer_carrying(Millis(0), &MAKE, 2, &mut ())),
        format!("{:?}", line.offer_carrying(Millis(0), &MAKE, 3, &mut ())),
        format!("{:?}", line.offer_carrying(Millis(0), &FLUSH, 4, &mut ())),
        format!("{:?}", cell.offer_carrying(Millis(0), &make, 1, &mut ())),
        format!("{:?}", cell.offer_carrying(Millis(0), &make, 2, &mut ())),
        format!("{:?}", line.offer_id(Millis(0), nobody, 0, &mut ())),
    ];
    let round = cell.round(Millis(0));
    assert_eq!(round.fired, 2);
    shown.push(format!("{:?}", cell.offer_carrying(Millis(0), &make, 3, &mut ())));
    let names = [
        "Fired { transition: maker(make), settled: 0 }",
        "Fired { transition: maker(make), settled: 0 }",
        "Refused { full: worker.part }",
        "Fired { transition: maker(flush), settled: 0 }",
        "Fired { transition: maker(make), settled: 0 }",
        "Refused { full: one.part }",
        "Ignored { why: NoSuchEvent }",
        "Fired { transition: maker(make), settled: 0 }",
    ];
    assert_eq!(shown, names);
}

#[test]
fn the_oldest_event_is_read_first_and_an_unwanted_one_ignored_for_good() {
    let (mut line, mut log) = (Line::new(), Log::default());
    for part in [1, 2] {
        let _ = line.offer_carrying(Millis(0), &MAKE, part, &mut ());
    }
    let round = line.round_with(Millis(0), &mut log);
    assert_eq!(round, Round { fired: 1, ignored: 1, ..Round::default() });
    assert_eq!(log.0, ["begin at 0 with 1", "worker.part ignored with 2"]);
}

#[test]
fn an_event_empties_a_mailbox_even_when_its_net_ignores_it() {
    let (mut line, mut log) = (Line::new(), Log::default());
    for part in [1, 2] {
        let _ = line.offer_carrying(Millis(0), &MAKE, part, &mut ());
    }
    let _ = line.offer_carrying(Millis(0), &FLUSH, 9, &mut log);
    let told = [
        "flush at 0 with 9",
        "worker.part cleared of 1",
        "worker.part cleared of 2",
        "worker.flush ignored with 9",
    ];
    assert_eq!(log.0, told);
    assert_eq!(line.waiting(&PART), 0);
}

#[test]
fn a_shared_place_sees_the_waiting_events() {
    let mut line = Line::new();
    for _ in 0..3 {
        let _ = line.offer(line.now(), &MAKE);
        let _ = line.round(line.now());
        let _ = line.advance(Millis(line.now().0 + 50));
    }
    // Three are counted and nothing waits: with the last one the tally is full, at once.
    assert_eq!(line.tokens(line::Place::tally(tally::Place::Full)), 1);
    assert_eq!(line::state::tally(&line), tally::State::Full);
}

#[test]
fn a_broadcast_reaches_all_or_none() {
    let mut cell = broadcast::Carrying::<u8>::new();
    let make = broadcast::Event::maker(maker::Event::make);
    assert!(cell.offer_carrying(Millis(0), &make, 1, &mut ()).fired());
    let one = broadcast::Event::one(worker::Event::part);
    let two = broadcast::Event::two(worker::Event::part);
    assert_eq!((cell.waiting(&one), cell.waiting(&two)), (1, 1));
    let before = cell;
    let outcome = cell.offer_carrying(Millis(0), &make, 2, &mut ());
    assert_eq!(outcome, Outcome::Refused { full: one.id() });
    assert_eq!(cell, before);
}

#[test]
fn an_event_of_no_net_is_ignored() {
    let mut line = line::Player::new();
    let nobody = Of { component: 9, id: EventId(0) };
    let outcome = line.offer_id(Millis(0), nobody, (), &mut ());
    assert_eq!(outcome, Outcome::Ignored { why: Why::NoSuchEvent });
}

#[test]
fn time_is_the_same_in_one_step_or_many() {
    let drive = |steps: &[u64]| {
        let (mut line, mut log) = (Line::new(), Log::default());
        let _ = line.offer_carrying(Millis(0), &MAKE, 1, &mut log);
        let _ = line.round_with(Millis(0), &mut log);
        for &step in steps {
            let _ = line.advance_with(Millis(step), &mut log);
        }
        (line, log.0)
    };
    assert_eq!(drive(&[200]), drive(&[1, 49, 50, 51, 199, 200]));
}

/// The same system made at run time, without its bindings, is refused: a shared place belongs to
/// nobody.
#[test]
fn a_system_that_does_not_fit_together_says_why() {
    let whole = line::SYSTEM;
    assert_eq!(whole.defect(), None);
    let unbound = System { bindings: &[], ..whole };
    assert!(matches!(unbound.defect(), Some(SystemError::Unbound(Of { component: 2, .. }))));
    let packed = Packed::<2, 1, 2>::of(&whole).unwrap();
    let program = packed.load(&whole);
    assert_eq!(program.code().initial.first(), line::Program.code().initial.first());
    let mut played = Player::<_, 2, 1, 2, u8>::start(program, Millis(0), &mut ());
    assert!(played.offer_carrying(Millis(0), &MAKE.id(), 1, &mut ()).fired());
}

/// Counts what happens.
#[derive(Default)]
struct Tally {
    fired: usize,
    mailed: Vec<u16>,
}

impl Observer<crowd::Program> for Tally {
    fn on_fire(&mut self, _: &crowd::Firing<'_>) {
        self.fired += 1;
    }

    fn on_mail(&mut self, to: Of<EventId>, (): ()) {
        self.mailed.push(to.component);
    }
}

#[test]
fn however_much_happens_at_once_it_is_told_once() {
    let (mut player, mut tally) = (crowd::Player::new(), Tally::default());
    let make = crowd::Event::maker(maker::Event::make);
    assert!(player.offer_with(Millis(0), &make, &mut tally).fired());
    assert_eq!((tally.fired, tally.mailed), (1, (1..18).collect()));
}

/// A system that is stored comes back with its clocks and all that waits.
#[test]
fn a_stored_line_goes_on_from_its_state() {
    let mut line = Line::new();
    let _ = line.offer_carrying(Millis(0), &MAKE, 1, &mut ());
    let _ = line.round(Millis(0));
    let _ = line.offer_carrying(Millis(30), &MAKE, 2, &mut ());
    let mut flash = [0; 64];
    let written = line.snapshot().write(&mut flash).unwrap().len();
    let stored = Snapshot::read(&flash[..written]).unwrap();

    let now = Millis(1_000);
    let restored = |stored| line::Checked::<u8>::restore(Checked::default(), now, stored);
    // A mailbox with less room than it has left is no mailbox of this line.
    let program = line::Program;
    let [mailbox] = program.code().mailboxes else { panic!("one event is mailed") };
    let mut less = stored;
    let room = mailbox.room.unwrap();
    less.marking[usize::from(room.word)] -= room.tokens(1);
    assert_eq!(restored(&less).err(), Some(RestoreError::Marking));
    let mut again = restored(&stored).unwrap();
    assert_eq!(line::state::worker(&again), worker::State::Busy);
    assert_eq!(again.waiting(&PART), 1);
    assert_eq!(again.advance(Millis(1_019)).fired, 0);
    assert_eq!(again.advance(Millis(1_020)).fired, 2); // 50 ms after it began
    let mut carried = Vec::new();
    let mut see = |it: &cotama_core::player::Firing<'_, _, u8>| carried.push(it.carries);
    let round = again.round_with(Millis(1_020), &mut see);
    assert_eq!((round.fired, carried), (1, vec![2]));
}

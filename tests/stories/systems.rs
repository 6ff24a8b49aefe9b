//! Stories of nets that work together.

use cotama_core::net::EventId;
use cotama_core::player::{Player, Program};
use cotama_core::system::{Happening, Of, Offered, SystemDefect, Turned, Witness};
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

fn make() -> Of<EventId> {
    line::on::maker(&maker::Event::make)
}

/// What is seen, in words.
#[derive(Default)]
struct Log(Vec<String>);

impl Witness<u8> for Log {
    fn see(&mut self, happening: &Happening<u8>) {
        let component = |component: u16| &line::SYSTEM.components[usize::from(component)];
        let event = |of: &Of<EventId>| {
            let component = component(of.component);
            format!("{}.{}", component.name, component.net.events[of.id.0 as usize].name)
        };
        self.0.push(match happening {
            Happening::Fired { transition, carries, at, .. } => {
                let net = component(transition.component).net;
                format!(
                    "{} at {} with {carries}",
                    net.transitions[transition.id.0 as usize].name, at.0
                )
            }
            Happening::Ignored { event: of, carries } => {
                format!("{} ignored with {carries}", event(of))
            }
            Happening::Mailed { to, carries } => format!("{} mailed with {carries}", event(to)),
            Happening::Cleared { mailbox, carries } => {
                format!("{} cleared of {carries}", event(mailbox))
            }
        });
    }
}

#[test]
fn what_is_mailed_waits_for_the_turn_and_carries_its_payload() {
    let (mut line, mut log) = (line::Player::<u8>::new(), Log::default());
    assert!(matches!(line.offer(Millis(5), make(), 7, &mut log), Offered::Fired(_)));
    assert_eq!(line.waiting(line::on::worker(&worker::Event::part)), 1);
    assert_eq!(line.round(Millis(10), &mut log), Turned { fired: 1, ..Turned::default() });
    assert_eq!(line.wake_at(), Some(Millis(60)));
    assert_eq!(line.advance(Millis(100), &mut log).fired, 1);
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
    assert_eq!(line.tokens(line::at::tally(tally::Place::parts)), 1);
}

#[test]
fn a_full_mailbox_refuses_and_nothing_has_happened() {
    let mut line = line::Player::<u8>::new();
    for part in [1, 2] {
        assert!(matches!(line.offer(Millis(0), make(), part, &mut ()), Offered::Fired(_)));
    }
    let before = line;
    let full = line::on::worker(&worker::Event::part);
    assert_eq!(line.offer(Millis(0), make(), 3, &mut ()), Offered::Refused { full });
    assert_eq!(line, before);
}

#[test]
fn the_oldest_is_read_first_and_what_is_not_wanted_is_ignored_for_good() {
    let (mut line, mut log) = (line::Player::<u8>::new(), Log::default());
    for part in [1, 2] {
        let _ = line.offer(Millis(0), make(), part, &mut ());
    }
    assert_eq!(line.round(Millis(0), &mut log), Turned { fired: 1, ignored: 1, waiting: 0 });
    assert_eq!(log.0, ["begin at 0 with 1", "worker.part ignored with 2"]);
}

#[test]
fn an_event_empties_a_mailbox_even_when_its_net_ignores_it() {
    let (mut line, mut log) = (line::Player::<u8>::new(), Log::default());
    for part in [1, 2] {
        let _ = line.offer(Millis(0), make(), part, &mut ());
    }
    let _ = line.offer(Millis(0), line::on::maker(&maker::Event::flush), 9, &mut log);
    let told = [
        "flush at 0 with 9",
        "worker.part cleared of 1",
        "worker.part cleared of 2",
        "worker.flush ignored with 9",
    ];
    assert_eq!(log.0, told);
    assert_eq!(line.waiting(line::on::worker(&worker::Event::part)), 0);
}

#[test]
fn a_shared_place_sees_what_waits() {
    let mut line = line::Player::<u8>::new();
    for _ in 0..3 {
        let _ = line.offer(line.now(), make(), 0, &mut ());
        let _ = line.round(line.now(), &mut ());
        let _ = line.advance(Millis(line.now().0 + 50), &mut ());
    }
    // Three are counted and nothing waits: with the last one the tally is full, at once.
    assert_eq!(line.tokens(line::at::tally(tally::Place::Full)), 1);
}

#[test]
fn a_broadcast_reaches_all_or_none() {
    let mut cell = broadcast::Player::<u8>::new();
    let make = broadcast::on::maker(&maker::Event::make);
    assert!(matches!(cell.offer(Millis(0), make, 1, &mut ()), Offered::Fired(_)));
    let (one, two) =
        (broadcast::on::one(&worker::Event::part), broadcast::on::two(&worker::Event::part));
    assert_eq!((cell.waiting(one), cell.waiting(two)), (1, 1));
    let before = cell;
    assert_eq!(cell.offer(Millis(0), make, 2, &mut ()), Offered::Refused { full: one });
    assert_eq!(cell, before);
}

#[test]
fn an_event_of_no_net_is_refused() {
    let mut line = line::Player::<()>::new();
    let nobody = Of { component: 9, id: EventId(0) };
    assert_eq!(line.offer(Millis(0), nobody, (), &mut ()), Offered::NotNow);
}

#[test]
fn time_is_the_same_in_one_step_or_many() {
    let drive = |steps: &[u64]| {
        let (mut line, mut log) = (line::Player::<u8>::new(), Log::default());
        let _ = line.offer(Millis(0), make(), 1, &mut log);
        let _ = line.round(Millis(0), &mut log);
        for &step in steps {
            let _ = line.advance(Millis(step), &mut log);
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
    let unbound = cotama_core::system::System { bindings: &[], ..whole };
    assert!(matches!(unbound.defect(), Some(SystemDefect::Unbound(Of { component: 2, .. }))));
    let packed = cotama_core::system::Packed::<2>::of(&whole).unwrap();
    let code = packed.code();
    assert_eq!(code.initial.first(), line::Program.code().initial.first());
    let mut played = Player::<_, u8, 2, 1, 2>::start(code, Millis(0), &mut ());
    assert!(matches!(played.offer(Millis(0), make(), 1, &mut ()), Offered::Fired(_)));
}

//! Mailboxes: nothing is lost, nothing is overtaken, nothing is held beyond their room.

use super::super::Kind;
use crate::net::EventId;
use crate::player::{Firing, Names, Observer, Outcome};
use crate::system::Of;
use cotama_units::proofs::few;
use cotama_units::units::Millis;

crate::net! {
    /// Sends a part whenever it is asked to.
    pub mod sender {
        places { Ready: 1 }
        events { send, call_off }
        outputs { part, off }
        transitions {
            send on send: Ready => Ready emit part;
            call_off on call_off: Ready => Ready emit off;
        }
    }
}

crate::net! {
    /// Holds one part at a time, and lets others pass.
    pub mod receiver {
        places { Free: 1, Held }
        events { part, release, off }
        transitions {
            hold on part: Free => Held;
            release on release: Held => Free;
            off on off: Held => Free;
        }
        ignore { part in Held; release in Free; off in Free; }
    }
}

crate::system! {
    /// Parts wait in a mailbox for two; calling off empties it.
    pub mod line {
        nets { sender: sender, receiver: receiver }
        links { sender.part => receiver.part mail 2; sender.off => receiver.off now; }
        clears { receiver.off empties receiver.part; }
    }
}

crate::system! {
    /// Two receivers, one after the other.
    pub mod pair {
        nets { one: sender, other: sender, first: receiver, second: receiver }
        links { one.part => first.part mail 2; other.part => second.part mail 1; }
    }
}

crate::system! {
    /// The same with the second receiver before the first.
    pub mod turned {
        nets { one: sender, other: sender, second: receiver, first: receiver }
        links { one.part => first.part mail 2; other.part => second.part mail 1; }
    }
}

type Line = line::Carrying<u8>;

const SEND: line::Event = line::Event::sender(sender::Event::send);
const CALL_OFF: line::Event = line::Event::sender(sender::Event::call_off);
const RELEASE: line::Event = line::Event::receiver(receiver::Event::release);

/// The parts reported to the observer: those mailed, those that came, those that were cleared.
#[derive(Default)]
struct Told {
    mailed: u8,
    /// The numbers of the parts that came, in order.
    came: [u8; 9],
    count: usize,
    cleared: u8,
}

fn is_part(event: Of<EventId>) -> bool {
    event == line::Event::receiver(receiver::Event::part).id()
}

impl Told {
    fn come(&mut self, number: u8) {
        self.came[self.count] = number;
        self.count += 1;
    }
}

impl<P: Names> Observer<P, u8> for Told {
    fn on_fire(&mut self, firing: &Firing<'_, P, u8>) {
        if firing.on.is_some_and(is_part) {
            self.come(firing.carries);
        }
    }

    fn on_ignore(&mut self, event: Of<EventId>, carries: u8) {
        if is_part(event) {
            self.come(carries);
        }
    }

    fn on_mail(&mut self, _: Of<EventId>, _: u8) {
        self.mailed += 1;
    }

    fn on_clear(&mut self, _: Of<EventId>, _: u8) {
        self.cleared += 1;
    }
}

/// All that was mailed comes, in the order in which it was mailed, or is cleared, or still waits;
/// each part comes with what it carries, and what does not fit is refused.
#[kani::proof]
#[kani::unwind(9)]
pub fn nothing_is_lost_or_overtaken() {
    let (mut line, mut told) = (Line::new(), Told::default());
    let (mut sent, mut next) = (0, 0);
    for _ in 0..8 {
        match few::<2>() {
            0 => {
                let waiting = line.waiting(&line::Event::receiver(receiver::Event::part));
                let said = line.offer_carrying(Millis(0), &SEND, sent, &mut told);
                assert!(said.fired() == (waiting < 2));
                sent += u8::from(said.fired());
            }
            1 => _ = line.round_with(Millis(0), &mut told),
            2 => {
                let said = line.offer_carrying(Millis(0), &CALL_OFF, 99, &mut told);
                assert!(said.fired() && !line.round_is_due());
            }
            _ => _ = line.offer_with(Millis(0), &RELEASE, &mut told),
        }
        let waiting = line.waiting(&line::Event::receiver(receiver::Event::part));
        assert!(waiting <= 2 && told.mailed == sent);
        assert!(told.count as u32 + u32::from(told.cleared) + waiting == u32::from(sent));
        // They come with rising numbers: a gap is what was cleared.
        while next < told.count {
            assert!(told.came[next] < sent && (next == 0 || told.came[next - 1] < told.came[next]));
            next += 1;
        }
        kani::cover!(told.cleared == 2 && told.count == 2, "two came and two were cleared");
    }
    kani::cover!(told.count == 4, "four came");
}

/// An event that is refused leaves everything as it was, and says which mailbox is full.
#[kani::proof]
#[kani::unwind(7)]
pub fn a_refused_event_leaves_no_trace() {
    let mut line = Line::new();
    for _ in 0..6 {
        if kani::any() {
            let _ = line.offer_carrying(Millis(0), &SEND, few::<1>(), &mut ());
        } else {
            let _ = line.round(Millis(0));
        }
    }
    let (before, mut told) = (line, Told::default());
    let said = line.offer_carrying(Millis(0), &SEND, 7, &mut told);
    let part = line::Event::receiver(receiver::Event::part);
    if let Outcome::Refused { full } = said {
        assert!(line == before && full == part.id() && told.mailed == 0);
    } else {
        assert!(line.waiting(&part) == before.waiting(&part) + 1 && told.mailed == 1);
        assert!(before.waiting(&part) < 2);
    }
    kani::cover!(!said.fired() && before.slots[0] != before.slots[1], "full of two that differ");
    kani::cover!(said.fired() && before.waiting(&part) == 1, "one more");
}

/// A round is an interleaving: with nets that take nothing from each other, whose turn comes first
/// makes no difference.
#[kani::proof]
#[kani::unwind(7)]
pub fn the_order_of_turns_is_no_matter_without_conflict() {
    let (mut pair, mut turned) = (pair::Player::new(), turned::Player::new());
    for _ in 0..6 {
        match few::<2>() {
            0 => {
                let one = pair.offer(Millis(0), &pair::Event::one(sender::Event::send));
                let other = turned.offer(Millis(0), &turned::Event::one(sender::Event::send));
                assert!(one.fired() == other.fired());
            }
            1 => {
                let one = pair.offer(Millis(0), &pair::Event::other(sender::Event::send));
                let other = turned.offer(Millis(0), &turned::Event::other(sender::Event::send));
                assert!(one.fired() == other.fired());
            }
            2 => {
                let _ = pair.offer(Millis(0), &pair::Event::first(receiver::Event::release));
                let _ = turned.offer(Millis(0), &turned::Event::first(receiver::Event::release));
            }
            _ => assert!(pair.round(Millis(0)) == turned.round(Millis(0))),
        }
        let [one, other] = [pair::state::first(&pair), turned::state::first(&turned)];
        assert!(one == other && pair.round_is_due() == turned.round_is_due());
        assert!(pair::state::second(&pair) == turned::state::second(&turned));
        kani::cover!(
            one == receiver::State::Held && pair::state::second(&pair) == receiver::State::Held,
            "both hold a part"
        );
    }
}

/// A round reads what waited when the turn of the net came: all of it is fired or ignored, told,
/// and gone.
#[kani::proof]
#[kani::unwind(7)]
pub fn a_round_empties_the_mailboxes_that_waited() {
    let mut line = Line::new();
    for _ in 0..6 {
        match few::<2>() {
            0 => _ = line.round(Millis(0)),
            1 => _ = line.offer(Millis(0), &RELEASE),
            number => _ = line.offer_carrying(Millis(0), &SEND, number, &mut ()),
        }
    }
    let waiting = line.waiting(&line::Event::receiver(receiver::Event::part));
    let held = line::state::receiver(&line) == receiver::State::Held;
    let round = line.round(Millis(0));
    assert!(round.fired + round.ignored == waiting && round.waiting == 0 && !round.behind);
    assert!(round.fired == u32::from(waiting > 0 && !held) && !line.round_is_due());
    kani::cover!(round.ignored == 1 && round.fired == 1, "one fires and one is ignored");
    kani::cover!(held && waiting == 1, "already held");
}

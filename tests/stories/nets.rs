//! The player against the textbook: on random nets both do the same, firing by firing.

mod limits;
mod snapshots;

use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{EventId, Net, OutputId, PlaceId, TransitionId};
use cotama_core::player::code::Code;
use cotama_core::player::{Firing, Loaded, Outcome, Packed, Player, Why, clocks, words};
use cotama_core::units::Millis;
use cotama_tests::instances::Draw;
use cotama_tests::textbook::nets::{CLOCKS, Time, WORDS, one_in, pick, random_net};
use cotama_tests::textbook::{Fired, Game};

/// What is played: a net of `W` words and up to `C` intervals.
type Played<'c, const W: usize, const C: usize> = Player<Loaded<'c, W>, W, C>;

/// Calls a function of `W` and `C` with the number of words that this net needs, or seldom with one
/// more, and with [`CLOCKS`] clocks, or none when none is needed.
macro_rules! with_size_of {
    ($net:expr, $draw:expr, $story:ident($($argument:expr),*)) => {{
        use $crate::nets::{CLOCKS, clocks, one_in, words};
        match (words($net).unwrap() + usize::from(one_in($draw, 8)), clocks($net)) {
            (1, 0) => $story::<1, 0>($($argument),*),
            (2, 0) => $story::<2, 0>($($argument),*),
            (1, _) => $story::<1, CLOCKS>($($argument),*),
            (2, _) => $story::<2, CLOCKS>($($argument),*),
            (3, _) => $story::<3, CLOCKS>($($argument),*),
            (4, _) => $story::<4, CLOCKS>($($argument),*),
            (5.., _) => $story::<5, CLOCKS>($($argument),*),
            (0, _) => unreachable!("a net has a place"),
        }
    }};
}
use with_size_of;

/// The packed net; half of the nets whose bounds hold in every order of firing are played as such.
fn load<'c, const W: usize>(
    packed: &'c Packed<W>,
    net: &Net<'c>,
    draw: &mut Draw,
) -> Loaded<'c, W> {
    let Loaded { net, code } = packed.load(net);
    let bounded = one_in(draw, 2) && Game::is_bounded(&net, 60);
    Loaded { net, code: Code { bounded, ..code } }
}

/// An observer that writes down what it is told.
fn record<'l>(
    net: &'l Net<'_>,
    log: &'l mut Vec<Fired>,
) -> impl FnMut(&Firing<'_, EventId, TransitionId, OutputId>) + 'l {
    |firing| {
        assert_eq!(firing.transition, firing.id);
        assert_eq!(firing.outputs, net.transitions[firing.id.0 as usize].emits);
        log.push(Fired { transition: firing.id, event: firing.event.copied(), at: firing.at.0 });
    }
}

/// Everything that can be seen of a player is as in the game.
fn assert_same<const W: usize, const C: usize>(
    player: &Played<'_, W, C>,
    log: &[Fired],
    game: &Game<'_>,
    seed: u64,
) {
    assert_eq!(log, game.fired, "seed {seed}");
    let tokens: Vec<u32> =
        (0..game.tokens.len()).map(|it| player.tokens(PlaceId(it as u32))).collect();
    assert_eq!(tokens, game.tokens, "seed {seed}");
    assert_eq!(player.now(), Millis(game.now), "seed {seed}");
    assert_eq!(player.wake_at(), game.wake_at().map(Millis), "seed {seed}");
    for transition in (0..game.since.len()).map(|it| TransitionId(it as u32)) {
        assert_eq!(
            player.enabled(transition),
            game.can_fire(transition),
            "seed {seed}, {transition:?}"
        );
    }
    assert!(game.is_within_bounds(), "seed {seed}");
}

/// The nets of these seeds.
fn nets(seeds: std::ops::Range<u64>, time: Time) -> impl Iterator<Item = (u64, OwnedNet, Draw)> {
    seeds.map(move |seed| {
        let mut draw = Draw::new(seed);
        let net = random_net(&mut draw, time);
        (seed, net, draw)
    })
}

/// Mostly soon, sometimes now, seldom much later.
fn delay(draw: &mut Draw) -> u64 {
    match draw.between(0, 15) {
        0..=2 => 0,
        3 => 100,
        _ => draw.between(1, 20),
    }
}

/// How often a story has seen what.
#[derive(Debug, Default)]
struct Seen {
    fired: u32,
    settled: u32,
    by_itself: u32,
    on_purpose: u32,
    not_enabled: u32,
    too_early: u32,
    too_late: u32,
    full: u32,
    endless: u32,
    bounded: u32,
    state_machines: u32,
    words: [u32; WORDS + 2],
}

impl Seen {
    /// A story that saw too little would prove nothing.
    fn assert_enough(&self) {
        let outcomes = [self.fired, self.settled, self.on_purpose, self.not_enabled, self.full];
        assert!(outcomes.iter().all(|&it| it > 5_000), "{self:?}");
        let nets = [self.endless, self.bounded, self.state_machines];
        assert!(nets.iter().all(|&it| it > 500), "{self:?}");
        assert!(self.words[1..=WORDS].iter().all(|&it| it > 100), "{self:?}");
    }

    fn outcome(&mut self, outcome: Outcome<TransitionId>) {
        let of = match outcome {
            Outcome::Fired { settled, .. } => {
                self.settled += u32::from(settled > 0);
                &mut self.fired
            }
            Outcome::Ignored { why } => match why {
                Why::OnPurpose => &mut self.on_purpose,
                Why::NotEnabled => &mut self.not_enabled,
                Why::TooEarly(_) => &mut self.too_early,
                Why::TooLate(_) => &mut self.too_late,
                Why::Full(_) => &mut self.full,
                Why::Behind => unreachable!("the textbook is never behind"),
            },
        };
        *of += 1;
    }
}

/// Offers 50 events to a player and to the textbook.
fn offers_are_answered_by_the_book<const W: usize, const C: usize>(
    net: &Net<'_>,
    seed: u64,
    draw: &mut Draw,
    seen: &mut Seen,
) {
    let packed = Packed::<W>::of(net).unwrap();
    let program = load(&packed, net, draw);
    let (mut log, mut now) = (Vec::new(), draw.between(0, 1_000));
    let mut player: Played<'_, W, C> =
        Player::start(program, Millis(now), &mut record(net, &mut log));
    let mut game = Game::start(net, now);
    seen.words[W] += 1;
    seen.bounded += u32::from(program.code.bounded);
    seen.state_machines += u32::from(program.code.control != 0);
    for _ in 0..50 {
        if game.endless {
            seen.endless += 1;
            return;
        }
        assert_same(&player, &log, &game, seed);
        now += if clocks(net) > 0 { delay(draw) } else { draw.between(0, 1) };
        let told = if one_in(draw, 16) { now.saturating_sub(30) } else { now };
        let before = game.fired.len() as u32;
        if net.events.is_empty() || one_in(draw, 10) {
            let advanced = player.advance_with(Millis(told), &mut record(net, &mut log));
            game.advance(told);
            if !game.endless {
                assert!(!advanced.behind, "seed {seed}");
                assert_eq!(advanced.fired, game.fired.len() as u32 - before, "seed {seed}");
                seen.by_itself += advanced.fired;
            }
        } else {
            let event = EventId(draw.between(0, net.events.len() as u64 - 1) as u32);
            let outcome = player.offer_with(Millis(told), &event, &mut record(net, &mut log));
            let by_the_book = game.offer(told, event);
            if !game.endless {
                assert_eq!(outcome, by_the_book, "seed {seed}");
                seen.outcome(outcome);
            }
        }
    }
    if !game.endless {
        assert_same(&player, &log, &game, seed);
    }
}

#[test]
fn events_are_answered_by_the_book() {
    let mut seen = Seen::default();
    for (seed, net, mut draw) in nets(0..20_000, Time::Without) {
        let view = net.view();
        let net = &view.net();
        let (draw, seen) = (&mut draw, &mut seen);
        with_size_of!(net, draw, offers_are_answered_by_the_book(net, seed, draw, seen));
    }
    seen.assert_enough();
}

#[test]
fn time_passes_by_the_book() {
    let mut seen = Seen::default();
    for (seed, net, mut draw) in nets(100_000..120_000, Time::With) {
        let view = net.view();
        let net = &view.net();
        let (draw, seen) = (&mut draw, &mut seen);
        with_size_of!(net, draw, offers_are_answered_by_the_book(net, seed, draw, seen));
    }
    seen.assert_enough();
    assert!(
        [seen.by_itself, seen.too_early, seen.too_late].iter().all(|&it| it > 5_000),
        "{seen:?}"
    );
}

/// Plays 50 rounds, with an offer in between now and then.
fn rounds_are_those_of_the_book<const W: usize, const C: usize>(
    net: &Net<'_>,
    seed: u64,
    draw: &mut Draw,
    seen: &mut [u32; 3],
) {
    let packed = Packed::<W>::of(net).unwrap();
    let program = load(&packed, net, draw);
    let (mut log, mut now) = (Vec::new(), 0);
    let mut player: Played<'_, W, C> =
        Player::start(program, Millis(now), &mut record(net, &mut log));
    let mut game = Game::start(net, now);
    for _ in 0..50 {
        if game.endless {
            return;
        }
        assert_same(&player, &log, &game, seed);
        now += delay(draw) / 2;
        let some = if net.events.is_empty() { 0 } else { draw.between(0, 4) };
        let events: Vec<EventId> = (0..some)
            .map(|_| EventId(draw.between(0, net.events.len() as u64 - 1) as u32))
            .collect();
        if let Some(event) = events.first().filter(|_| one_in(draw, 16)) {
            let outcome = player.offer_with(Millis(now), event, &mut record(net, &mut log));
            let by_the_book = game.offer(now, *event);
            assert!(game.endless || outcome == by_the_book, "seed {seed}");
            continue;
        }
        let before = game.clone();
        let round = player.round_with(Millis(now), &events, &mut record(net, &mut log));
        assert_eq!(round, game.round(now, &events), "seed {seed}");
        seen[0] += u32::from(round.full);
        seen[1] += u32::from(round.fired > 1);
        seen[2] += u32::from(round.ignored > 1);
        if round.full {
            assert_eq!(game.tokens, before.tokens);
            assert_eq!(round.ignored.count_ones() as usize, events.len());
        }
        is_one_of_the_interleavings(before, &game, seed);
    }
}

/// What fired in a round can also fire one after another, and comes to the same marking.
fn is_one_of_the_interleavings(mut before: Game<'_>, after: &Game<'_>, seed: u64) {
    for fired in &after.fired[before.fired.len()..] {
        assert!(before.force(fired.transition), "seed {seed}: {fired:?} is not enabled");
    }
    assert_eq!(before.tokens, after.tokens, "seed {seed}");
}

#[test]
fn rounds_go_by_the_book() {
    let mut seen = [0; 3];
    for time in [Time::Without, Time::With] {
        for (seed, net, mut draw) in nets(200_000..210_000, time) {
            let view = net.view();
            let net = &view.net();
            let (draw, seen) = (&mut draw, &mut seen);
            with_size_of!(net, draw, rounds_are_those_of_the_book(net, seed, draw, seen));
        }
    }
    assert!(seen.iter().all(|&it| it > 5_000), "{seen:?}");
}

/// Plays the same events three times: told the time only with an event, at every instant, and
/// whenever the player wants to be told. What fires, and when, is the same.
fn polling_makes_no_difference<const W: usize, const C: usize>(
    net: &Net<'_>,
    seed: u64,
    draw: &mut Draw,
) {
    let mut now = 0;
    let mut events: Vec<(u64, Option<EventId>)> = Vec::new();
    for _ in 0..30 {
        now += delay(draw);
        let all: Vec<EventId> = (0..net.events.len()).map(|it| EventId(it as u32)).collect();
        events.push((now, if all.is_empty() { None } else { Some(*pick(draw, &all)) }));
    }
    let packed = Packed::<W>::of(net).unwrap();
    let program = load(&packed, net, draw);
    let mut game = Game::start(net, 0);
    for &(at, event) in &events {
        match event {
            Some(event) => _ = game.offer(at, event),
            None => game.advance(at),
        }
        if game.endless {
            return;
        }
    }
    let play = |until: &mut dyn FnMut(&mut Played<'_, W, C>, u64, &mut Vec<Fired>)| {
        let mut log = Vec::new();
        let mut player: Played<'_, W, C> =
            Player::start(program, Millis(0), &mut record(net, &mut log));
        let mut outcomes = Vec::new();
        for &(at, event) in &events {
            until(&mut player, at, &mut log);
            match event {
                Some(event) => {
                    outcomes.push(player.offer_with(
                        Millis(at),
                        &event,
                        &mut record(net, &mut log),
                    ));
                }
                None => {
                    assert!(!player.advance_with(Millis(at), &mut record(net, &mut log)).behind)
                }
            }
        }
        (outcomes, log, player.now(), player.snapshot())
    };
    let late = play(&mut |_, _, _| ());
    let always = play(&mut |player, at, log| {
        for now in player.now().0..at {
            assert!(!player.advance_with(Millis(now), &mut record(net, log)).behind);
        }
    });
    let when_due = play(&mut |player, at, log| {
        while let Some(due) = player.wake_at().filter(|due| due.0 < at) {
            if due > player.now() {
                let (mut early, before) = (*player, Millis(due.0 - 1));
                assert_eq!(early.advance(before).fired, 0, "seed {seed}: at {before}");
            }
            let fired = player.advance_with(due, &mut record(net, log)).fired;
            assert_ne!(fired, 0, "seed {seed}: at {due}");
        }
    });
    assert_eq!(late, always, "seed {seed}");
    assert_eq!(late, when_due, "seed {seed}");
    assert_eq!(late.1, game.fired, "seed {seed}");
}

#[test]
fn a_player_that_is_told_the_time_late_catches_up() {
    for (seed, net, mut draw) in nets(300_000..305_000, Time::With) {
        let view = net.view();
        let net = &view.net();
        let draw = &mut draw;
        with_size_of!(net, draw, polling_makes_no_difference(net, seed, draw));
    }
}

//! The player against the textbook: on random nets and systems both do the same, firing by firing.

mod limits;
mod packed;
mod seen;
mod snapshots;
mod steps;

use cotama_core::net::{EventId, OutputId, PlaceId, TransitionId};
use cotama_core::player::{
    Firing, Loaded, Names, Observer, Packed, Player, Program, clocks, slots, words,
};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;
use cotama_tests::textbook::nets::{Time, one_in, random_net};
use cotama_tests::textbook::systems::{CLOCKS, OwnedSystem, SLOTS, random_system};
use cotama_tests::textbook::{Game, Told};
use seen::Seen;

/// What is played: `W` words, up to `C` intervals, up to `S` in mailboxes, and numbers carried
/// along.
type Played<'c, const W: usize, const C: usize, const S: usize> =
    Player<Loaded<'c, W, C, S>, W, C, S, u16>;

/// Calls a function of `W`, `C` and `S` for this system: as much as it needs, or more.
macro_rules! with_size_of {
    ($system:expr, $draw:expr, $story:ident($($argument:expr),*)) => {{
        use $crate::players::{CLOCKS, SLOTS, clocks, one_in, slots, words};
        let needs = words($system).unwrap() + usize::from(one_in($draw, 8));
        match ($system.is_alone(), needs, clocks($system), slots($system)) {
            (true, 1, 0, _) => $story::<1, 0, 0>($($argument),*),
            (true, 2, 0, _) => $story::<2, 0, 0>($($argument),*),
            (true, 1, ..) => $story::<1, CLOCKS, 0>($($argument),*),
            (true, 2, ..) => $story::<2, CLOCKS, 0>($($argument),*),
            (true, 3, ..) => $story::<3, CLOCKS, 0>($($argument),*),
            (true, 4, ..) => $story::<4, CLOCKS, 0>($($argument),*),
            (true, ..) => $story::<5, CLOCKS, 0>($($argument),*),
            (false, ..=2, 0, _) => $story::<2, 0, SLOTS>($($argument),*),
            (false, ..=2, _, 0) => $story::<2, CLOCKS, 0>($($argument),*),
            (false, ..=2, ..) => $story::<2, CLOCKS, SLOTS>($($argument),*),
            (false, ..=5, ..) => $story::<5, CLOCKS, SLOTS>($($argument),*),
            (false, ..) => $story::<12, CLOCKS, SLOTS>($($argument),*),
        }
    }};
}
use with_size_of;

/// The packed system; half of the nets whose bounds hold in every order of firing are played as
/// such.
fn load<'c, const W: usize, const C: usize, const S: usize>(
    packed: &'c Packed<W, C, S>,
    system: &System<'c>,
    draw: &mut Draw,
) -> Loaded<'c, W, C, S> {
    let loaded = packed.load(system);
    let is_bounded = one_in(draw, 2) && system.is_alone() && Game::is_bounded(system, 60);
    if is_bounded { loaded.bounded() } else { loaded }
}

/// An observer that writes down what it is told.
struct Log<'s> {
    system: &'s System<'s>,
    told: Vec<Told>,
    /// How many transitions fired on an event from outside.
    outside: u32,
}

impl<'s> Log<'s> {
    fn new(system: &'s System<'s>) -> Self {
        Self { system, told: Vec::new(), outside: 0 }
    }
}

impl<P> Observer<P, u16> for Log<'_>
where
    P: Names<Event = Of<EventId>, Transition = Of<TransitionId>, Output = Of<OutputId>>,
{
    fn on_fire(&mut self, firing: &Firing<'_, P, u16>) {
        let Firing { id, on, carries, at, .. } = *firing;
        assert_eq!(firing.transition(), id);
        let net = self.system.components[usize::from(id.component)].net;
        let says = net.transitions[id.id.0 as usize].emits;
        let says = says.iter().map(|&output| Of { id: output, component: id.component });
        assert!(firing.outputs().eq(says));
        if let Some(event) = firing.event {
            assert_eq!(on, Some(*event));
            self.outside += 1;
        }
        self.told.push(Told::Fired(id, on, at.0, carries));
    }

    fn on_ignore(&mut self, event: Of<EventId>, carries: u16) {
        self.told.push(Told::Ignored(event, carries));
    }

    fn on_mail(&mut self, to: Of<EventId>, carries: u16) {
        self.told.push(Told::Mailed(to, carries));
    }

    fn on_clear(&mut self, mailbox: Of<EventId>, carries: u16) {
        self.told.push(Told::Cleared(mailbox, carries));
    }
}

/// Everything that can be seen of a player is as in the game.
fn assert_same<const W: usize, const C: usize, const S: usize>(
    player: &Played<'_, W, C, S>,
    log: &Log<'_>,
    game: &Game<'_>,
    seed: u64,
) {
    assert_eq!(log.told, game.told, "seed {seed}");
    for (component, it) in (0..).zip(log.system.components) {
        for at in 0..it.net.places.len() as u32 {
            let place = Of { component, id: PlaceId(at) };
            assert_eq!(player.tokens(place), game.place(place), "seed {seed}, {place:?}");
        }
    }
    for (event, waiting) in game.book.mailboxes.iter().zip(&game.state.mail) {
        assert_eq!(player.waiting(event) as usize, waiting.len(), "seed {seed}, {event:?}");
    }
    assert_eq!(player.now(), Millis(game.now), "seed {seed}");
    assert_eq!(player.round_is_due(), game.round_is_due(), "seed {seed}");
    assert_eq!(player.wake_at(), game.wake_at().map(Millis), "seed {seed}");
    for (at, line) in game.book.lines.iter().enumerate() {
        assert_eq!(player.enabled(line.id), game.can_fire(at), "seed {seed}, {:?}", line.id);
    }
    assert!(game.is_within_bounds(), "seed {seed}");
}

/// What is done from outside.
#[derive(Clone, Copy, Debug)]
enum Act {
    Offer(Of<EventId>, u16),
    Round,
    Pass,
}

impl Act {
    fn any(system: &System<'_>, draw: &mut Draw) -> Self {
        let round = if system.is_alone() { 40 } else { 4 };
        let component = draw.between(0, system.components.len() as u64 - 1) as u16;
        let events = system.components[usize::from(component)].net.events.len() as u64;
        if one_in(draw, round) {
            Self::Round
        } else if events == 0 || one_in(draw, 10) {
            Self::Pass
        } else {
            let id = EventId(draw.between(0, events - 1) as u32);
            Self::Offer(Of { component, id }, draw.between(1, 9_999) as u16)
        }
    }
}

/// The nets of these seeds, alone.
fn nets(seeds: std::ops::Range<u64>, time: Time) -> impl Iterator<Item = (u64, OwnedSystem, Draw)> {
    seeds.map(move |seed| {
        let mut draw = Draw::new(seed);
        let net = random_net(&mut draw, time);
        (seed, OwnedSystem::alone(net), draw)
    })
}

/// So many systems that fit together, from this seed on.
fn systems(first: u64, count: usize) -> impl Iterator<Item = (u64, OwnedSystem, Draw)> {
    let systems = (first..).map(|seed| {
        let mut draw = Draw::new(seed);
        let system = random_system(&mut draw);
        (seed, system, draw)
    });
    systems.filter(|it| it.1.with(|it| it.defect().is_none())).take(count)
}

/// Mostly soon, sometimes now, seldom much later.
fn delay(draw: &mut Draw) -> u64 {
    match draw.between(0, 15) {
        0..=2 => 0,
        3 => 100,
        _ => draw.between(1, 20),
    }
}

/// Plays 50 events, rounds or waits, and compares after each.
fn play_by_the_book<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    seed: u64,
    draw: &mut Draw,
    seen: &mut Seen,
) {
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let program = load(&packed, system, draw);
    let (mut log, mut now) = (Log::new(system), draw.between(0, 1_000));
    let mut player: Played<'_, W, C, S> = Player::start(program, Millis(now), &mut log);
    let mut game = Game::start(system, now);
    seen.words[W.min(4)] += 1;
    let code = Program::<W, C, S>::code(&program);
    seen.bounded += u32::from(code.bounded);
    seen.state_machines += u32::from(code.control != 0);
    for _ in 0..50 {
        if game.endless {
            seen.endless += 1;
            return;
        }
        assert_same(&player, &log, &game, seed);
        now += if clocks(system) > 0 { delay(draw) } else { draw.between(0, 1) };
        let told = if one_in(draw, 16) { now.saturating_sub(30) } else { now };
        let before = (game.told.len(), log.outside);
        let act = Act::any(system, draw);
        match act {
            Act::Pass => {
                let advanced = player.advance_with(Millis(told), &mut log);
                game.advance(told);
                if !game.endless {
                    assert!(!advanced.behind, "seed {seed}");
                    assert_eq!(advanced.fired, game.fired, "seed {seed}");
                    seen.by_itself += advanced.fired;
                    seen.blocked(&game);
                }
            }
            Act::Offer(event, carries) => {
                let outcome = player.offer_carrying(Millis(told), &event, carries, &mut log);
                let by_the_book = game.offer(told, event, carries);
                if !game.endless {
                    assert_eq!(outcome, by_the_book, "seed {seed}");
                    let fired = u32::from(outcome.fired());
                    assert_eq!(log.outside, before.1 + fired, "seed {seed}");
                    seen.outcome(&outcome);
                }
            }
            Act::Round => {
                let round = player.round_with(Millis(told), &mut log);
                let by_the_book = game.round(told);
                if !game.endless {
                    assert_eq!(round, by_the_book, "seed {seed}");
                    seen.round(round);
                }
            }
        }
        seen.told(act, &game.told[before.0..], system);
    }
    if !game.endless {
        assert_same(&player, &log, &game, seed);
    }
}

#[test]
fn events_are_answered_by_the_book() {
    let mut seen = Seen::default();
    for (seed, net, mut draw) in nets(0..20_000, Time::Without) {
        let (draw, seen) = (&mut draw, &mut seen);
        net.with(|it| with_size_of!(it, draw, play_by_the_book(it, seed, draw, seen)));
    }
    seen.assert_enough();
}

#[test]
fn time_passes_by_the_book() {
    let mut seen = Seen::default();
    for (seed, net, mut draw) in nets(100_000..120_000, Time::With) {
        let (draw, seen) = (&mut draw, &mut seen);
        net.with(|it| with_size_of!(it, draw, play_by_the_book(it, seed, draw, seen)));
    }
    seen.assert_enough();
    let timed = [seen.by_itself, seen.too_early, seen.too_late];
    assert!(timed.iter().all(|&it| it > 5_000), "{seen:?}");
}

/// What was seen of so many sound systems, and how many more were not sound.
fn together(count: u64) -> (Seen, u64) {
    let mut seen = Seen::default();
    let mut last = 0;
    for (seed, system, mut draw) in systems(700_000, count as usize) {
        let (draw, seen) = (&mut draw, &mut seen);
        system.with(|it| with_size_of!(it, draw, play_by_the_book(it, seed, draw, seen)));
        last = seed;
    }
    (seen, last - 700_000 + 1 - count)
}

#[test]
fn nets_work_together_by_the_book() {
    assert!(together(2_000).1 > 10);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn nets_of_20_000_systems_work_together_by_the_book() {
    let (seen, unsound) = together(20_000);
    assert!(unsound > 100, "{unsound}");
    seen.assert_enough_together();
}

/// Plays the same events and rounds three times: told the time only with them, at every instant,
/// and whenever the player wants to be told. What fires, and when, is the same.
fn polling_makes_no_difference<const W: usize, const C: usize, const S: usize>(
    system: &System<'_>,
    seed: u64,
    draw: &mut Draw,
    wakes: &mut u32,
) {
    let mut now = 0;
    let mut acts: Vec<(u64, Act)> = Vec::new();
    for _ in 0..30 {
        now += delay(draw);
        acts.push((now, Act::any(system, draw)));
    }
    let packed = Packed::<W, C, S>::of(system).unwrap();
    let program = load(&packed, system, draw);
    let mut game = Game::start(system, 0);
    for &(at, act) in &acts {
        match act {
            Act::Offer(event, carries) => _ = game.offer(at, event, carries),
            Act::Round => _ = game.round(at),
            Act::Pass => game.advance(at),
        }
        if game.endless {
            return;
        }
    }
    let play = |until: &mut dyn FnMut(&mut Played<'_, W, C, S>, u64, &mut Log<'_>)| {
        let mut log = Log::new(system);
        let mut player: Played<'_, W, C, S> = Player::start(program, Millis(0), &mut log);
        let (mut outcomes, mut rounds) = (Vec::new(), Vec::new());
        for &(at, act) in &acts {
            until(&mut player, at, &mut log);
            let at = Millis(at);
            match act {
                Act::Offer(event, carries) => {
                    outcomes.push(player.offer_carrying(at, &event, carries, &mut log));
                }
                Act::Round => rounds.push(player.round_with(at, &mut log)),
                Act::Pass => assert!(!player.advance_with(at, &mut log).behind),
            }
        }
        (outcomes, rounds, log.told, player.now(), player.snapshot())
    };
    let late = play(&mut |_, _, _| ());
    let always = play(&mut |player, at, log| {
        for now in player.now().0..at {
            assert!(!player.advance_with(Millis(now), log).behind);
        }
    });
    let when_due = play(&mut |player, at, log| {
        // Until its round comes, a player whose round is due always wants to be told.
        while let Some(due) = player.wake_at().filter(|it| it.0 < at && !player.round_is_due()) {
            if due > player.now() {
                let (mut early, before) = (*player, Millis(due.0 - 1));
                assert_eq!(early.advance(before).fired, 0, "seed {seed}: at {before}");
            }
            let fired = player.advance_with(due, log).fired;
            if fired == 0 && !system.is_alone() {
                return; // it mails more at once than a mailbox holds, so it never can
            }
            assert_ne!(fired, 0, "seed {seed}: at {due}");
            *wakes += 1;
        }
    });
    assert_eq!(late, always, "seed {seed}");
    assert_eq!(late, when_due, "seed {seed}");
    assert_eq!(late.2, game.told, "seed {seed}");
}

#[test]
fn a_player_that_is_told_the_time_late_catches_up() {
    let mut wakes = 0;
    for (seed, net, mut draw) in nets(300_000..305_000, Time::With) {
        let (draw, wakes) = (&mut draw, &mut wakes);
        net.with(|it| with_size_of!(it, draw, polling_makes_no_difference(it, seed, draw, wakes)));
    }
    assert!(wakes > 10_000, "{wakes}");
}

#[test]
fn nets_that_are_told_the_time_late_catch_up_together() {
    assert!(catch_up_together(2_000) > 1_000);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn nets_of_20_000_systems_that_are_told_the_time_late_catch_up_together() {
    assert!(catch_up_together(20_000) > 10_000);
}

/// How often players of so many systems want to be told the time.
fn catch_up_together(count: usize) -> u32 {
    let mut wakes = 0;
    for (seed, system, mut draw) in systems(800_000, count) {
        let (draw, wakes) = (&mut draw, &mut wakes);
        system.with(|it| {
            with_size_of!(it, draw, polling_makes_no_difference(it, seed, draw, wakes));
        });
    }
    wakes
}

//! A game of the player beside the textbook, compared after each move.
//!
//! What is drawn can be steered by bytes, so that a fuzz target plays it too.

mod seen;

use cotama_core::net::{EventId, OutputId, PlaceId, TransitionId};
use cotama_core::player::{
    Firing, Loaded, Names, Observer, Packed, Player, Program, clocks, words,
};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;
use cotama_tests::draw::Draw;
use cotama_tests::textbook::nets::{Time, WORDS, one_in, random_net};
use cotama_tests::textbook::systems::{OwnedSystem, random_system};
use cotama_tests::textbook::{Game, Told};
pub(crate) use seen::Seen;

/// The player: `W` words, up to `C` intervals, up to `S` in mailboxes, and numbers carried along.
pub(crate) type Played<'c, const W: usize, const C: usize, const S: usize> =
    Player<Loaded<'c, W, C, S>, W, C, S, u16>;

/// Calls a function of `W`, `C` and `S` for this system: as much as it needs, or more.
macro_rules! with_size_of {
    ($system:expr, $draw:expr, $story:ident($($argument:expr),*)) => {{
        use cotama_core::player::{clocks, slots, words};
        use cotama_tests::textbook::nets::one_in;
        use cotama_tests::textbook::systems::{CLOCKS, SLOTS};
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
pub(crate) use with_size_of;

/// The most words of a system that [`with_size_of`] takes, with one to spare.
const SYSTEM_WORDS: usize = 11;

/// The packed system; half of the nets whose bounds hold in every order of firing are played as
/// such.
pub(crate) fn load<'c, const W: usize, const C: usize, const S: usize>(
    packed: &'c Packed<W, C, S>,
    system: &System<'c>,
    draw: &mut Draw,
) -> Loaded<'c, W, C, S> {
    let loaded = packed.load(system);
    let is_bounded = one_in(draw, 2) && system.is_alone() && Game::is_bounded(system, 60);
    if is_bounded { loaded.bounded() } else { loaded }
}

/// An observer that writes down what it is told.
pub(crate) struct Log<'s> {
    system: &'s System<'s>,
    pub(crate) told: Vec<Told>,
    /// How many transitions fired on an event from outside.
    outside: u32,
}

impl<'s> Log<'s> {
    pub(crate) fn new(system: &'s System<'s>) -> Self {
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

/// An act from outside.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Act {
    Offer(Of<EventId>, u16),
    Round,
    Pass,
}

impl Act {
    pub(crate) fn any(system: &System<'_>, draw: &mut Draw) -> Self {
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

/// Mostly soon, sometimes now, seldom much later.
pub(crate) fn delay(draw: &mut Draw) -> u64 {
    match draw.between(0, 15) {
        0..=2 => 0,
        3 => 100,
        _ => draw.between(1, 20),
    }
}

/// Plays 50 events, rounds or waits, and compares after each.
pub(crate) fn play_by_the_book<const W: usize, const C: usize, const S: usize>(
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

/// Plays what bytes say: the first one whether a net without time or with it, or a system; the
/// others steer all that is drawn. Whether it was a system that can be played, came to an end after
/// all that was done, and something fired.
pub(crate) fn plays(bytes: &[u8]) -> bool {
    let Some((&kind, steering)) = bytes.split_first() else { return false };
    let mut draw = Draw::steered(steering);
    let system = match kind % 3 {
        0 => OwnedSystem::alone(random_net(&mut draw, Time::Without)),
        1 => OwnedSystem::alone(random_net(&mut draw, Time::With)),
        _ => random_system(&mut draw),
    };
    let (draw, mut seen) = (&mut draw, Seen::default());
    system.with(|it| {
        // Systems that nobody draws by chance: more words than the players here have.
        let most = if it.is_alone() { WORDS } else { SYSTEM_WORDS };
        let fits = it.defect().is_none() && words(it).is_some_and(|it| it <= most);
        if fits {
            with_size_of!(it, draw, play_by_the_book(it, 0, draw, &mut seen));
        }
        fits && seen.endless == 0 && seen.fired > 0
    })
}

//! A recorder writes what a player is told and what it does.

use super::observer::{Firing, Observer};
use super::outcome::{Advanced, Outcome, Round, Why};
use super::player::Player;
use super::program::{Kind, Program};
use crate::net::data::EventId;
use crate::system::data::{Of, System};
use core::fmt::Write;
use cotama_units::units::Millis;

/// Writes a run as it happens: the lines that `cotama conform` holds against the model
/// (`cotama-recording/1`: a header, then one JSON object a line).
///
/// Events, time and rounds go through the recorder to the player. The lines come in the order in
/// which things happened: what fired late stands before the event that made it known. Nothing is
/// allocated, and nothing waits: when the writer refuses a line, the recording ends there, the
/// player goes on, and [`is_cut`](Self::is_cut) says so.
///
/// ```
/// use cotama_core::player::Recorder;
/// use cotama_core::{net, units::Millis};
/// net! {
///     mod lamp {
///         places { Dark: 1, Lit }
///         events { press }
///         outputs { click }
///         transitions { on on press: Dark => Lit emit click; off: Lit => Dark after 5_000 ms; }
///     }
/// }
/// let mut recorder = Recorder::new(String::new());
/// let mut lamp: lamp::Player = recorder.start(lamp::Program, Millis(0));
/// assert!(recorder.offer(&mut lamp, Millis(70), &lamp::Event::press).fired());
/// assert!(recorder.offer(&mut lamp, Millis(9_000), &lamp::Event::press).fired());
/// recorder.finish(&mut lamp, Millis(9_100));
/// let log = recorder.into_inner();
/// assert_eq!(
///     log.lines().collect::<Vec<_>>(),
///     [
///         r#"{"schema":"cotama-recording/1","start_ms":0,"rounds":true}"#,
///         r#"{"t_ms":70,"event":"press","ignored":false}"#,
///         r#"{"t_ms":70,"fired":"on"}"#,
///         r#"{"t_ms":70,"output":"click"}"#,
///         r#"{"t_ms":5070,"fired":"off"}"#, // due then, known when it was pressed again
///         r#"{"t_ms":9000,"event":"press","ignored":false}"#,
///         r#"{"t_ms":9000,"fired":"on"}"#,
///         r#"{"t_ms":9000,"output":"click"}"#,
///         r#"{"t_ms":9100,"end":true}"#,
///     ]
/// );
/// ```
#[derive(Debug)]
pub struct Recorder<T> {
    to: T,
    cut: bool,
}

impl<T: Write> Recorder<T> {
    /// A recorder that has written nothing yet.
    pub const fn new(to: T) -> Self {
        Self { to, cut: false }
    }

    /// Whether the writer refused something: the recording ended there.
    pub const fn is_cut(&self) -> bool {
        self.cut
    }

    /// The writer.
    pub fn into_inner(self) -> T {
        self.to
    }

    /// The writer, for one who takes out what it has.
    pub const fn inner(&mut self) -> &mut T {
        &mut self.to
    }

    /// Writes the header, and starts a player at this time; see [`Player::start`].
    pub fn start<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        program: P,
        now: Millis,
    ) -> Player<P, W, C, S, M>
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        self.start_with(program, now, &mut ())
    }

    /// The same with an observer, who is told all that the recorder hears.
    pub fn start_with<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        program: P,
        now: Millis,
        observer: &mut impl Observer<P, M>,
    ) -> Player<P, W, C, S, M>
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        self.text("{\"schema\":\"cotama-recording/1\",\"start_ms\":");
        self.number(now.0);
        self.text(",\"rounds\":true}\n");
        Player::start(program, now, &mut self.hears(None, observer))
    }

    /// Offers an event; see [`Player::offer`].
    pub fn offer<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
        event: &P::Event,
    ) -> Outcome<P::Transition>
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        self.offer_with(player, now, event, &mut ())
    }

    /// Offers an event; see [`Player::offer_with`].
    pub fn offer_with<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
        event: &P::Event,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<P::Transition>
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        self.offer_carrying(player, now, event, M::default(), observer)
    }

    /// Offers an event; see [`Player::offer_carrying`]. One that the player did not look at, as it
    /// is behind or has no such event, is not recorded.
    pub fn offer_carrying<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
        event: &P::Event,
        carries: M,
        observer: &mut impl Observer<P, M>,
    ) -> Outcome<P::Transition>
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        if self.advance_with(player, now, observer).behind {
            return Outcome::Ignored { why: Why::Behind };
        }
        let told = Told { event: event.id(), at: player.now(), ignored: None };
        let mut hears = self.hears(Some(told), observer);
        let outcome = player.offer_carrying(now, event, carries, &mut hears);
        let looked_at =
            !matches!(outcome, Outcome::Ignored { why: Why::Behind | Why::NoSuchEvent });
        if let Some(told) = hears.told.take().filter(|_| looked_at) {
            self.told(&player.program().system(), &told);
        }
        outcome
    }

    /// Lets time pass; see [`Player::advance`].
    pub fn advance<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
    ) -> Advanced
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        self.advance_with(player, now, &mut ())
    }

    /// Lets time pass; see [`Player::advance_with`].
    pub fn advance_with<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
        observer: &mut impl Observer<P, M>,
    ) -> Advanced
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        player.advance_with(now, &mut self.hears(None, observer))
    }

    /// One round; see [`Player::round`].
    pub fn round<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
    ) -> Round
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        self.round_with(player, now, &mut ())
    }

    /// One round; see [`Player::round_with`]. One in which nothing waits is not recorded.
    pub fn round_with<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
        observer: &mut impl Observer<P, M>,
    ) -> Round
    where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        if self.advance_with(player, now, observer).behind {
            return Round { behind: true, ..Round::default() };
        }
        if player.round_is_due() {
            self.line(player.now(), "round", |it| it.text("true"));
        }
        player.round_with(now, &mut self.hears(None, observer))
    }

    /// Lets time pass, and writes that nothing else happened until then.
    pub fn finish<P, const W: usize, const C: usize, const S: usize, M>(
        &mut self,
        player: &mut Player<P, W, C, S, M>,
        now: Millis,
    ) where
        P: Program<W, C, S>,
        M: Copy + Default,
    {
        if !self.advance(player, now).behind {
            self.line(player.now(), "end", |it| it.text("true"));
        }
    }

    fn hears<'r, O, const W: usize, const C: usize, const S: usize>(
        &'r mut self,
        told: Option<Told>,
        observer: &'r mut O,
    ) -> Hears<'r, T, O, W, C, S> {
        Hears { recorder: self, told, observer }
    }

    fn told(&mut self, system: &System<'_>, told: &Told) {
        let event = system.components.get(usize::from(told.event.component));
        let event = event.and_then(|it| it.net.events.get(told.event.id.0 as usize));
        self.line(told.at, "event", |it| {
            it.name(system, told.event.component, event.map_or("?", |it| it.name));
            match told.ignored {
                Some(true) => it.text(",\"ignored\":true"),
                Some(false) => it.text(",\"ignored\":false"),
                None => {}
            }
        });
    }

    /// A line that says when, and one thing.
    fn line(&mut self, at: Millis, what: &str, value: impl FnOnce(&mut Self)) {
        self.text("{\"t_ms\":");
        self.number(at.0);
        self.text(",\"");
        self.text(what);
        self.text("\":");
        value(self);
        self.text("}\n");
    }

    /// A name of a net as JSON, behind that of the net where there are several.
    fn name(&mut self, system: &System<'_>, component: u16, name: &str) {
        self.text("\"");
        if !system.is_alone() {
            let net = system.components.get(usize::from(component));
            self.escaped(net.map_or("?", |it| it.name));
            self.text(".");
        }
        self.escaped(name);
        self.text("\"");
    }

    fn escaped(&mut self, name: &str) {
        for letter in name.chars() {
            if matches!(letter, '"' | '\\') {
                self.letter('\\');
                self.letter(letter);
            } else if letter < ' ' {
                let code = letter as u32;
                self.text(if code < 16 { "\\u000" } else { "\\u001" });
                self.letter(char::from_digit(code & 15, 16).unwrap_or('0'));
            } else {
                self.letter(letter);
            }
        }
    }

    fn text(&mut self, text: &str) {
        self.cut |= self.cut || self.to.write_str(text).is_err();
    }

    fn letter(&mut self, letter: char) {
        self.cut |= self.cut || self.to.write_char(letter).is_err();
    }

    fn number(&mut self, number: u64) {
        let mut unit = 1_u64;
        while number.checked_div(unit).is_some_and(|it| it >= 10) {
            unit = unit.saturating_mul(10);
        }
        while let Some(digits) = number.checked_div(unit) {
            self.letter(char::from_digit((digits % 10) as u32, 10).unwrap_or('0'));
            unit /= 10;
        }
    }
}

/// An event that is offered and not written yet.
struct Told {
    event: Of<EventId>,
    at: Millis,
    ignored: Option<bool>,
}

/// Hears for a recorder while a player plays, and hands on.
struct Hears<'r, T, O, const W: usize, const C: usize, const S: usize> {
    recorder: &'r mut Recorder<T>,
    told: Option<Told>,
    observer: &'r mut O,
}

impl<T, O, P, M, const W: usize, const C: usize, const S: usize> Observer<P, M>
    for Hears<'_, T, O, W, C, S>
where
    T: Write,
    O: Observer<P, M>,
    P: Program<W, C, S>,
{
    fn on_fire(&mut self, firing: &Firing<'_, P, M>) {
        let system = firing.program.system();
        if let Some(told) = self.told.take() {
            let ignored = told.ignored.or_else(|| firing.event.map(|_| false));
            self.recorder.told(&system, &Told { ignored, ..told });
        }
        let component = firing.id.component;
        let net = system.components.get(usize::from(component)).map(|it| it.net);
        let transition = net.and_then(|it| it.transitions.get(firing.id.id.0 as usize));
        self.recorder.line(firing.at, "fired", |it| {
            it.name(&system, component, transition.map_or("?", |it| it.name));
        });
        for output in transition.map_or(&[][..], |it| it.emits) {
            let said = net.and_then(|it| it.outputs.get(output.0 as usize));
            self.recorder.line(firing.at, "output", |it| {
                it.name(&system, component, said.map_or("?", |it| it.name));
            });
        }
        self.observer.on_fire(firing);
    }

    fn on_ignore(&mut self, event: Of<EventId>, carries: M) {
        if let Some(told) = self.told.as_mut().filter(|it| it.event == event) {
            told.ignored = Some(true);
        }
        self.observer.on_ignore(event, carries);
    }

    fn on_mail(&mut self, to: Of<EventId>, carries: M) {
        self.observer.on_mail(to, carries);
    }

    fn on_clear(&mut self, mailbox: Of<EventId>, carries: M) {
        self.observer.on_clear(mailbox, carries);
    }
}

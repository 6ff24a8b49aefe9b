//! Behaviour selection of the robot ACE (Rohrmueller 2011, appendix B): subsystems trigger at
//! random, and the behaviour that was accepted runs.

use crate::dice::Dice;
use crate::trace::{Sink, Trace};
use cotama_core::units::Millis;
use cotama_models::nets::ace::{behaviour, selection};

/// So many triggers.
const TRIGGERS: u64 = 5_000;

pub(super) fn play(trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    use behaviour::Event as Behaviour;
    use selection::{Event, Output};
    const EVENTS: [Event; 7] = [
        Event::NavigationTriggers,
        Event::VisionTriggers,
        Event::InteractionTriggers,
        Event::TraversabilityTriggers,
        Event::EmergencyTriggers,
        Event::Completed,
        Event::Failed,
    ];
    const BEHAVIOURS: [Behaviour; 4] = [
        Behaviour::Explore,
        Behaviour::FollowPerson,
        Behaviour::GoInDirection,
        Behaviour::ReachGoal,
    ];
    let mut dice = Dice::new(2008);
    let (mut selection, mut behaviour) = (selection::Player::new(), behaviour::Player::new());
    let (mut triggers, mut accepted) = (0, 0);
    for now in (0..TRIGGERS).map(|it| Millis(it * 500)) {
        let event = EVENTS[dice.roll(EVENTS.len() as u32) as usize];
        let wanted = BEHAVIOURS[dice.roll(BEHAVIOURS.len() as u32) as usize];
        let mut follows = None;
        let outcome = selection.offer_with(now, &event, &mut |it: &selection::Firing<'_>| {
            for output in it.outputs() {
                follows = match output {
                    Output::Released => Some(Behaviour::Released),
                    Output::EmergencyAccepted => Some(Behaviour::Idle),
                    Output::NavigationAccepted
                    | Output::VisionAccepted
                    | Output::InteractionAccepted
                    | Output::TraversabilityAccepted => Some(wanted),
                    _ => continue,
                };
                accepted += 1;
            }
        });
        triggers += 1;
        trace.outcome(
            0,
            u8::from(outcome.fired()),
            selection.tokens(selection::Place::Active) as u8,
        );
        if let Some(event) = follows {
            let outcome = behaviour.offer(now, &event);
            trace.outcome(1, u8::from(outcome.fired()), behaviour.state() as u8);
        }
    }
    [triggers, accepted]
}

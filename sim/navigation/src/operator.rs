//! A person who drives a robot by its camera.

use crate::braking::Limits;
use crate::local_map::LocalMap;
use crate::work::Work;
use cotama_floor::Point;
use cotama_plane::Command;
use cotama_streams::{Stream, Streams};
use std::collections::VecDeque;

/// The longest delay, in periods.
pub const MAX_DELAY: usize = 256;

/// An image from the camera, reduced to what an operator takes from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// The angle to a point of the way, in radians to the left: the operator knows the way.
    pub way: f64,
    /// The distance to that point, in metres.
    pub left_m: f64,
    /// Room ahead within the view, in metres.
    pub room_m: f64,
}

impl Image {
    /// Returns the image of a local map: a point counts if it is in the field of view, in the
    /// robot's lane of a width in metres, and within a range in metres.
    pub fn of(map: &LocalMap, view_rad: f64, lane_m: f64, range_m: f64, way: Point) -> Self {
        let is_seen = |it: &Point| {
            it.x > 0.0
                && it.y.abs() <= lane_m / 2.0
                && libm::atan2(it.y, it.x).abs() <= view_rad / 2.0
        };
        let points = map.points().map(|it| it.at).filter(is_seen);
        let room_m = points.map(|it| it.x).fold(range_m, f64::min);
        Self { way: libm::atan2(way.y, way.x), left_m: way.coords.norm(), room_m }
    }
}

/// Properties of an operator and of the link to the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habits {
    /// The field of view of the camera, in radians.
    pub view_rad: f64,
    /// Periods from an image to the eye, at most [`MAX_DELAY`].
    pub sees_after: usize,
    /// Periods from the hand to the wheels, at most [`MAX_DELAY`].
    pub acts_after: usize,
    /// Periods without an image after which the operator stops the robot.
    pub blind_after: usize,
    /// Time of a period in seconds.
    pub period_s: f64,
    /// The speed that the operator likes, in m/s.
    pub speed: f64,
    /// Room that the operator keeps ahead of the robot's origin, in metres, beyond what delays and
    /// braking need.
    pub room_m: f64,
    /// Deviation of the hand, as a part of the turn.
    pub hand: f64,
}

/// An operator who steers along a known way by what the camera showed a while ago.
///
/// A model of ours: pursuit of a point of the way; on the spot while it is out of view, slower as
/// room ahead gets short, and standing without images. What is aside of the view is not seen, so
/// this avoids nothing there: in COTAMA the robot's own avoidance may run beneath.
#[derive(Clone, Debug)]
pub struct Operator {
    habits: Habits,
    limits: Limits,
    images: VecDeque<Option<Image>>,
    commands: VecDeque<Command>,
    /// The newest image that was seen, and how many periods ago.
    seen: Option<(Image, usize)>,
    hand: Stream,
    work: Work,
}

impl Operator {
    /// An operator of a robot; the hand trembles by the stream `operator`.
    pub fn new(habits: Habits, limits: Limits, streams: &Streams) -> Self {
        let Habits { sees_after, acts_after, .. } = habits;
        let (sees, acts) = (sees_after.min(MAX_DELAY), acts_after.min(MAX_DELAY));
        let mut images = VecDeque::with_capacity(sees + 1);
        images.resize(sees, None);
        let mut commands = VecDeque::with_capacity(acts + 1);
        commands.resize(acts, Command::default());
        let hand = streams.stream("operator");
        Self { habits, limits, images, commands, seen: None, hand, work: Work::default() }
    }

    /// Sends an image, or none if the camera or the link is lost, and returns the command that
    /// arrives at the robot in this period.
    pub fn command(&mut self, image: Option<Image>) -> Command {
        self.images.push_back(image);
        self.seen = match self.images.pop_front().flatten() {
            Some(image) => Some((image, 0)),
            None => self.seen.map(|(image, ago)| (image, ago + 1)),
        };
        let told = self.decide();
        self.commands.push_back(told);
        self.work.operations += 1;
        self.commands.pop_front().unwrap_or_default()
    }

    fn decide(&mut self) -> Command {
        let tremble = 1.0 + self.habits.hand * self.hand.error();
        let Habits { view_rad, sees_after, acts_after, blind_after, period_s, .. } = self.habits;
        let Some((image, _)) = self.seen.filter(|it| it.1 < blind_after) else {
            return Command::default();
        };
        let Limits { speed, acceleration, turn, .. } = self.limits;
        // The robot turns on while the image is on its way: a turn is that slow that it does not
        // leave the view meanwhile.
        let delay = (sees_after + acts_after + 1) as f64 * period_s;
        let slow = turn.min(view_rad / 4.0 / delay.max(1e-3));
        let gain = 0.5 / delay.max(0.5);
        let aside = (gain * image.way * tremble).clamp(-slow, slow);
        if image.way.abs() > view_rad / 2.0 {
            return Command { speed: 0.0, turn: slow.copysign(image.way) };
        }
        // From v d + v² / 2a = room: d the delay, and v what it was all the while at most.
        let room = (image.room_m - self.habits.room_m).min(image.left_m).max(0.0);
        let lost = acceleration * delay;
        let most = (lost * lost + 2.0 * acceleration * room).sqrt() - lost;
        let ahead = self.habits.speed.min(speed).min(most) * libm::cos(image.way).max(0.0);
        Command { speed: ahead, turn: aside }
    }

    /// Returns the work that was done since it was made.
    pub const fn work(&self) -> Work {
        self.work
    }
}

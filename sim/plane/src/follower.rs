//! Following a path with a pose that is known.

use crate::drivetrain::Drivetrain;
use crate::track::{Near, Track};
use crate::vehicle::Command;
use cotama_floor::{Point, Pose};

/// A follower of a path: pure pursuit, slower where the path bends and before it ends (S. Macenski,
/// S. Singh, F. Martín, J. Ginés, "Regulated pure pursuit for robot path tracking", Autonomous
/// Robots 47, 2023); at a sharp corner it turns on the spot.
#[derive(Clone, Debug, PartialEq)]
pub struct Follower {
    near: Near,
    /// Whether it turns on the spot.
    turns: bool,
}

/// Times and lengths of the point that is pursued: as far ahead as 0.8 s of way, within these
/// bounds in metres.
const AHEAD_S: f64 = 0.8;
const AHEAD: [f64; 2] = [0.25, 0.6];
/// The angle up to which it turns on the spot, in radians; it begins to at an eighth of a circle.
const TURNS: f64 = 0.03;
/// The bend up to which it goes straight on, in 1/m: at most 36 µm aside where it pursues.
const STRAIGHT: f64 = 2e-4;
/// The angle to its path up to which it does, in radians.
const ALONG: f64 = 1e-4;
/// The speed at which it comes to a place, in m/s, and how near it comes, in metres.
const CREEP: f64 = 0.02;
const NEAR: f64 = 0.001;
/// The time from one command to the next, in seconds.
pub(crate) const STEP: f64 = 0.01;

impl Follower {
    /// A robot at a place of its path.
    pub const fn new(near: Near) -> Self {
        Self { near, turns: false }
    }

    /// Returns the place on the path.
    pub(crate) const fn near(&self) -> Near {
        self.near
    }

    /// Returns the length along the path.
    pub const fn along(&self) -> f64 {
        self.near.along
    }

    /// Looks where the robot is on its path.
    pub fn see(&mut self, track: &Track, pose: &Pose) {
        let at = pose.translation.vector.into();
        self.near = track.project(self.near.piece, at);
        loop {
            let (end, is_sharp) = track.end(self.near.piece);
            let is_last = self.near.piece + 2 >= track.corners().len();
            let close = if is_sharp { NEAR } else { 0.0 };
            if is_last || self.near.along < end - close {
                return;
            }
            self.turns |= is_sharp;
            self.near = track.project(self.near.piece + 1, at);
        }
    }

    /// Returns the speeds to go on with, towards a speed in m/s and no further than a length along
    /// the path, and how far they stay the same once they are reached.
    pub fn command(
        &mut self,
        track: &Track,
        pose: &Pose,
        now: Command,
        drivetrain: &Drivetrain,
        speed: f64,
        goal: f64,
    ) -> (Command, f64) {
        let Near { piece, along } = self.near;
        let stop = track.stop(piece).min(goal);
        let ahead = (now.speed * AHEAD_S).clamp(AHEAD[0], AHEAD[1]);
        let reach = (along + ahead).min(stop.max(along));
        // Beyond the stop it pursues a point straight on, so that it comes there straight.
        let there = track.pose(piece, reach);
        let target = there * Point::new(along + ahead - reach, 0.0);
        let local = pose.inverse_transform_point(&target);
        if self.turns || local.x < local.y.abs() {
            let off = libm::atan2(local.y, local.x);
            self.turns = off.abs() > TURNS;
            if self.turns {
                let most = (2.0 * drivetrain.turn_acceleration * off.abs()).sqrt();
                let turn = most.min(drivetrain.turn) * off.signum();
                return (Command { speed: 0.0, turn: if speed > 0.0 { turn } else { 0.0 } }, 0.0);
            }
        }
        let bend = 2.0 * local.y / local.coords.norm_squared();
        let left = (stop - along).max(0.0);
        let brakes = (2.0 * drivetrain.acceleration * left).sqrt();
        let brakes = brakes.min(track.speed(self.near, drivetrain));
        let bends = drivetrain.turn / bend.abs().max(1e-9);
        let mut to = speed.min(brakes).min(bends);
        if speed > 0.0 && left > NEAR {
            to = to.max(CREEP.min(speed));
        }
        if bend.abs() < STRAIGHT && pose.rotation.rotation_to(&there.rotation).im.abs() < ALONG {
            let braking = to * to / (2.0 * drivetrain.acceleration);
            let same = (left - braking).min(track.end(piece).0 - along - ahead - braking);
            return (Command { speed: to, turn: 0.0 }, same);
        }
        let change = drivetrain.acceleration * STEP;
        let next = now.speed + (to - now.speed).clamp(-change, change);
        (Command { speed: to, turn: next * bend }, 0.0)
    }
}

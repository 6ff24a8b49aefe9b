//! Threads that stay from one level to the next.

use std::hint::spin_loop;
use std::sync::mpsc::{Receiver, RecvError, SyncSender, TryRecvError, sync_channel};
use std::thread::{Builder, Scope};

/// How often a thread looks for something new before it sleeps. Chosen, not tuned.
const LOOKS: usize = 2_000;

/// A thread to which work is sent, and which sends it back when it is done.
pub(super) struct Mate<W> {
    work: SyncSender<W>,
    done: Receiver<W>,
}

impl<W: Send> Mate<W> {
    /// Starts a thread, if the system has one; it ends with this value, or with the scope.
    pub(super) fn start<'scope>(
        scope: &'scope Scope<'scope, '_>,
        act: impl Fn(W) -> W + Send + 'scope,
    ) -> Option<Self>
    where
        W: 'scope,
    {
        let ((work, orders), (results, done)) = (sync_channel(1), sync_channel(1));
        let life = move || {
            while let Ok(work) = next(&orders) {
                if results.send(act(work)).is_err() {
                    break;
                }
            }
        };
        Builder::new().spawn_scoped(scope, life).ok()?;
        Some(Self { work, done })
    }

    /// Sends work to the thread.
    pub(super) fn send(&self, work: W) {
        // A thread that panicked takes no more, and the scope panics when it ends.
        let _ = self.work.send(work);
    }

    /// Waits for the work that was sent; `None` when the thread has ended without it.
    pub(super) fn wait(&self) -> Option<W> {
        next(&self.done).ok()
    }
}

/// Waits for the next value, awake for a while.
fn next<T>(from: &Receiver<T>) -> Result<T, RecvError> {
    for _ in 0..LOOKS {
        match from.try_recv() {
            Err(TryRecvError::Empty) => spin_loop(),
            Err(TryRecvError::Disconnected) => return Err(RecvError),
            Ok(value) => return Ok(value),
        }
    }
    from.recv()
}

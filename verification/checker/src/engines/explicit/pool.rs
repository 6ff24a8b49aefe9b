//! A pool of worker threads that stay from one level to the next.

use std::any::Any;
use std::hint::spin_loop;
use std::marker::PhantomData;
use std::sync::mpsc::{Receiver, RecvError, Sender, TryRecvError, channel};
use std::thread::{Builder, Scope};

/// How often a thread looks for something new before it sleeps. Chosen, not tuned.
const LOOKS: usize = 2_000;

/// The work sent to a thread, or its result. Channels are compiled for each type that they carry,
/// which took a tenth of the compiling of this crate when it was one for each width of a marking.
type Parcel = Box<dyn Any + Send>;
type Act<'s> = Box<dyn FnMut(Parcel) -> Option<Parcel> + Send + 's>;

/// A thread of the pool, to which work is sent, and which sends results back in the order of the
/// work.
#[derive(Debug)]
pub(super) struct PoolThread<W, R> {
    work: Sender<Parcel>,
    done: Receiver<Parcel>,
    act: PhantomData<fn(W) -> R>,
}

impl<W: Send + 'static, R: Send + 'static> PoolThread<W, R> {
    /// Starts a thread, if the system has one; it ends with this value, or with the scope.
    pub(super) fn start<'s>(
        scope: &'s Scope<'s, '_>,
        mut act: impl FnMut(W) -> R + Send + 's,
    ) -> Option<Self> {
        let (work, done) =
            start(scope, Box::new(move |work| Some(Box::new(act(*work.downcast().ok()?)))))?;
        Some(Self { work, done, act: PhantomData })
    }

    /// Sends work to the thread.
    pub(super) fn send(&self, work: W) {
        // A thread that panicked takes no more, and the scope panics when it ends.
        let _ = self.work.send(Box::new(work));
    }

    /// Waits for the result of the work that was sent first; `None` when the thread has ended
    /// without it.
    pub(super) fn wait(&self) -> Option<R> {
        Some(*next(&self.done).ok()?.downcast().ok()?)
    }
}

fn start<'s>(
    scope: &'s Scope<'s, '_>,
    mut act: Act<'s>,
) -> Option<(Sender<Parcel>, Receiver<Parcel>)> {
    let ((work, orders), (results, done)) = (channel(), channel());
    let life = move || {
        while let Some(result) = next(&orders).ok().and_then(&mut act)
            && results.send(result).is_ok()
        {}
    };
    Builder::new().spawn_scoped(scope, life).ok()?;
    Some((work, done))
}

/// Waits for the next value, awake for a while.
fn next(from: &Receiver<Parcel>) -> Result<Parcel, RecvError> {
    for _ in 0..LOOKS {
        match from.try_recv() {
            Err(TryRecvError::Empty) => spin_loop(),
            Err(TryRecvError::Disconnected) => return Err(RecvError),
            Ok(value) => return Ok(value),
        }
    }
    from.recv()
}

//! Results in JSON that are printed even when the command is interrupted.
//!
//! An object is whole or none at all, so a command cannot print it bit by bit as it prints lines.
//! Keeps the answer where a thread that waits for the signals of an interruption finds it.

use crate::answers::check::{CheckAnswer, ResultRow};
use std::sync::{Arc, Mutex, MutexGuard, Once, PoisonError};

/// The answer of a check that is under way.
#[derive(Clone, Debug, Default)]
pub(crate) struct LastWord {
    answer: Arc<Mutex<Option<CheckAnswer>>>,
    /// Starts the thread, once; `None` where nothing is printed but whole.
    start: Option<Arc<Once>>,
}

impl LastWord {
    /// An answer that is printed when the command is interrupted, in JSON, if it has results by
    /// then.
    pub(crate) fn new(is_json: bool) -> Self {
        Self { answer: Arc::default(), start: is_json.then(|| Arc::new(Once::new())) }
    }

    /// Keeps an answer that has no results yet.
    pub(crate) fn begin(&self, answer: CheckAnswer) {
        *self.lock() = Some(answer);
    }

    /// Keeps a result. Before the first of several there is nothing to wait with: the thread would
    /// only take 64 MiB of addresses.
    pub(crate) fn add(&self, result: ResultRow, others_follow: bool) {
        if let Some(answer) = &mut *self.lock() {
            answer.results.push(result);
        }
        #[cfg(unix)]
        if let Some(start) = self.start.as_ref().filter(|_| others_follow) {
            start.call_once(|| signals::print_then_end(self.clone()));
        }
    }

    /// Drops the answer of a check that failed.
    pub(crate) fn forget(&self) {
        self.lock().take();
    }

    /// Returns the answer, which an interruption does not print from now on. If one came before,
    /// the program ends meanwhile.
    pub(crate) fn take_or_end(&self) -> CheckAnswer {
        loop {
            if let Some(answer) = self.lock().take() {
                return answer;
            }
            std::thread::park();
        }
    }

    fn lock(&self) -> MutexGuard<'_, Option<CheckAnswer>> {
        self.answer.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(unix)]
mod signals {
    use super::LastWord;
    use crate::output::Screen;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;
    use std::ffi::c_int;
    use std::thread;

    /// Waits in a thread. The command ends by the signal, so a shell ends its loop as well.
    pub(super) fn print_then_end(word: LastWord) {
        let heard = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|it| !is_ignored(*it));
        let Ok(mut signals) = Signals::new(heard) else { return };
        thread::spawn(move || {
            for signal in signals.forever() {
                // A reader who has gone away gets nothing.
                let _ = word
                    .lock()
                    .take()
                    .filter(|it| !it.results.is_empty())
                    .map(|answer| Screen::json(&answer));
                let _ = emulate_default_handler(signal);
            }
        });
    }

    /// Returns whether whoever started the program wants it to go on, as `nohup` does.
    fn is_ignored(signal: c_int) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|it| it.strip_prefix("SigIgn:"));
        let ignored = ignored.and_then(|it| u64::from_str_radix(it.trim(), 16).ok());
        ignored.is_some_and(|it| (it >> (signal - 1)) & 1 == 1)
    }
}

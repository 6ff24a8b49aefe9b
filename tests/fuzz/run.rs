//! Mutants for a reader, one after the other.

use crate::mutant::mutant;
use crate::random::Random;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use std::{env, fs, process, thread};

/// A reader that takes longer than that for one input hangs.
const HANGS: Duration = Duration::from_secs(20);
/// The most memory of the whole process while a million inputs are read, where the system says it.
const MAX_MEMORY_KIB: u64 = 1 << 20;

/// A reader, with the condition that its answers must meet.
#[derive(Clone, Copy, Debug)]
pub struct Reader {
    /// The folder of its texts below `tests/corpora`.
    pub name: &'static str,
    /// Words of its format, which a blind mutation finds too seldom.
    pub words: &'static [&'static str],
    /// Reads a text: whether it was accepted. It panics when what must hold does not: a refusal
    /// without a place, or what was read is not what is written again.
    pub read: fn(&[u8]) -> bool,
}

/// The figures of the inputs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// How many inputs were read.
    pub inputs: u64,
    /// How many of them were accepted.
    pub accepted: u64,
    /// All of the time.
    pub time: Duration,
    /// The longest time of one input, and its number.
    pub slowest: (Duration, u64),
}

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { inputs, accepted, time, slowest } = self;
        let seconds = time.as_secs_f64();
        let each_second = u128::from(*inputs) * 1_000 / time.as_millis().max(1);
        write!(f, "{inputs} inputs, {accepted} accepted, {seconds:.1} s, {each_second} a second")?;
        let milliseconds = slowest.0.as_secs_f64() * 1e3;
        write!(f, ", the slowest took {milliseconds:.1} ms (number {})", slowest.1)
    }
}

impl Reader {
    /// Reads so many mutants, or the one whose number `COTAMA_MUTANT` says.
    ///
    /// # Panics
    /// When a text of the corpus is refused, when what must hold of the reader does not, and when
    /// no mutant or every mutant was accepted: then one side of the border is not tried. It ends
    /// the process when a mutant takes more than twenty seconds.
    pub fn run(&self, mutants: u64) -> Figures {
        let texts = corpus(self.name);
        for (file, text) in &texts {
            assert!((self.read)(text), "{}: {file} is refused", self.name);
        }
        let texts: Vec<_> = texts.into_iter().map(|it| it.1).collect();
        if let Some(number) = env::var("COTAMA_MUTANT").ok().and_then(|it| it.parse().ok()) {
            let text = self.mutant(number, &texts);
            eprintln!("{}, mutant {number}:\n{}", self.name, String::from_utf8_lossy(&text));
            let accepted = u64::from((self.read)(&text));
            return Figures { inputs: 1, accepted, ..Figures::default() };
        }
        let at = AtomicU64::new(0);
        let figures = thread::scope(|scope| {
            let (alive, ended) = channel::<()>();
            let watched = (&at, self.name);
            scope.spawn(move || watch(watched.0, watched.1, &ended));
            let figures = self.read_all(mutants, &texts, &at);
            drop(alive);
            figures
        });
        let Figures { accepted, .. } = figures;
        assert!(accepted > 0 && accepted < mutants, "{}: {accepted} accepted", self.name);
        figures
    }

    /// Reads a million mutants, and says on stderr how that went.
    ///
    /// # Panics
    /// As [`Reader::run`], and when the process took a GiB of memory.
    pub fn run_a_million(&self) {
        let figures = self.run(1_000_000);
        let memory = peak_memory_kib();
        let said = memory.map_or("unknown".into(), |it| format!("{} MiB at most", it >> 10));
        eprintln!("{}: {figures}; memory: {said}", self.name);
        assert!(memory.is_none_or(|it| it < MAX_MEMORY_KIB), "{}: {said}", self.name);
    }

    /// Checks that a file of the corpus is as the program writes it: one of bytes, which nobody
    /// types. With `UPDATE_GOLDEN` set it is written first.
    ///
    /// # Panics
    /// When it is not, or cannot be written or read.
    pub fn keeps(&self, file: &str, written: &[u8]) {
        let path = folder(self.name).join(file);
        if env::var_os("UPDATE_GOLDEN").is_some() {
            let made =
                fs::create_dir_all(folder(self.name)).and_then(|()| fs::write(&path, written));
            made.unwrap_or_else(|it| panic!("{}: {it}", path.display()));
        }
        let kept = fs::read(&path).unwrap_or_else(|it| panic!("{}: {it}", path.display()));
        let name = self.name;
        assert!(kept == written, "{name}: {file} is another; UPDATE_GOLDEN=1 writes it anew");
    }

    fn mutant(&self, number: u64, texts: &[Vec<u8>]) -> Vec<u8> {
        // The numbers of two readers are other mutants.
        let seed = self.name.bytes().fold(number, |sum, it| sum.wrapping_mul(31) + u64::from(it));
        mutant(&mut Random(seed), texts, self.words)
    }

    fn read_all(&self, mutants: u64, texts: &[Vec<u8>], at: &AtomicU64) -> Figures {
        let begin = Instant::now();
        let mut figures = Figures { inputs: mutants, ..Figures::default() };
        for number in 0..mutants {
            at.store(number, Relaxed);
            let text = self.mutant(number, texts);
            let before = Instant::now();
            match catch_unwind(AssertUnwindSafe(|| (self.read)(&text))) {
                Ok(accepted) => figures.accepted += u64::from(accepted),
                Err(panic) => {
                    let name = self.name;
                    eprintln!("{name}: mutant {number}; COTAMA_MUTANT={number} reads it again");
                    eprintln!("{}", text.escape_ascii());
                    resume_unwind(panic);
                }
            }
            figures.slowest = figures.slowest.max((before.elapsed(), number));
        }
        figures.time = begin.elapsed();
        figures
    }
}

/// Ends the process when the number stays the same for too long.
fn watch(at: &AtomicU64, name: &str, ended: &std::sync::mpsc::Receiver<()>) {
    let mut seen = u64::MAX;
    while ended.recv_timeout(HANGS) == Err(RecvTimeoutError::Timeout) {
        let now = at.load(Relaxed);
        if now == seen {
            eprintln!("{name}: mutant {now} takes more than {} s", HANGS.as_secs());
            process::abort();
        }
        seen = now;
    }
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpora").join(name)
}

/// The texts of a reader, by the names of their files.
fn corpus(name: &str) -> Vec<(String, Vec<u8>)> {
    let folder = folder(name);
    let files = fs::read_dir(&folder).unwrap_or_else(|it| panic!("{}: {it}", folder.display()));
    let mut files: Vec<_> = files.map(|it| it.expect("an entry of the folder").path()).collect();
    files.sort();
    let name = |it: &Path| it.file_name().unwrap_or_default().to_string_lossy().into_owned();
    files.iter().map(|it| (name(it), fs::read(it).expect("a file of the corpus"))).collect()
}

/// The most memory that this process held, as Linux says.
fn peak_memory_kib() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|it| it.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

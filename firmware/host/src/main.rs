//! Does on this machine what the images do on a chip.
//!
//! `host scenes TRACE` writes the trace of all scenes to a file, and a line for each to standard
//! output. `host session SENT ANSWERED [exact]` holds a conversation with the robot behind its
//! UART: a delivery over a noisy line with a hang of the control loop in the middle, and plans; it
//! writes what it sent, for the chip, and what was answered, to compare.

use cotama_core::units::Millis;
use robot::link::Sender;
use robot::robots::delivery::{STORED_BYTES, TABLES};
use robot::scenes::{Channel, Memory, play_all};
use robot::server::{Asked, PERIOD, PLAN, Served, Server};
use robot::surroundings::{SEVEN_POINTS, Surroundings};
use robot::trace::Sink;
use std::fs::{self, File};
use std::io::{BufWriter, Error, Result, Write};

/// As in the image.
const END: u8 = 0xFE;
const HANG: u8 = 0xFD;

struct Bytes<W>(W, Result<()>);

impl<W: Write> Sink for Bytes<W> {
    fn put(&mut self, bytes: &[u8]) {
        if self.1.is_ok() {
            self.1 = self.0.write_all(bytes);
        }
    }
}

fn main() -> Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match args.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["scenes", trace] => scenes(trace),
        ["session", sent, answered] => session(sent, answered, false),
        ["session", sent, answered, "exact"] => session(sent, answered, true),
        _ => Err(Error::other("usage: host scenes TRACE | host session SENT ANSWERED [exact]")),
    }
}

fn scenes(path: &str) -> Result<()> {
    let mut sink = Bytes(BufWriter::new(File::create(path)?), Ok(()));
    let mut memory = Box::new(Memory::EMPTY);
    let (digest, bytes) = play_all(&mut memory, &mut || (), &mut sink, |scene, numbers, of| {
        let [first, second] = scene.says();
        let ([a, b], (digest, bytes)) = (numbers, of);
        let name = scene.name();
        println!("{name}: {first} {a}, {second} {b}; {bytes} bytes, {digest:016x}");
    });
    sink.1?;
    sink.0.flush()?;
    println!("all: {bytes} bytes, {digest:016x}");
    Ok(())
}

/// The robot as the host plays it, and what went to and fro.
struct Talk {
    server: Server,
    sender: Sender,
    /// Contents of the flash.
    stored: Option<Vec<u8>>,
    memory: Box<Memory>,
    exact: bool,
    sent: Vec<u8>,
    answered: Vec<u8>,
}

impl Talk {
    /// Sends a frame; the line is noisy for some.
    fn say(&mut self, content: &[u8], line: Option<&mut Channel>) {
        let mut bytes = Vec::new();
        self.sender.send(content, |byte| bytes.push(byte));
        if let Some(line) = line {
            bytes = bytes.into_iter().flat_map(|byte| line.carry(byte)).flatten().collect();
        }
        self.sent.extend(&bytes);
        let mut served = None;
        for byte in bytes {
            let Memory { tables, workspace } = &mut *self.memory;
            let exact = self.exact.then_some(workspace);
            let answered = &mut self.answered;
            served = served.or(self.server.take(byte, tables, exact, |it| answered.push(it)));
        }
        match served {
            Some(Served::Period) => {
                let mut bytes = [0; STORED_BYTES];
                self.stored = self.server.control.store(&mut bytes).map(<[u8]>::to_vec);
            }
            Some(Served::Other(HANG)) => {
                // The hardware watchdog resets the board.
                self.server = Server::default();
                if let Some(stored) = &self.stored {
                    assert!(self.server.control.restore(stored, Millis(0)));
                }
            }
            _ => {}
        }
    }
}

fn session(sent: &str, answered: &str, exact: bool) -> Result<()> {
    let mut talk = Talk {
        server: Server::default(),
        sender: Sender::default(),
        stored: None,
        memory: Box::new(Memory::EMPTY),
        exact,
        sent: Vec::new(),
        answered: Vec::new(),
    };
    let mut world = Surroundings::new(&SEVEN_POINTS);
    let mut line = Channel::new(42);
    for period in 0..4_500_u64 {
        let given = world.before(Millis(period * 100), &talk.server.control);
        let mut content = vec![PERIOD];
        content.extend(given.to_bytes());
        // One period in ten goes over the noisy line.
        talk.say(&content, (period % 10 == 3).then_some(&mut line));
        world.after(&talk.server.control.decider().requests(Millis(period * 100)), TABLES);
        if period % 500 == 0 {
            let asked = Asked {
                first: (period / 500) as u8,
                rest: 2_000,
                hardware: 0x1121,
                used: [(period * 50) as u32, (period * 900) as u32],
            };
            talk.say(&[&[PLAN][..], &asked.to_bytes()].concat(), None);
        }
        if period == 2_000 {
            talk.say(&[HANG], None);
            // Bytes that come while the board hangs and resets are lost: nothing but ends of
            // frames.
            talk.sent.extend([robot::link::END; 600]);
        }
    }
    talk.say(&[END], None);
    println!("sent {} bytes, answered {}", talk.sent.len(), talk.answered.len());
    fs::write(sent, talk.sent)?;
    fs::write(answered, talk.answered)
}
